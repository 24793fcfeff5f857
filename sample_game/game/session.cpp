#include "sample_game/game/session.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/game/scripted_walk.h"
#include "sample_game/support/scene/node_motion.h"

namespace gnomon::game {
namespace {

constexpr double kRadPerPixel = 0.0025;
constexpr double kRadPerHour = glm::pi<double>() / 12.0;
constexpr double kFovY_rad = 1.0, kNear_m = 0.05;
// The axis that the sun turns about: through the celestial pole of 50 degrees north, if -Z is north.
const glm::dvec3 kSunAxis(0.0, 0.766044443118978, -0.642787609686539);
constexpr double kSetsOver_rad = 0.1;  // the sun fades over its last 6 degrees

bool held(const Input& input, Key key) {
    const auto i = static_cast<std::size_t>(key);
    return input.down[i] || input.pressed[i];
}

double axis(const Input& input, Key minus, Key plus) {
    return (held(input, plus) ? 1.0 : 0.0) - (held(input, minus) ? 1.0 : 0.0);
}

}  // namespace

GameSession::GameSession(Level level, const SpawnedScene& scene, ecs::Registry& registry)
    : game_(std::move(level)),
      moving_(scene.moving),
      played_(scene.played),
      body_(scene.nodes[static_cast<std::size_t>(game_.level().player)]),
      sun_(scene.nodes[static_cast<std::size_t>(game_.level().sun)]),
      camera_(registry.create()) {
    for (const NamedEntity& other : scene.cameras)
        registry.patch<Camera>(other.entity, [](Camera& camera) { camera.active = false; });
    registry.emplace<Transform>(camera_);
    registry.emplace<Camera>(camera_, {.fov_y_rad = kFovY_rad, .near_m = kNear_m});
    registry.emplace<Name>(camera_, {"player"});
    sun_at_dusk_ = *registry.get<Transform>(sun_);
    sun_lux_ = registry.get<Light>(sun_)->intensity;
}

void GameSession::advance(double dt_s, const GameInput& input) {
    GameInput next = input;
    next.yaw_rad += pending_.yaw_rad;
    next.pitch_rad += pending_.pitch_rad;
    next.toggle_pause = next.toggle_pause != pending_.toggle_pause;
    next.restart |= pending_.restart;
    for (left_over_s_ += dt_s; left_over_s_ >= kStep_s; left_over_s_ -= kStep_s) {
        game_.step(next);
        next.yaw_rad = next.pitch_rad = 0.0;
        next.toggle_pause = next.restart = false;
    }
    pending_ = next;
}

void GameSession::advance_demo(double dt_s) {
    for (left_over_s_ += dt_s; left_over_s_ >= kStep_s; left_over_s_ -= kStep_s) game_.step(demo_input(state()));
}

void GameSession::play_demo_until(double time_s) {
    const double steps = std::round(time_s / kStep_s);
    while (static_cast<double>(state().steps) < steps && !ended()) game_.step(demo_input(state()));
}

void GameSession::apply(ecs::Registry& registry) {
    const GameState& state = game_.state();
    if (state.time_s() != applied_time_s_) {
        apply_motion(moving_, state.time_s(), registry);
        play(played_, state.time_s(), registry);
    }
    applied_time_s_ = state.time_s();
    const glm::dquat heading = glm::angleAxis(state.yaw_rad, glm::dvec3(0.0, 1.0, 0.0));
    const auto put = [&](ecs::Entity entity, const glm::dvec3& at_m, const glm::dquat& rotation) {
        const Transform* now = registry.get<Transform>(entity);
        if (now->translation_m == at_m && now->rotation == rotation) return;
        registry.patch<Transform>(entity, [&](Transform& transform) {
            transform.translation_m = at_m;
            transform.rotation = rotation;
        });
    };
    put(body_, state.feet_m, heading);
    put(camera_, game_.camera_m(), heading * glm::angleAxis(state.pitch_rad, glm::dvec3(1.0, 0.0, 0.0)));
    if (state.sun_hours != applied_sun_hours_) apply_sun(registry);
    applied_sun_hours_ = state.sun_hours;
}

void GameSession::apply_sun(ecs::Registry& registry) {
    const glm::dquat turn = glm::angleAxis(-kRadPerHour * game_.state().sun_hours, kSunAxis);
    const glm::dquat rotation = turn * sun_at_dusk_.rotation;
    const double elevation = std::asin(std::clamp((rotation * glm::dvec3(0.0, 0.0, 1.0)).y, -1.0, 1.0));
    const auto above = static_cast<float>(std::clamp(elevation / kSetsOver_rad, 0.0, 1.0));
    registry.patch<Transform>(sun_, [&](Transform& transform) { transform.rotation = rotation; });
    registry.patch<Light>(sun_, [&](Light& light) { light.intensity = sun_lux_ * above; });
}

GameInput to_game_input(const Input& input, bool look) {
    const auto pressed = [&](Key key) { return input.pressed[static_cast<std::size_t>(key)]; };
    return {.forward = axis(input, Key::s, Key::w),
            .right = axis(input, Key::a, Key::d),
            .yaw_rad = look ? -kRadPerPixel * input.mouse_dx : 0.0,
            .pitch_rad = look ? -kRadPerPixel * input.mouse_dy : 0.0,
            .run = held(input, Key::shift),
            .sun = axis(input, Key::left, Key::right),
            .toggle_pause = pressed(Key::p),
            .restart = pressed(Key::r)};
}

}  // namespace gnomon::game
