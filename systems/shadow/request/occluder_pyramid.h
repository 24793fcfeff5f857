#pragma once
#include <cstdint>

#include "systems/shadow/frame/shadow_view.h"

/// Occluder pyramid over a conservative shadow map, for area lights (docs/explanation/exact_proof.md, "A source with a
/// size"). A texel has two depths. The first is that of the occluder nearest to the light that may keep a place from
/// full light. The second is that of the nearest surface with a possible edge, which may keep it from full shadow. Each
/// level stores the nearest of these in squares of kEndsAcross by kEndsAcross. The texels' own depths are not stored,
/// because they follow from the map's other textures.
namespace gnomon::shadow {

/// Edge of a square, in squares of the level below. Equals kEndsAcross in
/// shaders/shadow/filters/exact/occluder_pyramid.glsl.
inline constexpr std::uint32_t kEndsAcross = 4;

/// One level of the pyramid of one view. `first`: index of its first square, from the view's start in the buffer.
/// `side`: number of squares along an edge.
struct PyramidLevel {
    std::uint32_t first = 0, side = 0;
};
/// Returns the level above a map of `size_px` texels.
PyramidLevel first_pyramid_level(std::uint32_t size_px);
/// Returns the level above another one. A level of one square is the last.
PyramidLevel next_pyramid_level(const PyramidLevel& level);

/// Returns the number of squares of one view.
std::uint32_t pyramid_count(std::uint32_t size_px);
/// Returns the bytes of the pyramids of all views.
std::uint64_t pyramid_bytes(std::uint32_t size_px, std::uint32_t views);

/// Limit of the stretch of the source's ellipse, and of a penumbra, away from a lamp's axis. Equals kMostStretch in
/// shaders/shadow/filters/exact/light_cone.glsl.
inline constexpr double kMostStretch = 2.5;

/// Returns the change of depth per texel above which a facet may lie within the cone between a place and the source.
/// `source_size`: metres, or the tangent of a sun's angular radius.
double steepest(const ShadowView& view, double texel_u, double texel_v, double source_size);

}  // namespace gnomon::shadow
