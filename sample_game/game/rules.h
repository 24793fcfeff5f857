#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/components.h"
#include "sample_game/game/level.h"

/// The rules of "cross the courtyard unseen": no window, no GPU, no clock. Same level, same inputs, same bits.
namespace gnomon::game {

inline constexpr double kStep_s = 1.0 / 60.0;  // one step of the game
inline constexpr double kHiddenLight = 0.35;   // below this the player is in the dark

enum class Phase : std::uint8_t { playing, paused, won, lost };
const char* to_text(Phase phase);

/// Input of the player during one step.
struct GameInput {
    double forward = 0.0, right = 0.0;      // -1 ... 1
    double yaw_rad = 0.0, pitch_rad = 0.0;  // turn of the head in this step; left and up are positive
    bool run = false;
    double sun = 0.0;  // -1 ... 1: turns the time of day
    bool toggle_pause = false, restart = false;
};

struct GameState {
    Phase phase = Phase::playing;
    std::uint64_t steps = 0;  // played; scene time is steps / 60
    glm::dvec3 feet_m{0.0};
    double fall_m_per_s = 0.0;  // speed of the feet, down
    double yaw_rad = 0.0, pitch_rad = 0.0;
    double light = 0.0;      // the meter: 0 dark, 1 fully lit
    double seen = 0.0;       // 1: caught
    double sun_hours = 0.0;  // since dusk
    double time_s() const { return static_cast<double>(steps) * kStep_s; }
    bool operator==(const GameState&) const = default;
};

class Game {
public:
    explicit Game(Level level);

    /// Advances by kStep_s, or less: paused and ended games stand still, all but `toggle_pause` and `restart`.
    void step(const GameInput& input);

    const GameState& state() const { return state_; }
    const Level& level() const { return level_; }

    /// Returns the camera's place: behind the player, before any wall. It looks along yaw and pitch.
    glm::dvec3 camera_m() const;

private:
    void walk(const GameInput& input);
    void place();
    double measured_light();

    Level level_;
    GameState state_;
    std::vector<WorldTransform> poses_;
};

/// Returns the illuminance of `lamp` at a point if nothing is in between, lux.
double lamp_lux(const Lamp& lamp, const WorldTransform& pose, const glm::dvec3& point_ws_m);

}  // namespace gnomon::game
