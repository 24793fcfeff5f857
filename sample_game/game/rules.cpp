#include "sample_game/game/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "sample_game/game/step_climbing.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/node_transforms.h"

namespace gnomon::game {
namespace {

constexpr double kWalk_m_per_s = 2.6, kRun_m_per_s = 4.2;
constexpr double kRadius_m = 0.3, kHeight_m = 1.75;
constexpr double kMaxPitch_rad = 1.2;
constexpr double kFullLight_lx = 60.0;
constexpr double kCaughtAfter_s = 2.0, kForgottenAfter_s = 4.0;  // in full light; from almost caught to unseen
constexpr double kHoursPerSecond = 1.0, kEarliest_h = -8.0, kLatest_h = 3.0;
constexpr double kEye_m = 1.7, kBehind_m = 3.2, kShoulder_m = 0.35, kOffWall_m = 0.25;

/// Points of the body at which light counts: height, and sideways from the middle.
constexpr std::array<std::array<double, 2>, 6> kBody{
    {{0.2, 0.0}, {0.6, 0.0}, {1.0, 0.0}, {1.35, -0.2}, {1.35, 0.2}, {1.65, 0.0}}};

glm::dvec3 heading(double yaw_rad) { return {-std::sin(yaw_rad), 0.0, -std::cos(yaw_rad)}; }
glm::dvec3 sideways(double yaw_rad) { return {std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)}; }

bool holds(const math::Aabb& box, const glm::dvec3& point) {
    return glm::all(glm::greaterThanEqual(point, box.min)) && glm::all(glm::lessThanEqual(point, box.max));
}

/// Converts a lamp to the form that visibility queries take.
Light light_of(const Lamp& lamp) {
    return {.kind = lamp.light.type == assets::LightType::spot ? LightKind::spot : LightKind::point,
            .range_m = lamp.light.range_m,
            .outer_cone_rad = lamp.light.outer_cone_rad};
}

}  // namespace

const char* to_text(Phase phase) {
    switch (phase) {
        case Phase::playing:
            return "playing";
        case Phase::paused:
            return "paused";
        case Phase::won:
            return "won";
        case Phase::lost:
            break;
    }
    return "lost";
}

/// Follows KHR_lights_punctual: inverse square, cut off at the range, the cone's edge squared.
double lamp_lux(const Lamp& lamp, const WorldTransform& pose, const glm::dvec3& point_ws_m) {
    const glm::dvec3 to_point = point_ws_m - pose.translation_ws_m;
    const double distance = glm::length(to_point), range = lamp.light.range_m;
    if (!(distance > 0.0)) return 0.0;
    double lux = static_cast<double>(lamp.light.intensity) / (distance * distance);
    if (range > 0.0) lux *= std::clamp(1.0 - std::pow(distance / range, 4.0), 0.0, 1.0);
    if (lamp.light.type != assets::LightType::spot) return lux;
    const double outer = std::cos(static_cast<double>(lamp.light.outer_cone_rad));
    const double inner = std::cos(static_cast<double>(lamp.light.inner_cone_rad));
    const double cosine = glm::dot(to_point / distance, -glm::normalize(pose.basis[2]));
    if (!(cosine > outer)) return 0.0;
    const double edge = inner > outer ? std::min((cosine - outer) / (inner - outer), 1.0) : 1.0;
    return lux * edge * edge;
}

Game::Game(Level level) : level_(std::move(level)) {
    state_.feet_m = level_.start_m;
    state_.yaw_rad = level_.start_yaw_rad;
    place();
    state_.light = measured_light();
}

void Game::step(const GameInput& input) {
    if (input.restart) {
        state_ = {.feet_m = level_.start_m, .yaw_rad = level_.start_yaw_rad, .sun_hours = state_.sun_hours};
        place();
        state_.light = measured_light();
        return;
    }
    if (input.toggle_pause && state_.phase == Phase::playing)
        state_.phase = Phase::paused;
    else if (input.toggle_pause && state_.phase == Phase::paused)
        state_.phase = Phase::playing;
    if (state_.phase != Phase::playing) return;

    ++state_.steps;
    state_.sun_hours = std::clamp(state_.sun_hours + input.sun * kHoursPerSecond * kStep_s, kEarliest_h, kLatest_h);
    place();
    walk(input);
    state_.light = measured_light();
    const double change = state_.light > kHiddenLight ? state_.light / kCaughtAfter_s : -1.0 / kForgottenAfter_s;
    state_.seen = std::clamp(state_.seen + change * kStep_s, 0.0, 1.0);
    if (state_.seen >= 1.0)
        state_.phase = Phase::lost;
    else if (holds(level_.goal, state_.feet_m))
        state_.phase = Phase::won;
}

