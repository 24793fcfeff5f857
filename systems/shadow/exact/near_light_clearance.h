#pragma once
#include <span>
#include <vector>

#include "systems/shadow/frame/pass_inputs.h"

namespace gnomon::shadow {

/// How far from a lamp with a size to look for casters, in radii of its source and in distances of its maps' near
/// planes: the larger.
inline constexpr double kClearance_radii = 32.0, kClearance_nears = 4.0;

/// Measures, for each lamp whose maps are for a source with a size (FilterStorage::occluder_pyramid), how near to it
/// any caster's triangle comes that the map of an opening does not hold whole, behind its near plane, but that comes
/// within the source's radius of the opening's pyramid; of any opening, drawn or not. Metres, one per light, 0 of the
/// others; at most as far as is looked for. In double, of triangles as they are bent.
void measure_clearances(const PassInputs& in, std::vector<double>& clearances_m, std::span<double> cpu_us);

}  // namespace gnomon::shadow
