#pragma once
#include <cstdint>

#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Layers of translucent casters that a view has: its nearest surfaces one by one, the rest in the last.
inline constexpr std::uint32_t kTintLayers = 4;

/// Textures of a light's layers of translucent casters, as shaders read them (shaders/shadow/lookup/tint/layers.glsl).
/// {0}: it has none.
struct TintTextures {
    gl::TextureHandle depths{};       // per layer of its map: depths of kTintLayers layers
    gl::TextureHandle absorbances{};  // per layer of its map kTintLayers in a row
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