void Game::walk(const GameInput& input) {
    state_.yaw_rad = std::remainder(state_.yaw_rad + input.yaw_rad, 2.0 * glm::pi<double>());
    state_.pitch_rad = std::clamp(state_.pitch_rad + input.pitch_rad, -kMaxPitch_rad, kMaxPitch_rad);
    glm::dvec3 stride = heading(state_.yaw_rad) * input.forward + sideways(state_.yaw_rad) * input.right;
    if (const double length = glm::length(stride); length > 1.0) stride /= length;
    const glm::dvec3 to = state_.feet_m + stride * ((input.run ? kRun_m_per_s : kWalk_m_per_s) * kStep_s);
    const double step_top = state_.feet_m.y + kStepLimit_m;
    const glm::dvec2 free =
        pushed_out({to.x, to.z}, kRadius_m, step_top, state_.feet_m.y + kHeight_m, level_.solids, poses_);
    const double ground = ground_below(free, kRadius_m, step_top, level_.start_m.y, level_.solids, poses_);
    const Footing footing = stepped({state_.feet_m.y, state_.fall_m_per_s}, ground);
    state_.feet_m = {free.x, footing.height_m, free.y};
    state_.fall_m_per_s = footing.fall_m_per_s;
}

/// Moves all nodes to where they are at the state's time.
void Game::place() {
    assets::SceneData now;
    now.nodes = level_.nodes;
    for (assets::Node& node : now.nodes) {
        if (node.motion.kind.empty()) continue;
        const Transform rest{.translation_m = node.translation_m, .rotation = node.rotation, .scale = node.scale};
        const Transform moving = moved(rest, node.motion, state_.time_s());
        node.translation_m = moving.translation_m;
        node.rotation = moving.rotation;
    }
    poses_ = world_poses(now);
    level_.occluders.place(poses_);
}

double Game::measured_light() {
    std::array<LitPlace, kBody.size()> body;
    for (std::size_t i = 0; i < kBody.size(); ++i) {
        const auto& [height, side] = kBody[i];
        body[i].position_m = state_.feet_m + glm::dvec3(0.0, height, 0.0) + sideways(state_.yaw_rad) * side;
    }
    double lux = 0.0;
    for (const Lamp& lamp : level_.lamps) {
        std::array<float, kBody.size()> shares{};
        level_.occluders.ask(light_of(lamp), poses_[lamp.node], body, shares);
        for (std::size_t i = 0; i < body.size(); ++i)
            lux += static_cast<double>(shares[i]) * lamp_lux(lamp, poses_[lamp.node], body[i].position_m);
    }
    return std::min(lux / static_cast<double>(kBody.size()) / kFullLight_lx, 1.0);
}

glm::dvec3 Game::camera_m() const {
    const glm::dvec3 eye = state_.feet_m + glm::dvec3(0.0, kEye_m, 0.0);
    const glm::dvec3 look =
        heading(state_.yaw_rad) * std::cos(state_.pitch_rad) + glm::dvec3(0.0, std::sin(state_.pitch_rad), 0.0);
    const glm::dvec3 behind = eye + sideways(state_.yaw_rad) * kShoulder_m - look * kBehind_m;
    const double way = glm::length(behind - eye);
    const double free = free_way(eye, behind, level_.solids, poses_);
    const double kept = free < 1.0 ? std::max(free - kOffWall_m / way, 0.0) : 1.0;
    glm::dvec3 at = eye + (behind - eye) * kept;
    at.y = std::max(at.y, level_.start_m.y + kOffWall_m);
    return at;
}

}  // namespace gnomon::game
