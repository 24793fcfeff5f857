#pragma once
#include <cstdint>

/// Margins of sheets, as docs/exact.md derives them. The same numbers are in
/// shaders/shadow/filters/exact/error_margins.glsl; the test SheetMargins.AreTheSameInShaders holds them together.
namespace gnomon::shadow {

/// Error of a facet's normal, rounded to float, with the products and sums of its test; units of rounding.
inline constexpr double kFacingUnits = 4.0;

inline constexpr double kUnitRoundoff = 5.9604644775390625e-8;  // of float, 2^-24

/// Units of 2^-24 by which a vertex may be off before it is projected: its basis (1), three products, two sums, the
/// translation's difference and its sum (2), of the sizes of what is added.
inline constexpr double kPlacedUnits = 6.0;
/// And by a row of the projection: four products and three sums of the sizes of what is added.
inline constexpr double kProjectedUnits = 4.0;
/// Of a position given as two floats, relative: 2^-48.
inline constexpr double kSplitUnits = 3.552713678800501e-15;
/// How far float's rounding may move a sheet across the map, in texels, beside the rasteriser's 2^-8.
inline constexpr double kMostMoved_texel = 0.05;
/// Half of a texel, and what the receiver's place (0.008), vertices and the rasteriser (2^-8) may be off, over half a
/// texel; the rest is for interpolated depth.
inline constexpr double kDepartureFactor = 1.13;
/// Shortest height, as the map shows it, of facets that are not drawn. A rasteriser moves corners by up to 2^-8 of a
/// texel, and may take the slope of what is narrower from what is left of differences: its depths may be anything.
inline constexpr double kLeastAltitude_texel = 1.0 / 64.0;
/// How far quads over triangles and edges reach beyond them: no less than half a diagonal of a texel and its slack
/// (depth_range.vert, silhouettes.vert).
inline constexpr double kQuadReach_texel = 2.0;
/// Items in a square of that side are drawn as points, if float moves none of their corners by more than so much across
/// the map: one vertex and one square instead of six and two triangles. Larger squares waste more of their texels on
/// what is long and slanted. Of Sponza's items at 1024 texels 3 % are larger; other sides were not tried.
inline constexpr double kSmall_texel = 12.0, kSmallMoved_texel = 0.25;
/// Side of the largest such point: what a quad reaches beyond, on both sides, and kSmallMoved_texel.
constexpr std::uint32_t most_point_px() {
    return static_cast<std::uint32_t>(kSmall_texel + 2.0 * (kQuadReach_texel + kSmallMoved_texel)) + 1;
}
/// Tangent between normal and light up to which a facet is not drawn (SheetFloor).
inline constexpr double kFloorTangent = 4.0;
/// Of depth in [0, 1], for facets that are not drawn.
inline constexpr double kFlatRounding = 6.0e-7;

}  // namespace gnomon::shadow
