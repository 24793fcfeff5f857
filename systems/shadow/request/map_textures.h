#pragma once
#include <cstdint>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// Descriptions of the textures that a light's request needs. They have no labels, because a long label allocates
/// memory, which a steady frame must not do. Labels are added when a texture is created.
namespace gnomon::shadow {

/// Format of the triangle texture of a conservative map: instance and triangle per texel. Other maps have that of their
/// TriangleReferences.
inline constexpr gl::Format kTriangleFormat = gl::Format::rg32ui;

gl::TextureDesc without_label(const gl::TextureDesc& desc);

/// Describes the depth map, with the light's edge in this frame.
gl::TextureDesc map_desc(const LightItem& light, const ShadowRequest& request);

/// Describes the texture of the triangles that the map's texels show, of TriangleReferences::format.
gl::TextureDesc triangles_of(const gl::TextureDesc& map, gl::Format format);

/// Prefiltered map, and the result of its blur's first pass. Width 0: there is none.
struct PrefilterDescs {
    gl::TextureDesc texture{.width = 0}, scratch{.width = 0};
};
PrefilterDescs moments_of(const gl::TextureDesc& map, const MapSettings& settings);

/// Returns the additional rows of the scratch texture above and below the map's: a cube face's neighbours continue
/// there.
std::uint32_t scratch_rows(const MapSettings& settings, bool cube);

/// Textures of a conservative map (FilterStorage::conservative_bounds) beside its depths
/// (docs/explanation/exact_proof.md).
/// - `triangles`: triangle of each texel, read while the second layer is drawn; one layer for all views in turn.
/// - `second`: per view, depths of the next triangles behind.
/// - `bounds`: per view, depth of the nearest silhouette edge, and depth slope bound.
struct BoundsDescs {
    gl::TextureDesc triangles, second, bounds;
};
BoundsDescs bounds_descs_of(const gl::TextureDesc& map);

/// Returns the bytes of a map with all textures of its storage, and of `moments` and `scratch` where their width is not
/// 0. `references`: format of the triangles, if the storage has them.
std::uint64_t map_bytes(const gl::TextureDesc& map, const FilterStorage& storage, gl::Format references,
                        const gl::TextureDesc& moments, const gl::TextureDesc& scratch);
/// Returns the bytes of the light's map. 0: it has none.
std::uint64_t map_bytes(const LightItem& light, const ShadowRequest& request);

}  // namespace gnomon::shadow
