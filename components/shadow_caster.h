#pragma once
#include "components/shadow_layers.h"

namespace gnomon {

/// Add this to an entity with a MeshRef and it casts shadows.
struct ShadowCaster {
    bool enabled = true;
    ShadowLayers layers = kAllShadowLayers;  // lights of other layers do not see it
};

}  // namespace gnomon
