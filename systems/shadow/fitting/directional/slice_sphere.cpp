#include "systems/shadow/fitting/directional/slice_sphere.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/volumes.h"

namespace gnomon::shadow {

SliceSphere slice_sphere(const ConsumerItem& consumer, double from_m, double to_m) {
    if (consumer.projection == CameraProjection::orthographic) {
        const double across_m = consumer.half_height_m * std::hypot(1.0, aspect(consumer));
        return {0.5 * (from_m + to_m), std::hypot(across_m, 0.5 * (to_m - from_m))};
    }
    // Corners lie at distance z along the axis and k z from it.
    const double k = std::tan(0.5 * consumer.fov_y_rad) * std::hypot(1.0, aspect(consumer));
    const double centre_m = std::min(0.5 * (from_m + to_m) * (1.0 + k * k), to_m);
    return {centre_m, std::hypot(to_m - centre_m, k * to_m)};
}

}  // namespace gnomon::shadow
