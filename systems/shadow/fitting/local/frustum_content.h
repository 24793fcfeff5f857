#pragma once
#include <cmath>
#include <glm/mat3x3.hpp>

#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/light_kinds.h"

/// What a spot or a point light sees through one light frustum: the base of its fits.
namespace gnomon::shadow {

struct FrustumContent {
    bool receivers = false, casters = false;
    TangentRectangle footprint{glm::dvec2(HUGE_VAL), glm::dvec2(-HUGE_VAL)};  // visible receivers, tangents
    double nearest_m = HUGE_VAL, farthest_m = 0.0;  // distances along the axis; farthest: of the receivers
};

/// Finds the receivers of a light frustum within `frustum`.
FrustumContent visible_content(const FitInput& input, const ReceiverHull& receiver_hull,
                               const TangentRectangle& frustum);

/// Adds the casters within `frustum` of the light frustum's axes, no farther than the farthest receiver. Sets whether
/// there are any, and the distance to the nearest.
void include_casters(const FitInput& input, const ReceiverHull& receiver_hull, const TangentRectangle& frustum,
                     FrustumContent& content);

}  // namespace gnomon::shadow
