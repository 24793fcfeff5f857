#pragma once
#include <cstdint>

#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Layers of translucent casters that a view has: its nearest surfaces one by one, the rest in the last.
inline constexpr std::uint32_t kTintLayers = 4;

/// What shaders read of a light's translucent casters (shaders/shadow/lookup/tint): textures of their layers, or their
/// tree. {0}: it has none.
struct TintTextures {
    gl::TextureHandle depths{};       // per layer of its map: depths of kTintLayers layers
    gl::TextureHandle absorbances{};  // per layer of its map kTintLayers in a row
    gl::BufferHandle tree{};          // in place of both, for rays: translucent triangles (visibility/tint_scene.h)
};

/// Layers of one view in this frame. No textures: nothing translucent casts in its light's maps, or there is no room.
struct TintAssignment {
    TintTextures textures;
    gl::TargetHandle depths{}, absorbances{};  // what the view's passes draw into
    std::uint32_t edge_px = 0;
    std::uint64_t content = 0;  // hash of what they are to show after this frame
    bool drawn = false;         // they are drawn in this frame; else they show it already
};

}  // namespace gnomon::shadow
