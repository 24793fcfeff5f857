#pragma once
#include "sample_game/game/rules.h"

/// Height of a walker, as character controllers compute it: it climbs steps and falls from ledges.
namespace gnomon::game {

inline constexpr double kStepLimit_m = 0.25;   // what is higher is a wall; stairs rise by 0.15 to 0.2 m
inline constexpr double kClimb_m_per_s = 3.0;  // running up stairs of 0.18 m in 0.3 m takes 2.5

struct Footing {
    double height_m = 0.0;      // height of the feet
    double fall_m_per_s = 0.0;  // 0 on the ground
    bool operator==(const Footing&) const = default;
};

/// Returns where the feet are kStep_s later over ground at `ground_m`. Up to kStepLimit_m apart they follow it
/// smoothly. From higher above they fall and land. Ground above the limit does not lift them: it is a wall
/// (collision_boxes.h).
Footing stepped(const Footing& now, double ground_m);

}  // namespace gnomon::game
