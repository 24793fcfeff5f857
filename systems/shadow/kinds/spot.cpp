#include <algorithm>
#include <cmath>

#include "systems/shadow/kinds/caster_depth.h"
#include "systems/shadow/kinds/cone_fade.h"
#include "systems/shadow/kinds/held_fit.h"
#include "systems/shadow/kinds/local_content.h"
#include "systems/shadow/kinds/openings.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/range_override.h"

/// Spot light: one perspective view of its cone, or the faces of a cube for a wide one (cone_fade.h). Each view is
/// cropped to what is seen of the receivers in it, and its depth runs from the nearest caster or receiver to the
/// farthest receiver; both in steps that are held (held_fit.h), so that a map stays valid while the camera walks.
namespace gnomon::shadow {
namespace {

/// What the view's border is made from.
float reach_texel(const FitInput& input, const TangentRectangle& crop, const PerspectiveRange& range) {
    const FilterDemand& filter = input.demand.filtering;
    if (!needs_distances(filter)) return input.reach_texel;
    const glm::dvec2 sides = crop.high - crop.low;
    // The source stands across the ray: away from the axis its picture is longer, as 1 / cos (source.glsl).
    const glm::dvec2 corner = glm::max(glm::abs(crop.low), glm::abs(crop.high));
    const double longer = std::sqrt(1.0 + glm::dot(corner, corner));
    const double widest =
        longer * static_cast<double>(filter.source_radius_m) * (1.0 / range.near_m - 1.0 / range.far_m);
    return penumbra_border_texel(input, std::min(sides.x, sides.y), widest);
}

/// One view, if there are both a receiver and a caster. False if its depth range is no range.
bool fit_opening(const FitInput& input, const LightOpening& opening, const Beam& beam, std::vector<ShadowView>& views) {
    const TangentRectangle whole{opening.low, opening.high};
    LocalContent content = visible_content(input, beam, whole);
    if (!content.receivers) return true;
    const HeldView& held = input.held.views[opening.held_as];
    HeldView next = held;
    const TangentRectangle crop = held_rectangle(content.footprint, whole, held, next);
    const bool has_size = needs_distances(input.demand.filtering);
    const auto reach = static_cast<double>(input.reach_texel);
    include_casters(input, beam, has_size ? with_border(crop, input.demand.resolution_px, reach) : crop, content);
    if (!content.casters) return true;
    const PerspectiveRange range = overridden(
        input.demand, held_range(content.nearest_m, content.farthest_m, is_near_free(input.demand), held, next));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;
    next.used = true;
    input.next.views[opening.held_as] = next;
    ShadowView view = perspective_view(beam.origin_ws_m, opening.axes, crop, range, input.demand.resolution_px,
                                       static_cast<double>(reach_texel(input, crop, range)));
    view.layer = opening.layer;
    view.held = true;
    views.push_back(view);
    return true;
}

}  // namespace

bool fit_spot(const FitInput& input, std::vector<ShadowView>& views) {
    input.next.cone = next_cone_fade(input.light.outer_cone_rad, input.held.cone);
    const LightOpenings openings = light_openings(input.light, input.demand);
    for (std::uint32_t i = 0; i < openings.count; ++i)
        if (!fit_opening(input, openings.items[i], input.beams[i], views)) return false;
    return true;
}

}  // namespace gnomon::shadow
