#include "systems/shadow/culling/contribution_culling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/aabb.h"
#include "systems/extract/light_facts.h"

namespace gnomon::shadow {
namespace {

/// Largest slope of tone curve and sRGB encoding: the encoding's at black (IEC 61966-2-1). The tone curve
/// (lighting/post/tonemap.frag) is nowhere steeper than 1.
constexpr double kSteepestEncoding = 12.92;
constexpr double kDisplaySteps = 255.0;

/// Ratio of brightest to faintest light from which the exposure is worth measuring. The brightest one lights a whole
/// receiver, at most to middle grey, 0.18: that is 0.18 * 12.92 * 255 display steps. A light is culled below 0.4 steps,
/// or below a fourth of that where the exposure is measured late.
constexpr double kFaint = 4096.0;

/// Returns the largest number of display steps that a light adds to any receiver at an exposure of 1. `distance_m`:
/// distance of a local light from a receiver's bounding box.
template <class Distance>
double most_steps(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                  std::span<const std::uint32_t> receivers, Distance distance_m) {
    double most = 0.0;
    for (const std::uint32_t r : receivers) {
        const InstanceItem& item = scene.instances[r];
        if (is_air(item)) continue;
        const double away_m = distance_m(item.bounds_ws);
        const double received = illuminance_lux(light, away_m * away_m);
        if (!std::isfinite(received)) return std::numeric_limits<double>::infinity();
        most = std::max(most, received * static_cast<double>(gpu.mesh(item.mesh).most_reflected));
    }
    return most * kSteepestEncoding * kDisplaySteps;
}

/// Returns the largest number of display steps that a light adds to all of one receiver: by its farthest corner.
double steps_throughout(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                        std::span<const std::uint32_t> receivers) {
    return most_steps(scene, gpu, light, receivers, [&](const math::Aabb& box_ws) {
        return glm::length(glm::abs(light.position_ws_m - math::centre(box_ws)) + math::half_extent(box_ws));
    });
}

bool comes_before(ecs::Entity a, ecs::Entity b) {
    return a.index != b.index ? a.index < b.index : a.version < b.version;
}

}  // namespace

double most_display_steps(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                          std::span<const std::uint32_t> receivers, double exposure) {
    // Shares of light show at any brightness, and deep air adds up light of any strength.
    const auto shows_all = [&](std::uint32_t r) {
        return scene.instances[r].shadow_catcher || is_air(scene.instances[r]);
    };
    if (std::any_of(receivers.begin(), receivers.end(), shows_all)) return std::numeric_limits<double>::infinity();
    return exposure * most_steps(scene, gpu, light, receivers,
                                 [&](const math::Aabb& box_ws) { return math::distance(box_ws, light.position_ws_m); });
}

void ContributionCulling::ask_lights(const SceneSnapshot& scene, const GpuScene& gpu, const ReceiverCasterSets& sets,
                                     double exposure, std::span<const LightStatus> statuses) {
    const bool known = std::isfinite(exposure);
    const auto takes_part = [](const LightStatus& status) { return !status.is_skipped(); };
    if (!known && std::count_if(statuses.begin(), statuses.end(), takes_part) < 2) return;  // no light to compare with
    double faintest = std::numeric_limits<double>::infinity(), brightest = 0.0;        // steps at an exposure of 1
    for (std::uint32_t i = 0; i < statuses.size(); ++i) {
        const LightItem& item = scene.lights[i];
        if (statuses[i].is_skipped() || !item.tuning.reuse.economy) continue;
        const auto receivers = slice(sets.receiver_items, sets.lights[i].receivers);
        const double at_one = most_display_steps(scene, gpu, item, receivers, 1.0);
        faintest = std::min(faintest, at_one);
        brightest = std::max(brightest, steps_throughout(scene, gpu, item, receivers));
        if (!known) continue;
        const double steps = at_one * exposure;
        steps_[i] = steps;
        const bool was_out = std::binary_search(out_.begin(), out_.end(), item.entity, comes_before);
        if (steps <= kMostSteps) candidates_.push_back({steps, i, was_out});
    }
    wants_exposure_ = brightest > 0.0 && faintest * kFaint <= brightest;
}

void ContributionCulling::leave_out(const SceneSnapshot& scene, const GpuScene& gpu, const ReceiverCasterSets& sets,
                                    std::optional<double> exposure, std::span<LightStatus> statuses) {
    steps_.assign(scene.lights.size(), std::nullopt);
    candidates_.clear();
    wants_exposure_ = false;
    if (exposure) ask_lights(scene, gpu, sets, *exposure, statuses);
    // Equal lights are sorted by index, so that the choice is deterministic.
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Dim& a, const Dim& b) { return a.steps != b.steps ? a.steps < b.steps : a.light < b.light; });
    out_.clear();
    double sum = 0.0;
    for (const Dim& dim : candidates_) {
        sum += dim.steps;
        if (!(sum <= (dim.was_out ? kMostSteps : kNewlyMostSteps))) break;
        statuses[dim.light].skip(Reason::below_display_step);
        out_.push_back(scene.lights[dim.light].entity);
    }
    std::sort(out_.begin(), out_.end(), comes_before);
}

}  // namespace gnomon::shadow
