#include "systems/shadow/fitting/directional/caster_depth_range.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "systems/shadow/fitting/size_steps.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Moves near_m toward the sun until the range contains the highest caster that matters.
void include_casters(const FitInput& input, double radius_tan, OrthographicBox& box) {
    const glm::dmat3 size_along = {glm::abs(box.axes[0]), glm::abs(box.axes[1]), glm::abs(box.axes[2])};
    double near_m = box.near_m;
    for (const std::uint32_t i : input.casters) {
        const math::Aabb& bounds_ws = input.scene.instances[i].bounds_ws;
        const glm::dvec3 middle = (math::centre(bounds_ws) - box.anchor_ws_m) * box.axes;
        const glm::dvec3 half = math::half_extent(bounds_ws) * size_along;
        const double caster_near_m = -middle.z - half.z;
        if (!(caster_near_m < near_m)) continue;
        const glm::dvec2 aside_m = glm::abs(glm::dvec2(middle) - box.centre_m) - glm::dvec2(half) - box.half_extent_m;
        if (std::max(aside_m.x, aside_m.y) <= radius_tan * (box.far_m - caster_near_m)) near_m = caster_near_m;
    }
    if (!(near_m < box.near_m)) return;
    box.near_m = box.far_m - step_size(step_at_or_above((box.far_m - near_m) * (1.0 + kDepthSlack)));
}

}  // namespace

float penumbra_border_texel(const FitInput& input, double content, double aside) {
    const double texels = input.request.map.resolution_px * aside / (content + 2.0 * aside);
    const float most_texel = input.request.map.filtering.most_spread_texel;
    float wide_texel = 1.0f;
    while (wide_texel < most_texel && static_cast<double>(wide_texel) < texels) wide_texel *= 2.0f;
    return border_texel(input.request.map.filtering, std::min(wide_texel, most_texel));
}

bool fit_cascade(const CascadeInput& input, OrthographicBox& box) {
    const FilterSettings& filter = input.light.request.map.filtering;
    const CascadeFit fit = cascade_fit(input.light.light.tuning.cascades.fit);
    if (!needs_distances(filter)) return fit(input, box);
    const auto radius_tan = static_cast<double>(filter.sun_radius_tan);
    // Fits first for the depth range alone, because the widths of penumbrae follow from it.
    FitInput light = input.light;
    light.reach_texel = filter.reach_texel;
    CascadeInput cascade{light,      input.basis,  input.index,     input.from_m,
                         input.to_m, input.of_all, input.points_ws, input.stepping};
    if (!fit(cascade, box)) return false;
    include_casters(light, radius_tan, box);
    const double content_m = 2.0 * std::min(box.half_extent_m.x, box.half_extent_m.y);
    light.reach_texel = penumbra_border_texel(light, content_m, radius_tan * (box.far_m - box.near_m));
    if (!fit(cascade, box)) return false;
    include_casters(light, radius_tan, box);
    return true;
}

}  // namespace gnomon::shadow
