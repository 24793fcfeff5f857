#pragma once
#include <cstdint>

/// Margins of conservative maps, derived in docs/explanation/exact_proof.md. The same numbers are in
/// shaders/shadow/filters/exact/error_margins.glsl; the test SheetMargins.AreTheSameInShaders compares them.
namespace gnomon::shadow {

/// Error of a facet's normal, rounded to float, with the products and sums of its test; units of rounding.
inline constexpr double kFacingUnits = 4.0;

inline constexpr double kUnitRoundoff = 5.9604644775390625e-8;  // rounding unit of float, 2^-24

/// Error of a vertex before projection, in units of 2^-24 of the sizes of what is added. It sums its basis (1), three
/// products, two sums, the translation's difference and its sum (2).
inline constexpr double kPlacedUnits = 6.0;
/// The same for a row of the projection: four products and three sums.
inline constexpr double kProjectedUnits = 4.0;
/// Relative error of a position given as two floats: 2^-48.
inline constexpr double kSplitUnits = 3.552713678800501e-15;
/// Largest movement of a surface across the map by float's rounding, texels, beside the rasteriser's 2^-8.
inline constexpr double kMostMoved_texel = 0.05;
/// Factor on a depth slope over half a texel. It covers the errors of the receiver's place (0.008), of vertices and of
/// the rasteriser (2^-8), relative to half a texel. The rest is for interpolated depth.
inline constexpr double kDepartureFactor = 1.13;
/// Shortest height, as the map shows it, of facets that are not drawn, texels. A rasteriser moves corners by up to 2^-8
/// of a texel. It may take a narrower facet's slope from what is left of differences, with arbitrary depths.
inline constexpr double kLeastAltitude_texel = 1.0 / 64.0;
/// Reach of quads beyond their triangles and edges, texels. At least half a diagonal of a texel and its slack
/// (depth_range.vert, silhouettes.vert).
inline constexpr double kQuadReach_texel = 2.0;
/// Largest square of an item that is drawn as a point, texels. Float must move none of its corners by more than
/// kSmallMoved_texel across the map. A point is one vertex and one square instead of six vertices and two triangles.
/// Larger squares waste more texels on long, slanted items. 3 % of Sponza's items at 1024 texels are larger.
inline constexpr double kSmall_texel = 12.0, kSmallMoved_texel = 0.25;
/// Returns the side of the largest such point, pixels: the square, the reach of quads and kSmallMoved_texel on both
/// sides.
constexpr std::uint32_t most_point_px() {
    return static_cast<std::uint32_t>(kSmall_texel + 2.0 * (kQuadReach_texel + kSmallMoved_texel)) + 1;
}
/// Tangent between normal and light up to which a facet is not drawn (BoundsFloor).
inline constexpr double kFloorTangent = 4.0;
/// Rounding of depth in [0, 1], for facets that are not drawn.
inline constexpr double kFlatRounding = 6.0e-7;

}  // namespace gnomon::shadow
