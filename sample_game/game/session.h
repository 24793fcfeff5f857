#pragma once
#include "gnomon/registry.h"
#include "gnomon/window.h"
#include "sample_game/game/rules.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::game {

/// The game among the entities: its state moves the player's body, the camera behind it, the sun and all that moves.
class GameSession {
public:
    /// Takes over `scene`, spawned from the scene that `level` was made of. Makes its camera the only active one.
    GameSession(Level level, const SpawnedScene& scene, ecs::Registry& registry);

    /// Plays `dt_s` more in whole steps. The remainder is added to the next call, as are presses and turns.
    void advance(double dt_s, const GameInput& input);
    /// Does the same by the script of --demo.
    void advance_demo(double dt_s);
    /// Plays the script from where the game is until `time_s` or the end of the game.
    void play_demo_until(double time_s);

    bool ended() const { return state().phase == Phase::won || state().phase == Phase::lost; }
    const GameState& state() const { return game_.state(); }

    /// Brings the entities to the game's state. What did not move is not touched.
    void apply(ecs::Registry& registry);

private:
    void apply_sun(ecs::Registry& registry);

    Game game_;
    std::vector<MovingEntity> moving_;
    std::vector<PlayedChannel> played_;
    ecs::Entity body_, sun_, camera_;
    Transform sun_at_dusk_;
    float sun_lux_ = 0.0f;
    GameInput pending_;
    double left_over_s_ = 0.0;
    double applied_sun_hours_ = 0.0;
    double applied_time_s_ = -1.0;
};

/// Translates keys and mouse since the last poll. `look`: the mouse turns the head.
GameInput to_game_input(const Input& input, bool look);

}  // namespace gnomon::game
