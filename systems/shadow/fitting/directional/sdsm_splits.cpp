#include "systems/shadow/fitting/directional/sdsm_splits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "systems/extract/light_facts.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/fitting/size_steps.h"
#include "systems/shadow/projection/cascade_splits.h"

namespace gnomon::shadow {
namespace {

/// Bins between the first and the last split distance, and running sums over them.
struct Counted {
    bool perspective = true;
    DepthSpan whole;
    double view_width = 0.0;  // diagonal of the camera's view: at distance 1 m (perspective), anywhere
    double width_m = 0.0;
    std::uint32_t size = 0;
    std::array<double, kDepthBins> end_m{};
    std::array<double, kDepthBins + 1> weight{};  // pixels in all lower bins

    bool empty() const { return !(weight[size] > 0.0); }
    /// Returns the error cost of the pixels in bins [from, to), in a slice that ends at `end_m`.
    double cost(std::uint32_t from, std::uint32_t to, double slice_end_m) const {
        const double start_m = from == 0 ? whole.lowest : end_m[from - 1];
        const double seen_m = std::min(perspective ? view_width * slice_end_m : view_width, width_m);
        return (seen_m + slice_end_m - start_m) * (weight[to] - weight[from]);
    }
};

Counted counted(const SampledSplit& split) {
    Counted bins;
    bins.perspective = split.consumer.projection == CameraProjection::perspective;
    bins.whole = split.whole;
    bins.view_width = 2.0 * half_extent(split.consumer).y * std::hypot(1.0, aspect(split.consumer));
    bins.width_m = split.width_m;
    for (std::uint32_t bin = 0; bin < kDepthBins; ++bin) {
        const double start_m = step_size(static_cast<int>(bin) + kFirstDepthStep);
        const double end_m = step_size(static_cast<int>(bin) + kFirstDepthStep + 1);
        if (start_m >= split.whole.highest || end_m <= split.whole.lowest) continue;
        const double pixels = split.depths.pixels[bin];
        bins.end_m[bins.size] = std::min(end_m, split.whole.highest);
        bins.weight[bins.size + 1] = bins.weight[bins.size] + (bins.perspective ? pixels / start_m : pixels);
        ++bins.size;
    }
    return bins;
}

double cost_of(const Counted& bins, std::uint32_t count, const CascadeSplitDistances& ends_m) {
    double sum = 0.0;
    std::uint32_t from = 0;
    for (std::uint32_t c = 1; c <= count; ++c) {
        std::uint32_t to = from;
        while (to < bins.size && (c == count || bins.end_m[to] <= ends_m[c])) ++to;
        sum += bins.cost(from, to, ends_m[c]);
        from = to;
    }
    return sum;
}

/// Searches exhaustively by dynamic programming: the best c splits before a bin follow from the best c - 1 before each
/// earlier one.
CascadeSplitDistances best_ends(const Counted& bins, std::uint32_t count) {
    const std::uint32_t size = bins.size;
    std::array<std::array<std::uint16_t, kDepthBins + 1>, kMaxCascades + 1> from{};
    std::array<double, kDepthBins + 1> before{}, now{};
    before.fill(std::numeric_limits<double>::infinity());
    before[0] = 0.0;
    for (std::uint32_t c = 1; c <= count; ++c, before = now)
        for (std::uint32_t to = 0; to <= size; ++to) {
            const double end_m = c == count ? bins.whole.highest : to == 0 ? bins.whole.lowest : bins.end_m[to - 1];
            now[to] = before[to];  // slice without a bin
            from[c][to] = static_cast<std::uint16_t>(to);
            for (std::uint32_t i = 0; i < to; ++i) {
                const double cost = before[i] + bins.cost(i, to, end_m);
                if (!(cost < now[to])) continue;
                now[to] = cost;
                from[c][to] = static_cast<std::uint16_t>(i);
            }
        }
    CascadeSplitDistances ends_m{};
    ends_m[0] = bins.whole.lowest;
    ends_m[count] = bins.whole.highest;
    std::uint32_t to = size;
    for (std::uint32_t c = count; c > 1; --c) {
        to = from[c][to];
        ends_m[c - 1] = to == 0 ? bins.whole.lowest : bins.end_m[to - 1];
    }
    return ends_m;
}

bool knows(const SampledSplit& split) {
    return split.depths.camera != ecs::kNull && split.depths.camera == split.consumer.entity &&
           split.whole.lowest > 0.0 && std::isfinite(split.whole.highest);
}

}  // namespace

bool wants_sampled_depths(const SceneSnapshot& scene, const FittedViews& fitted,
                          std::span<const LightStatus> statuses) {
    for (std::size_t i = 0; i < fitted.lights.size(); ++i) {
        const ShadowRequest& request = fitted.lights[i].request;
        const LightItem& light = scene.lights[i];
        if (!statuses[i].is_skipped() && light_facts(light.kind).parallel && !request.projection.perspective_sun &&
            request.map.view_count > 1 && light.tuning.cascades.splits == CascadeSplits::sampled &&
            are_splits(light.tuning.cascades))
            return true;
    }
    return false;
}

bool sampled_splits(const SampledSplit& split, CascadeSplitDistances& ends_m) {
    if (!knows(split)) return false;
    const Counted bins = counted(split);
    if (bins.empty()) return false;
    ends_m = best_ends(bins, split.count);
    return true;
}

bool held_sampled_splits(const SampledSplit& split, const SampledSplitHistory& previous, SampledSplitHistory& next,
                         CascadeSplitDistances& ends_m) {
    constexpr double kCostHysteresis = 1.1;
    if (!knows(split)) return false;
    const Counted bins = counted(split);
    if (bins.empty()) return false;
    ends_m = best_ends(bins, split.count);
    if (previous.count == split.count) {
        CascadeSplitDistances stay = previous.ends_m;
        stay[0] = split.whole.lowest;
        for (std::uint32_t i = 1; i < split.count; ++i) stay[i] = std::clamp(stay[i], stay[i - 1], split.whole.highest);
        stay[split.count] = split.whole.highest;
        if (cost_of(bins, split.count, stay) <= kCostHysteresis * cost_of(bins, split.count, ends_m)) ends_m = stay;
    }
    next = {split.count, ends_m};
    return true;
}

}  // namespace gnomon::shadow
