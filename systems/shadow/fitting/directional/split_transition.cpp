#include "systems/shadow/fitting/directional/split_transition.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "systems/extract/volumes.h"

namespace gnomon::shadow {
namespace {

/// Share of a fade that splits may move per frame. Half of the allowed change is reserved for camera motion. If that
/// alone exceeds it, splits move at a quarter, so that they still converge while the camera turns.
constexpr double kGlide = kMostFade / 2.0, kHastyGlide = kMostFade / 4.0;

/// Bounds the change of a static point's view distance since the last frame, for a point seen at `distance_m`, metres.
/// The change is linear across the view, so that a corner has the most.
double carried_m(const SplitHistory& previous, const ConsumerItem& now, double distance_m) {
    const bool flat = now.projection == CameraProjection::orthographic;
    const double half_y = half_extent(now).y * (flat ? 1.0 : distance_m);
    double most = 0.0;
    for (const double x : {-half_y, half_y})
        for (const double y : {-half_y, half_y}) {
            const glm::dvec3 corner_ws =
                previous.position_ws_m + previous.rotation_ws * glm::dvec3(x * aspect(now), y, -distance_m);
            const double distance_now_m = -glm::dot(corner_ws - now.position_ws_m, now.rotation_ws[2]);
            most = std::max(most, std::abs(distance_now_m - distance_m));
        }
    return most;
}

/// Returns the share of the remaining way that the splits may move in this frame, 0 to 1.
double next_share(const SplitTransition& ends, std::uint32_t count, double blend, const ConsumerItem& consumer,
                  const SplitHistory& previous) {
    double share = 1.0;
    for (std::uint32_t i = 1; i < count; ++i) {
        const double start_m = fade_start(ends.at_m, i, blend), to_start_m = fade_start(ends.to_m, i, blend);
        const double band_m = std::min(ends.at_m[i] - start_m, ends.to_m[i] - to_start_m);
        const double way_m = std::max(std::abs(ends.to_m[i] - ends.at_m[i]), std::abs(to_start_m - start_m));
        if (!(band_m > 0.0) || !(way_m > 0.0)) continue;
        const double carried =
            std::max(carried_m(previous, consumer, start_m), carried_m(previous, consumer, ends.at_m[i])) / band_m;
        if (!(carried < 1.0)) return 1.0;  // no point stays long enough to be seen passing
        const double room = carried < kMostFade ? std::min(kMostFade - carried, kGlide) : kHastyGlide;
        share = std::min(share, room * band_m / way_m);
    }
    return share;
}

bool rises(const CascadeSplitDistances& ends_m, std::uint32_t count) {
    for (std::uint32_t i = 0; i <= count; ++i)
        if (!std::isfinite(ends_m[i]) || (i > 0 && ends_m[i] < ends_m[i - 1])) return false;
    return true;
}

}  // namespace

double fade_start(const CascadeSplitDistances& ends_m, std::uint32_t i, double blend) {
    return ends_m[i] - blend * (ends_m[i] - ends_m[i - 1]);
}

SplitTransition glide(const CascadeSplitDistances& wanted_m, std::uint32_t count, double blend,
                      const ConsumerItem& consumer, const SplitHistory& previous, SplitHistory& next) {
    SplitTransition ends{wanted_m, wanted_m, wanted_m};
    if (previous.count == count && blend > 0.0 && rises(previous.at_m, count)) {
        const bool goes_on = previous.to_m == wanted_m && rises(previous.from_m, count);
        ends = {previous.at_m, goes_on ? previous.from_m : previous.at_m, wanted_m};
        const double share = next_share(ends, count, blend, consumer, previous);
        for (std::uint32_t i = 0; i <= count; ++i)
            ends.at_m[i] = share < 1.0 ? ends.at_m[i] + share * (wanted_m[i] - ends.at_m[i]) : wanted_m[i];
        if (ends.at_m == wanted_m) ends.from_m = wanted_m;
    }
    next.count = count;
    next.at_m = ends.at_m;
    next.from_m = ends.from_m;
    next.to_m = ends.to_m;
    next.position_ws_m = consumer.position_ws_m;
    next.rotation_ws = consumer.rotation_ws;
    return ends;
}

}  // namespace gnomon::shadow
