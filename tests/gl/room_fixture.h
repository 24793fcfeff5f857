#pragma once
#include "tests/gl/box_fixture.h"

namespace gnomon {

/// A room around the origin, for point lights in it.
class RoomTest : public BoxTest {
protected:
    /// Adds six walls at this distance along the axes, facing inward.
    void add_room(double half_m) {
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                glm::dvec3 inward(0.0), u(0.0), v(0.0);
                inward[axis] = -side;
                u[(axis + 1) % 3] = half_m;
                v[(axis + 2) % 3] = half_m * -side;
                ASSERT_GT(glm::dot(glm::cross(u, v), inward), 0.0);
                add_card({-inward * half_m, u, v});
            }
    }
};

}  // namespace gnomon
