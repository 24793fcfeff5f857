#include "systems/shadow/projection/spot_cube_transition.h"

#include <algorithm>
#include <numbers>

#include "systems/shadow/projection/cube_faces.h"

namespace gnomon::shadow {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSwitch_rad = 60.0 * kDegree;      // half angle of the cone
constexpr double kHysteresis_rad = 1.25 * kDegree;  // above and below that: 5 degrees of the full angle

}  // namespace

SpotCubeTransition next_spot_cube_transition(double outer_cone_rad, const SpotCubeTransition& previous) {
    SpotCubeTransition next = previous;
    next.used = true;
    const double away_rad = outer_cone_rad - kSwitch_rad;
    if (!previous.used || away_rad > kHysteresis_rad || away_rad < -kHysteresis_rad)
        next.prefers_faces = away_rad > 0.0;
    const int goal = next.prefers_faces ? 8 : 0;
    const bool at_once = !previous.used || outer_cone_rad > kWidestMap_rad;
    const int step = std::clamp(goal - previous.cube_blend_eighths, -1, 1);
    next.cube_blend_eighths = at_once ? goal : std::clamp(previous.cube_blend_eighths + step, 0, 8);
    return next;
}

}  // namespace gnomon::shadow
