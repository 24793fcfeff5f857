#include <cmath>

#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/fitting/directional/slice_sphere.h"

namespace gnomon::shadow {
namespace {

/// Number of grid steps along the map's edge. A map stays for each walk of a 32nd of its edge, at 3 % more length.
constexpr double kPlaces = 32.0;

}  // namespace

bool fit_stable(const CascadeInput& input, OrthographicBox& box) {
    // Several cameras have no slice in common.
    if (input.of_all) return fit_quantised(input, box);
    const ConsumerItem& consumer = input.light.scene.consumers.front();
    const SliceSphere sphere = slice_sphere(consumer, input.from_m, input.to_m);
    if (!(sphere.radius_m > 0.0) || !std::isfinite(sphere.radius_m)) return false;

    const double side_m = with_border(2.0 * sphere.radius_m * (kPlaces / (kPlaces - 1.0)), input.light);
    const double size_px = input.light.request.map.resolution_px;
    const double place_m = std::max(std::floor(size_px / kPlaces), 1.0) * (side_m / size_px);
    const glm::dvec3 centre_ws = consumer.position_ws_m - consumer.rotation_ws[2] * sphere.centre_m;
    box.axes = input.basis;
    const glm::dvec3 snapped = glm::round((centre_ws * input.basis) / place_m) * place_m;
    place(input, input.basis * snapped, glm::dvec2(side_m), side_m, box);
    return true;
}

}  // namespace gnomon::shadow
