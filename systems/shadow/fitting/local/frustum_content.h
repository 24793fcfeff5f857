#pragma once
#include <cmath>
#include <glm/mat3x3.hpp>

#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/light_kinds.h"

/// What a spot or a point light sees through one opening: the base of its fits.
namespace gnomon::shadow {

struct LocalContent {
    bool receivers = false, casters = false;
    TangentRectangle footprint{glm::dvec2(HUGE_VAL), glm::dvec2(-HUGE_VAL)};  // of what is seen of the receivers
    double nearest_m = HUGE_VAL, farthest_m = 0.0;  // along the axis; farthest: of the receivers
};

/// The receivers of a beam, within `opening`.
LocalContent visible_content(const FitInput& input, const Beam& beam, const TangentRectangle& opening);

/// Adds the casters within `opening` of the beam's axes and no farther than the farthest receiver: whether there are
/// any, and how near they come.
void include_casters(const FitInput& input, const Beam& beam, const TangentRectangle& opening, LocalContent& content);

}  // namespace gnomon::shadow
