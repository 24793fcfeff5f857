#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {

/// A lamp on a floor or near it, a box that stands on the floor, and what a wall behind both must see, by hand.
struct LampOnFloor {
    static constexpr double kFloor_m = 2.0, kWall_m = 3.0;  // half of the floor; how far behind its middle the wall is
    static constexpr glm::dvec3 kBoxLow{0.5, 0.0, -1.5}, kBoxHigh{1.5, 1.0, -0.5};

    glm::dvec3 lamp_m{0.1, 0.0, 0.2};  // from the floor's middle
    bool floor_faces_up = true;

    template <class Scene>
    void build(Scene& scene) const {
        const double side = floor_faces_up ? 1.0 : -1.0;
        scene.place(scene.add_square(), glm::dvec3(0.0),
                    glm::dmat3({2.0 * kFloor_m, 0, 0}, {0, 0, -side * 2.0 * kFloor_m}, {0, side * 2.0 * kFloor_m, 0}));
        scene.place(scene.add_cube(), 0.5 * (kBoxLow + kBoxHigh)).visible = false;
        scene.place(scene.add_square(), {0.0, 0.0, -kWall_m}, glm::dmat3(8.0));
    }
    /// Looks at the wall along the floor, which lies in the camera's own plane: each pixel sees the wall.
    static ConsumerItem camera(const AnalyticScene& scene, std::uint32_t size_px) {
        ConsumerItem camera = scene.view_from_above(size_px, 6.0);
        camera.position_ws_m = scene.offset_m + glm::dvec3(0.0, 0.0, 50.0);
        camera.rotation_ws = glm::dmat3(1.0);
        return camera;
    }
    /// Places on the wall, none on the floor's plane.
    static std::vector<glm::dvec3> places() {
        std::vector<glm::dvec3> all;
        for (const double y : {-2.9, -1.1, -0.3, -0.01, -1e-4, 1e-4, 0.01, 0.3, 1.1, 2.9})
            for (double x = -2.95; x < 3.0; x += 0.1) all.push_back({x, y, -kWall_m});
        return all;
    }
    /// Returns whether light reaches p on the wall. A lamp in the floor's plane stands on its front.
    bool lights(const glm::dvec3& p) const {
        const bool lamp_above = lamp_m.y > 0.0 || (!(lamp_m.y < 0.0) && floor_faces_up);
        return !(lamp_above != (p.y > 0.0) && crosses_floor(p)) && !meets_box(p);
    }

private:
    bool crosses_floor(const glm::dvec3& p) const {
        const glm::dvec3 at = p + (lamp_m - p) * (p.y / (p.y - lamp_m.y));
        return std::max(std::abs(at.x), std::abs(at.z)) < kFloor_m;
    }
    bool meets_box(const glm::dvec3& p) const {
        double from = 0.0, to = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double way = lamp_m[axis] - p[axis];
            const double a = (kBoxLow[axis] - p[axis]) / way, b = (kBoxHigh[axis] - p[axis]) / way;
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from < to;
    }
};

/// Heights above and below the floor: some differ from 0 only in double, some plainly.
inline constexpr double kLampHeights_m[] = {0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3};

}  // namespace gnomon::oracle
