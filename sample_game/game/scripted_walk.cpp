#include "sample_game/game/scripted_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>

namespace gnomon::game {
namespace {

/// From `from_s` on the walker heads for `goal_m`, and stands there once it arrived.
struct Leg {
    double from_s;
    glm::dvec2 goal_m;  // x, z
};
// The guard lamp points away from the south side for the first half of its 16 s. The walker stands behind a screen
// while the lamp comes by, and its shadow vanishes in the screen's.
constexpr std::array kLegs{Leg{0.0, {-4.0, 9.7}}, Leg{1.7, {-1.4, 9.75}}, Leg{2.8, {0.3, 8.7}}, Leg{15.0, {2.4, 9.7}},
                           Leg{16.0, {10.4, 9.5}}};
constexpr double kNear_m = 0.1, kMaxTurn_rad = 0.05;

}  // namespace

GameInput demo_input(const GameState& state) {
    const auto later =
        std::find_if(kLegs.begin(), kLegs.end(), [&](const Leg& l) { return l.from_s > state.time_s(); });
    const Leg& leg = *(later - 1);
    const double x = leg.goal_m.x - state.feet_m.x, z = leg.goal_m.y - state.feet_m.z;
    if (x * x + z * z < kNear_m * kNear_m) return {};
    const double turn = std::remainder(std::atan2(-x, -z) - state.yaw_rad, 2.0 * glm::pi<double>());
    return {.forward = std::max(std::cos(turn), 0.0), .yaw_rad = std::clamp(turn, -kMaxTurn_rad, kMaxTurn_rad)};
}

}  // namespace gnomon::game
