#pragma once
#include <cstdint>

namespace gnomon {

/// Bits of up to eight shadow layers. Lights, casters and receivers each have a set, by default all layers.
/// - A caster darkens under a light only if `LightShadow::layers & ShadowCaster::layers` is not 0.
/// - A receiver is darkened by a light only if `LightShadow::layers & MeshRef::shadow_layers` is not 0. Otherwise the
///   light shines on it unoccluded.
/// Casters and receivers are not compared with each other, because all casters of a light share its map.
using ShadowLayers = std::uint8_t;
inline constexpr ShadowLayers kAllShadowLayers = 0xff;

}  // namespace gnomon
