#include "sample_game/app/fly_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "gnomon/components.h"

namespace gnomon::game {
namespace {

constexpr double kRadPerPixel = 0.0025;
constexpr double kFaster = 4.0;
constexpr double kMaxPitch_rad = 0.5 * glm::pi<double>() - 0.01;  // looking straight up has no heading

bool held(const Input& input, Key key) {
    const auto i = static_cast<std::size_t>(key);
    return input.down[i] || input.pressed[i];
}

/// Returns the direction that the keys stand for: right, up and back, each -1, 0 or 1.
glm::dvec3 step_of(const Input& input) {
    const auto axis = [&](Key minus, Key plus) {
        return (held(input, plus) ? 1.0 : 0.0) - (held(input, minus) ? 1.0 : 0.0);
    };
    return {axis(Key::a, Key::d), axis(Key::q, Key::e), axis(Key::w, Key::s)};
}

}  // namespace

/// Starts from the active camera's place. Returns false if there is none.
bool FlyCamera::take_over(ecs::Registry& registry) {
    const auto cameras = registry.entities_with<Camera>();
    const auto seen = std::find_if(cameras.begin(), cameras.end(),
                                   [&](ecs::Entity entity) { return registry.get<Camera>(entity)->active; });
    const WorldTransform* place = seen == cameras.end() ? nullptr : registry.get<WorldTransform>(*seen);
    if (!place) return false;
    position_ws_m_ = place->translation_ws_m;
    const glm::dvec3 forward = -glm::normalize(place->basis[2]);
    yaw_rad_ = std::atan2(-forward.x, -forward.z);
    pitch_rad_ = std::clamp(std::asin(std::clamp(forward.y, -1.0, 1.0)), -kMaxPitch_rad, kMaxPitch_rad);

    const Camera camera = *registry.get<Camera>(*seen);
    for (const ecs::Entity other : std::vector<ecs::Entity>(cameras.begin(), cameras.end()))
        registry.patch<Camera>(other, [](Camera& c) { c.active = false; });
    entity_ = registry.create();
    registry.emplace<Transform>(entity_);
    registry.emplace<Camera>(entity_, camera);
    registry.emplace<Name>(entity_, {"walker"});
    return true;
}

void FlyCamera::update(const Input& input, bool look, double dt_s, ecs::Registry& registry) {
    const glm::dvec3 step = step_of(input);
    const bool turns = look && (input.mouse_dx != 0.0 || input.mouse_dy != 0.0);
    if (step == glm::dvec3(0.0) && !turns) return;
    if (entity_ == ecs::kNull && !take_over(registry)) return;
    if (turns) {
        yaw_rad_ -= kRadPerPixel * input.mouse_dx;
        pitch_rad_ = std::clamp(pitch_rad_ - kRadPerPixel * input.mouse_dy, -kMaxPitch_rad, kMaxPitch_rad);
    }
    const glm::dquat rotation =
        glm::angleAxis(yaw_rad_, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(pitch_rad_, glm::dvec3(1.0, 0.0, 0.0));
    if (step != glm::dvec3(0.0)) {
        const double speed = speed_m_per_s_ * (held(input, Key::shift) ? kFaster : 1.0);
        position_ws_m_ += rotation * glm::normalize(step) * (speed * dt_s);
    }
    registry.patch<Transform>(entity_, [&](Transform& transform) {
        transform.translation_m = position_ws_m_;
        transform.rotation = rotation;
    });
}

}  // namespace gnomon::game
