#include "systems/shadow/fitting/directional/slice_sphere.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/volumes.h"

namespace gnomon::shadow {

SliceSphere slice_sphere(const ConsumerItem& consumer, double from_m, double to_m) {
    // Corners lie at distance z along the axis and k z from it; k metres, if the view is orthographic.
    const double k = half_extent(consumer).y * std::hypot(1.0, aspect(consumer));
    if (consumer.projection == CameraProjection::orthographic)
        return {0.5 * (from_m + to_m), std::hypot(k, 0.5 * (to_m - from_m))};
    const double centre_m = std::min(0.5 * (from_m + to_m) * (1.0 + k * k), to_m);
    return {centre_m, std::hypot(to_m - centre_m, k * to_m)};
}

}  // namespace gnomon::shadow
