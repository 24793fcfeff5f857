#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/fitting/directional/min_area_rectangle.h"

namespace gnomon::shadow {
namespace {

/// Edge of the smallest texel, as a share of the largest extent. The anchor lies up to eight extents away (place()),
/// where a float resolves 2^-21 of one, and a lookup rounds about four times. Finer texels would resolve nothing, and
/// maps of edge-on receivers would be missed altogether.
constexpr double kLeastTexel = 4.0 / (1 << 21);

}  // namespace

bool fit_tight(const CascadeInput& input, OrthographicBox& box) {
    FitScratch& scratch = input.light.scratch;
    scratch.points.clear();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, size_m = 0.0;
    const glm::dvec3 origin_ws = input.points_ws.front();
    for (const glm::dvec3& p_ws : input.points_ws) {
        const glm::dvec3 p = (p_ws - origin_ws) * input.basis;
        scratch.points.emplace_back(p.x, p.y);
        lowest = std::min(lowest, p.z);
        highest = std::max(highest, p.z);
        size_m = std::max({size_m, std::abs(p_ws.x), std::abs(p_ws.y), std::abs(p_ws.z)});
    }
    const Rectangle rectangle = smallest_rectangle(scratch.points, scratch.hull, math::kClippedRounding * size_m);
    const glm::dvec2 extent = rectangle.max - rectangle.min;
    const double largest = std::max({extent.x, extent.y, highest - lowest});
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;

    box.axes[0] = input.basis[0] * rectangle.axis_u.x + input.basis[1] * rectangle.axis_u.y;
    box.axes[1] = input.basis[1] * rectangle.axis_u.x - input.basis[0] * rectangle.axis_u.y;
    box.axes[2] = input.basis[2];
    const glm::dvec2 least(largest * std::max(kLeastExtent, kLeastTexel * input.light.request.map.resolution_px));
    const glm::dvec2 middle = 0.5 * (rectangle.min + rectangle.max);
    const glm::dvec3 centre_ws =
        origin_ws + box.axes[0] * middle.x + box.axes[1] * middle.y + box.axes[2] * (0.5 * (lowest + highest));
    const glm::dvec2 sides = glm::max(extent, least);
    place(input, centre_ws, {with_border(sides.x, input.light), with_border(sides.y, input.light)}, highest - lowest,
          box);
    return true;
}

}  // namespace gnomon::shadow
