#pragma once
#include <cstdint>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// Which textures a light's request asks for. None has a label: those are for what is made, and a longer one takes
/// memory, which a steady frame must not.
namespace gnomon::shadow {

/// Of what each texel of a map shows: an instance and a triangle (shaders/shadow/filters/triangles/mesh_walk.glsl).
inline constexpr gl::Format kTriangleFormat = gl::Format::rg32ui;

gl::TextureDesc without_label(const gl::TextureDesc& desc);

/// The depth map, of the edge that the light is given in this frame.
gl::TextureDesc map_desc(const LightItem& light, const ShadowRequest& request);

/// What each of its texels shows.
gl::TextureDesc triangles_of(const gl::TextureDesc& map);

/// Its moments, and what their blur needs between its two passes; width 0: there is none.
struct MomentDescs {
    gl::TextureDesc texture{.width = 0}, scratch{.width = 0};
};
MomentDescs moments_of(const gl::TextureDesc& map, const MapSettings& settings);

/// Rows of the scratch texture beyond the map's, above and below: a cube's neighbours go on there.
std::uint32_t scratch_rows(const MapSettings& settings, bool cube);

/// What else a map of FilterStorage::conservative_bounds has (docs/exact.md): what each texel shows, until the next
/// triangles behind are drawn, view by view in one layer; and, per view, those triangles' depths, and where sheets end
/// and how far they depart.
struct SheetDescs {
    gl::TextureDesc triangles, second, bounds;
};
SheetDescs sheets_of(const gl::TextureDesc& map);

/// Of all that a map for this storage has; of `moments` and `scratch` those with a width.
std::uint64_t map_bytes(const gl::TextureDesc& map, const FilterStorage& storage, const gl::TextureDesc& moments,
                        const gl::TextureDesc& scratch);
/// 0: it has no map.
std::uint64_t map_bytes(const LightItem& light, const ShadowRequest& request);

}  // namespace gnomon::shadow
