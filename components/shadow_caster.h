#pragma once
#include "components/shadow_layers.h"

namespace gnomon {

/// Makes an entity with a MeshRef cast shadows.
struct ShadowCaster {
    bool enabled = true;
    ShadowLayers layers = kAllShadowLayers;  // lights of other layers do not see it
};

}  // namespace gnomon
