#include "systems/shadow/fitting/local/fit_frustum.h"
#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/projection/spot_cube_transition.h"
#include "systems/shadow/request/light_kinds.h"

/// Spot light: one perspective view of its cone. A wide cone has the faces of a cube (spot_cube_transition.h). A far
/// spot has a view of what is seen (far_lamp_aim.h).
namespace gnomon::shadow {

bool fit_spot(const FitInput& input, std::vector<ShadowView>& views) {
    input.next.cone = next_spot_cube_transition(input.light.outer_cone_rad, input.previous.cone);
    input.next.aim = input.request.projection.aim;
    const LightFrusta frusta = light_frusta(input.light, input.request);
    for (std::uint32_t i = 0; i < frusta.count; ++i)
        if (!fit_frustum(input, frusta.items[i], input.hulls[i], views)) return false;
    return true;
}

}  // namespace gnomon::shadow
