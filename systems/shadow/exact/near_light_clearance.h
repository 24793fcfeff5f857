#pragma once
#include <span>
#include <vector>

#include "systems/shadow/frame/pass_inputs.h"

namespace gnomon::shadow {

/// Search radius around a local light with a size: the larger of these numbers of source radii and of near plane
/// distances.
inline constexpr double kClearance_radii = 32.0, kClearance_nears = 4.0;

/// Measures, for each area light with conservative maps (FilterStorage::occluder_pyramid), the distance to the nearest
/// triangle that its maps miss in part. A triangle counts if it comes within the source's radius of a light frustum and
/// lies partly outside that frustum's map. A frustum that is not drawn has no map. Metres, one per light, at most the
/// search radius; 0: another light. Computed in double, from triangles as they are bent.
void measure_clearances(const PassInputs& in, std::vector<double>& clearances_m, std::span<double> cpu_us);

}  // namespace gnomon::shadow
