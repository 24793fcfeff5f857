#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "engine/gl/commands.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/view_limits.h"

/// Place of each depth map of a light in the debug view "depth", and its conversion from depths to metres.
namespace gnomon::debug {

/// Depth map's place and conversion; matches Tile in shaders/debug/depth.frag (std140).
struct DepthTile {
    glm::vec4 place{0.0f};  // left, bottom and edge in pixels of the picture; w: layer
    glm::vec4 depth{0.0f};  // near and far in metres; alpha and beta of a perspective map, beta 0: orthographic
    glm::vec4 right{0.0f}, up{0.0f}, forward{0.0f};  // cube face: its axes as the light sees them, in the cube's axes
};
static_assert(sizeof(DepthTile) == 80);

inline constexpr std::uint32_t kMaxTiles = shadow::kMaxViews;  // kMaxTiles in shaders/debug/depth.frag

/// Uniform block; matches DepthTiles in shaders/debug/depth.frag (std140).
struct DepthTiles {
    glm::ivec4 options{0};  // x: number of tiles
    DepthTile tiles[kMaxTiles];
};
static_assert(sizeof(DepthTiles) == 16 + kMaxTiles * sizeof(DepthTile));

/// Arranges squares for `views`, all of one light, as large as `area` allows. A single face stands alone. Several are
/// in rows; a cube's faces are unfolded as the light sees them, so that neighbours meet at their common edge.
///         +Y
///     -X  -Z  +X  +Z
///         -Y
/// At most kMaxTiles; empty without any view, or without a pixel for each.
std::vector<DepthTile> depth_tiles(std::span<const shadow::ShadowView> views, const gl::Rect& area);

}  // namespace gnomon::debug
