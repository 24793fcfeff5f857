#pragma once
#include <cstdint>

#include "gnomon/assets.h"

namespace gnomon::bench {

/// Casters of a group. All groups have equally many plates of the same area, cut into more triangles or meshes.
struct SpeedGroup {
    std::uint32_t meshes = 1;  // draws of a view
    std::uint32_t cells = 2;   // along a plate's edge, two triangles each
};
inline constexpr std::uint32_t kSpeedPlates = 256;  // in each group

/// Makes a ground, seen from above, with the plates of all groups over it. `lamps` spots above them reach all of it.
/// Nodes of group g are named "group<g>". The caller chooses which lamp's light meets which group (ShadowLayers).
assets::SceneData speed_scene(const SpeedGroup* groups, std::uint32_t count, std::uint32_t lamps);

}  // namespace gnomon::bench
