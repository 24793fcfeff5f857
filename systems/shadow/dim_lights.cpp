#include "systems/shadow/dim_lights.h"

#include <algorithm>
#include <limits>

#include "engine/math/aabb.h"

namespace gnomon::shadow {
namespace {

/// Of the sRGB encoding at black, IEC 61966-2-1; the tone curve (lighting/tonemap.frag) is nowhere steeper than 1.
constexpr double kSteepestEncoding = 12.92;
constexpr double kDisplaySteps = 255.0;

bool comes_before(ecs::Entity a, ecs::Entity b) {
    return a.index != b.index ? a.index < b.index : a.version < b.version;
}

}  // namespace

double most_display_steps(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                          std::span<const std::uint32_t> receivers, double exposure) {
    const double brightest = static_cast<double>(std::max({light.colour.r, light.colour.g, light.colour.b}));
    const double emitted = static_cast<double>(light.intensity) * brightest;
    double most = 0.0;
    for (const std::uint32_t r : receivers) {
        const InstanceItem& item = scene.instances[r];
        double received = emitted;
        if (light.kind != LightKind::directional) {
            const double distance_m = math::distance(item.bounds_ws, light.position_ws_m);
            if (!(distance_m > 0.0)) return std::numeric_limits<double>::infinity();
            received = emitted / (distance_m * distance_m);
        }
        most = std::max(most, received * static_cast<double>(gpu.mesh(item.mesh).most_reflected));
    }
    return most * exposure * kSteepestEncoding * kDisplaySteps;
}

void DimLights::leave_out(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    steps_.assign(scene.lights.size(), std::nullopt);
    candidates_.clear();
    for (std::uint32_t d = 0; scene.exposure && d < frame.demands.size(); ++d) {
        const std::uint32_t light = frame.demands[d].light;
        const LightItem& item = scene.lights[light];
        const PotentialSets& sets = frame.sets[d];
        if (sets.skip != Reason::none || !item.shadow.economy) continue;
        const auto receivers = std::span(frame.receiver_items).subspan(sets.receivers.first, sets.receivers.count);
        const double steps = most_display_steps(scene, gpu, item, receivers, *scene.exposure);
        steps_[light] = steps;
        const bool was_out = std::binary_search(out_.begin(), out_.end(), item.entity, comes_before);
        if (steps <= kMostSteps) candidates_.push_back({steps, d, was_out});
    }
    // Of equals the first, whatever their order in memory.
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Dim& a, const Dim& b) { return a.steps != b.steps ? a.steps < b.steps : a.demand < b.demand; });
    out_.clear();
    double sum = 0.0;
    for (const Dim& dim : candidates_) {
        sum += dim.steps;
        if (!(sum <= (dim.was_out ? kMostSteps : kNewlyMostSteps))) break;
        frame.sets[dim.demand].skip = Reason::below_display_step;
        out_.push_back(scene.lights[frame.demands[dim.demand].light].entity);
    }
    std::sort(out_.begin(), out_.end(), comes_before);
}

}  // namespace gnomon::shadow
