#include "gnomon/core.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "systems/core/results.h"
#include "systems/core/scene_input.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/fitting/fit_views.h"
#include "systems/shadow/request/decide_requests.h"

namespace gnomon::core {
namespace {

/// Least edge of a map that the stages work with, texels.
constexpr std::uint32_t kLeastDevice_px = 16;

}  // namespace

struct History::State {
    shadow::History lights;
};

History::History() : state_(std::make_unique<State>()) {}
History::History(const History& other) : state_(std::make_unique<State>(*other.state_)) {}
History::History(History&&) noexcept = default;
History& History::operator=(const History& other) {
    if (this != &other) state_ = std::make_unique<State>(*other.state_);
    return *this;
}
History& History::operator=(History&&) noexcept = default;
History::~History() = default;
bool History::operator==(const History& other) const { return state_->lights == other.state_->lights; }

struct Fits::State {
    SceneInput input;
    gl::DeviceInfo device;
    shadow::RayFallbacks fallbacks;
    std::vector<shadow::LightStatus> statuses;
    std::vector<shadow::ShadowRequest> requests;
    shadow::StageStorage storage;
    shadow::ReceiverCasterSets sets;
    shadow::FittedViews fitted;
    shadow::History next;
    SampledDepths no_depths;
    std::vector<LightFit> lights;
    std::vector<View> views;

    void run(const Scene& scene, const Settings& settings, shadow::History& history);
    shadow::LightSetsView sets_of(std::size_t light) const {
        return fitted.sets_of(sets, static_cast<std::uint32_t>(light));
    }
};

/// Runs the stages of ShadowSystem (systems/shadow/shadow_system.cpp) that need no device.
void Fits::State::run(const Scene& scene, const Settings& settings, shadow::History& history) {
    input.take(scene);
    const SceneSnapshot& snapshot = input.snapshot();
    statuses.assign(snapshot.lights.size(), {});
    const shadow::LightAccounts accounts{statuses, {}};
    device.max_texture_px = std::max(settings.max_map_px, kLeastDevice_px);
    device.max_cube_px = std::max(settings.max_cube_px, kLeastDevice_px);
    shadow::decide_requests(snapshot, {device, history, true, {}}, fallbacks, requests);
    for (std::size_t i = 0; i < requests.size(); ++i) statuses[i].skip(requests[i].skip);
    shadow::select_sets(snapshot, {requests, {}}, storage, sets, accounts);
    shadow::fit_views(snapshot, {requests, sets, {}, no_depths, history, {}}, storage, fitted, next, accounts);
    std::swap(history, next);
    write_results({input, sets, fitted, statuses}, settings.convention, lights, views);
}

Fits::Fits() : state_(std::make_unique<State>()) {}
Fits::Fits(Fits&&) noexcept = default;
Fits& Fits::operator=(Fits&&) noexcept = default;
Fits::~Fits() = default;

std::span<const LightFit> Fits::lights() const { return state_->lights; }
std::span<const View> Fits::views() const { return state_->views; }
std::span<const View> Fits::views_of(std::size_t light) const {
    const Range range = state_->lights[light].views;
    return views().subspan(range.first, range.count);
}
std::span<const std::uint32_t> Fits::casters_of(const View& view) const {
    return std::span(state_->fitted.casters).subspan(view.casters.first, view.casters.count);
}
std::span<const std::uint32_t> Fits::casters_of(std::size_t light) const {
    if (!has_maps(state_->lights[light].status)) return {};
    return state_->sets_of(light).casters();
}
std::span<const std::uint32_t> Fits::receivers_of(std::size_t light) const {
    if (!has_maps(state_->lights[light].status)) return {};
    return state_->sets_of(light).receivers();
}
std::uint32_t Fits::unusable_cameras() const { return state_->input.unusable().cameras; }
std::uint32_t Fits::unusable_boxes() const { return state_->input.unusable().boxes; }

void fit_shadows(const Scene& scene, const Settings& settings, History& history, Fits& fits) {
    fits.state_->run(scene, settings, history.state_->lights);
}

}  // namespace gnomon::core
