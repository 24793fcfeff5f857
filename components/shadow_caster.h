#pragma once

namespace gnomon {

/// Add this to an entity with a MeshRef and it casts shadows.
struct ShadowCaster {
    bool enabled = true;
};

}  // namespace gnomon
