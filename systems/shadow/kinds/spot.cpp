#include "systems/shadow/kinds/cone_fade.h"
#include "systems/shadow/kinds/opening_view.h"
#include "systems/shadow/kinds/openings.h"
#include "systems/shadow/light_kinds.h"

/// Spot light: one perspective view of its cone, the faces of a cube for a wide one (cone_fade.h), or for a far one a
/// view of what is seen (lamp_aim.h).
namespace gnomon::shadow {

bool fit_spot(const FitInput& input, std::vector<ShadowView>& views) {
    input.next.cone = next_cone_fade(input.light.outer_cone_rad, input.held.cone);
    input.next.aim = input.demand.aim;
    const LightOpenings openings = light_openings(input.light, input.demand);
    for (std::uint32_t i = 0; i < openings.count; ++i)
        if (!fit_opening(input, openings.items[i], input.beams[i], views)) return false;
    return true;
}

}  // namespace gnomon::shadow
