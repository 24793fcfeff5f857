#pragma once
#include <cstdint>

#include "components/shadow_layers.h"

namespace gnomon {

/// Draws mesh number `mesh` of the MeshLibrary.
struct MeshRef {
    std::uint32_t mesh = 0;
    bool visible = true;                            // false: not drawn for any camera; still casts if a ShadowCaster
    bool receives_shadow = true;                    // false: always fully lit by every light
    ShadowLayers shadow_layers = kAllShadowLayers;  // always fully lit by lights of other layers
};

}  // namespace gnomon
