#include "systems/shadow/request/accuracy_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

/// Hysteresis: a map shrinks when half of its edge, a quarter of its bytes, suffices. A number of cascades changes when
/// it takes twice the texels of another.
constexpr std::uint32_t kSizeHysteresis = 2;
/// Hysteresis of the product of count and error: sqrt(2).
constexpr double kCountHysteresis = 1.4142135623730951;

/// Returns the part of a predicted error that texels cause, without the pixel grid's.
double of_texels_px(double predicted_px) { return predicted_px - edge_error_px(0.0, 0.0); }

}  // namespace

double resolved_width_texel(double reach_texel) {
    constexpr double kSampling_texel = 0.5;
    return kSampling_texel + reach_texel;
}

double edge_error_px(double extent_px, double reach_texel) {
    constexpr double kPixelCentres_px = 1.0;
    return resolved_width_texel(reach_texel) * extent_px + kPixelCentres_px;
}

double walk_error_px(double rounding_px) { return kWalk_px + rounding_px; }

double resolved_px(double texel_edge_px) { return of_texels_px(texel_edge_px) / kSteepestReceiver; }

double slope_factor(double cosine) { return std::max(1.0, 1.0 / (kSteepestReceiver * std::max(cosine, 0.0))); }

double target_error_px(const LightShadow& shadow) {
    return shadow.max_error_px > 0.0f ? static_cast<double>(shadow.max_error_px) : 1.0;
}

double texel_target_px(const LightShadow& shadow, ShadowFilter filter) {
    const double error_px = target_error_px(shadow), narrowest_px = targets_of(shadow).narrowest_px * kSteepestReceiver;
    if (!(narrowest_px > 0.0)) return error_px;
    return filter_row(filter).storage.triangle_ids ? narrowest_px : std::min(error_px, narrowest_px);
}

AccuracyTargets targets_of(const LightShadow& shadow) {
    const auto target = [](float px) { return px > 0.0f ? static_cast<double>(px) : 0.0; };
    return {target(shadow.max_error_px), target(shadow.narrowest_caster_px)};
}

bool meets_targets(const MapAccuracy& maps, const AccuracyTargets& targets, double share) {
    return (!(targets.error_px > 0.0) || maps.edge_px - maps.grid_px <= targets.error_px * share) &&
           (!(targets.narrowest_px > 0.0) || maps.resolved_px <= targets.narrowest_px * share);
}

bool adapts_to_target(const LightItem& light, const ShadowRequest& request) {
    const bool stable = light_facts(light.kind).parallel && light.tuning.cascades.fit == ShadowFit::stable;
    return light.shadow.resolution_px == 0 && !stable && !needs_distances(request.map.filtering) &&
           !filter_row(request.map.filter).rays;  // rays have no such error
}

std::uint32_t target_size_px(std::uint32_t size_px, bool exists, double predicted_px, double target_px,
                             std::uint32_t most_px) {
    const double needed_px = std::ceil(size_px * of_texels_px(predicted_px) / target_px);
    if (!(needed_px < most_px)) return most_px;
    const auto least_px = static_cast<std::uint32_t>(std::max(needed_px, 1.0));
    const std::uint32_t wanted_px = std::min((least_px + kLeastMap_px - 1) / kLeastMap_px * kLeastMap_px, most_px);
    const bool stays = exists && wanted_px <= size_px && size_px <= most_px && size_px < kSizeHysteresis * wanted_px;
    return stays ? size_px : wanted_px;
}

bool meets_target(double predicted_px, double target_px) { return of_texels_px(predicted_px) <= target_px; }

std::uint32_t choose_cascades(std::span<const CascadeTrial> trials, std::uint32_t previous, double target_px) {
    const std::uint64_t most = trials.back().texels;
    for (const CascadeTrial& trial : trials) {
        if (!meets_target(trial.predicted_px, target_px)) continue;
        if (trial.texels <= most || (trial.count == previous && trial.texels < kSizeHysteresis * most))
            return trial.count;
    }
    const auto product = [&](const CascadeTrial& trial) {
        const double product_px = trial.count * std::sqrt(trial.count) * of_texels_px(trial.predicted_px);
        if (!(product_px >= 0.0)) return std::numeric_limits<double>::infinity();
        return trial.count == previous ? product_px / kCountHysteresis : product_px;
    };
    return std::min_element(trials.begin(), trials.end(),
                            [&](const CascadeTrial& a, const CascadeTrial& b) { return product(a) < product(b); })
        ->count;
}

double allowed_error_px(double target_px, double cosine) {
    return target_px * slope_factor(cosine) + edge_error_px(0.0, 0.0);
}

}  // namespace gnomon::shadow
