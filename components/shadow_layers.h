#pragma once
#include <cstdint>

namespace gnomon {

/// A bit per layer of shadows, up to eight. Lights, casters and receivers have one each, all layers by default:
///   a caster darkens under a light   only if LightShadow::layers & ShadowCaster::layers   is not 0;
///   a receiver is darkened by it     only if LightShadow::layers & MeshRef::shadow_layers is not 0, else the light
///   shines on it as if nothing were in the way.
/// Caster and receiver are not compared with each other: all casters of a light share its map.
using ShadowLayers = std::uint8_t;
inline constexpr ShadowLayers kAllShadowLayers = 0xff;

}  // namespace gnomon
