#include "systems/shadow/projection/cascade_splits.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {
namespace {

/// Least start of logarithmic splits, as a share of the farthest distance. A camera inside a receiver's bounding box
/// gives a nearest distance of 0, and 0 has no logarithm.
constexpr double kNearestShare = 1.0 / 1024;

constexpr float kMostBlend = 0.5f;

/// Scale on which cascades have equal lengths: metres, or their logarithm.
struct Scale {
    bool logarithmic;
    double start;
    double from_m(double z_m) const { return logarithmic ? std::log(std::max(z_m, start) / start) : z_m; }
    double to_m(double value) const { return logarithmic ? start * std::exp(value) : value; }
};

double even(const Scale& scale, const DepthSpan& whole, double share) {
    const double low = scale.from_m(whole.lowest), high = scale.from_m(whole.highest);
    return scale.to_m(low + (high - low) * share);
}

/// Returns the depth before which the given share lies of all depths that the sorted `receivers` cover. Depths are
/// measured on `scale` and within `whole`. Where receivers cover nothing, the share is of `whole` itself.
double even_over(const Scale& scale, std::span<const DepthSpan> receivers, const DepthSpan& whole, double share) {
    const auto walk = [&](double wanted) {
        double covered = 0.0, reached = scale.from_m(whole.lowest);
        for (const DepthSpan& r : receivers) {
            const double low = std::max(reached, scale.from_m(std::max(r.lowest, whole.lowest)));
            const double high = scale.from_m(std::min(r.highest, whole.highest));
            if (!(high > low)) continue;
            if (wanted >= 0.0 && covered + (high - low) >= wanted) return low + (wanted - covered);
            covered += high - low;
            reached = high;
        }
        return wanted < 0.0 ? covered : reached;
    };
    const double all = walk(-1.0);
    return all > 0.0 ? scale.to_m(walk(all * share)) : even(scale, whole, share);
}

}  // namespace

bool are_splits(const ShadowTuning::Cascades& tuning) {
    if (!(tuning.split_lambda >= 0.0f && tuning.split_lambda <= 1.0f)) return false;
    if (!(tuning.blend >= 0.0f && tuning.blend <= kMostBlend)) return false;
    if (tuning.splits != CascadeSplits::manual) return true;
    float last_m = 0.0f;
    for (const float end_m : tuning.split_m) {
        if (end_m == 0.0f) break;
        if (!(end_m > last_m) || !std::isfinite(end_m)) return false;
        last_m = end_m;
    }
    return last_m > 0.0f;
}

std::uint32_t cascade_count(const LightItem& light, std::uint32_t automatic) {
    const ShadowTuning::Cascades& tuning = light.tuning.cascades;
    if (tuning.splits == CascadeSplits::manual && are_splits(tuning)) {
        const auto end = std::find(tuning.split_m.begin(), tuning.split_m.end(), 0.0f);
        return static_cast<std::uint32_t>(end - tuning.split_m.begin()) + 1;
    }
    return light.shadow.cascades == 0 ? automatic : std::min<std::uint32_t>(light.shadow.cascades, kMaxCascades);
}

CascadeSplitDistances cascade_split_distances(const ShadowTuning::Cascades& tuning, std::uint32_t count,
                                              const DepthSpan& whole, bool perspective,
                                              std::span<DepthSpan> receivers) {
    const ShadowTuning::Cascades defaults;
    const bool usable = are_splits(tuning);
    const CascadeSplits splits = usable ? tuning.splits : defaults.splits;
    const auto lambda = static_cast<double>(usable ? tuning.split_lambda : defaults.split_lambda);
    const double start_m = std::max(whole.lowest, whole.highest * kNearestShare);
    const Scale logarithmic{perspective && start_m > 0.0, start_m};
    const Scale uniform{false, 0.0};
    if (splits == CascadeSplits::seen || splits == CascadeSplits::sampled)
        std::sort(receivers.begin(), receivers.end(),
                  [](const DepthSpan& a, const DepthSpan& b) { return a.lowest < b.lowest; });
    const auto end_m = [&](std::uint32_t i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        switch (splits) {
            case CascadeSplits::uniform:
                return even(uniform, whole, share);
            case CascadeSplits::logarithmic:
                return even(logarithmic, whole, share);
            case CascadeSplits::manual:
                return static_cast<double>(tuning.split_m[i - 1]);
            case CascadeSplits::seen:
            case CascadeSplits::sampled:
                return lambda * even_over(logarithmic, receivers, whole, share) +
                       (1.0 - lambda) * even_over(uniform, receivers, whole, share);
            case CascadeSplits::practical:
                break;
        }
        return lambda * even(logarithmic, whole, share) + (1.0 - lambda) * even(uniform, whole, share);
    };
    CascadeSplitDistances ends{};
    ends[0] = whole.lowest;
    for (std::uint32_t i = 1; i < count; ++i) ends[i] = std::clamp(end_m(i), ends[i - 1], whole.highest);
    ends[count] = whole.highest;
    return ends;
}

}  // namespace gnomon::shadow
