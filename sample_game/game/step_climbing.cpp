#include "sample_game/game/step_climbing.h"

#include <algorithm>

namespace gnomon::game {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;

}  // namespace

Footing stepped(const Footing& now, double ground_m) {
    const double above_m = now.height_m - ground_m;
    if (above_m < -kStepLimit_m) return {now.height_m, 0.0};
    const bool falls = above_m > kStepLimit_m || (now.fall_m_per_s > 0.0 && above_m > 0.0);
    if (!falls) {
        const double most_m = kClimb_m_per_s * kStep_s;
        if (above_m > most_m) return {now.height_m - most_m, 0.0};
        if (above_m < -most_m) return {now.height_m + most_m, 0.0};
        return {ground_m, 0.0};
    }
    const double speed = now.fall_m_per_s + kGravity_m_per_s2 * kStep_s;
    const double height_m = now.height_m - speed * kStep_s;
    return height_m > ground_m ? Footing{height_m, speed} : Footing{ground_m, 0.0};
}

}  // namespace gnomon::game
