#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "engine/gl/commands.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/view_limits.h"

/// Where each depth map of a light lies in the debug view "depth", and how its depths become metres.
namespace gnomon::debug {

/// Matches Tile in shaders/debug/depth.frag (std140).
struct DepthTile {
    glm::vec4 place{0.0f};  // left, bottom and edge in pixels of the picture; w: layer
    glm::vec4 depth{0.0f};  // near and far in metres; alpha and beta of a perspective map, beta 0: orthographic
    glm::vec4 right{0.0f}, up{0.0f}, forward{0.0f};  // of a cube's face, seen from the light; the cube's axes
};
static_assert(sizeof(DepthTile) == 80);

inline constexpr std::uint32_t kMaxTiles = shadow::kMaxViews;  // kMaxTiles in shaders/debug/depth.frag

/// Matches DepthTiles in shaders/debug/depth.frag (std140).
struct DepthTiles {
    glm::ivec4 options{0};  // x: tiles
    DepthTile tiles[kMaxTiles];
};
static_assert(sizeof(DepthTiles) == 16 + kMaxTiles * sizeof(DepthTile));

/// Squares for `views`, all of one light, as large as `area` allows: in rows, or, if all are faces of a cube, unfolded
/// as the light sees them, so that neighbours meet at the edge they share:
///         +Y
///     -X  -Z  +X  +Z
///         -Y
/// A face that is alone stands alone. At most kMaxTiles; without any view, or without a pixel for each: none.
std::vector<DepthTile> depth_tiles(std::span<const shadow::ShadowView> views, const gl::Rect& area);

}  // namespace gnomon::debug
