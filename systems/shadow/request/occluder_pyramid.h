#pragma once
#include <cstdint>

#include "systems/shadow/frame/shadow_view.h"

/// What a source with a size asks of a map of sheets (docs/exact.md, "A source with a size"): per texel how near to the
/// light anything comes there that may keep a place from being lit by all of the source, or dark to all of it; and the
/// nearest of those in ever larger squares. The texels themselves are told by the map's other textures.
namespace gnomon::shadow {

/// Squares a side that one of the next level holds: kEndsAcross in shaders/shadow/filters/exact/occluder_pyramid.glsl.
inline constexpr std::uint32_t kEndsAcross = 4;

/// One level of squares of one view.
struct EndsLevel {
    std::uint32_t first = 0, side = 0;  // in the buffer, from where the view's begin; squares along an edge
};
/// The level above a map of `size_px` texels, or above another level; that of one square is the last.
EndsLevel first_ends(std::uint32_t size_px);
EndsLevel next_ends(const EndsLevel& level);

/// Squares of one view, and bytes of so many.
std::uint32_t ends_count(std::uint32_t size_px);
std::uint64_t ends_bytes(std::uint32_t size_px, std::uint32_t views);

/// By so much an ellipse may be longer, and a penumbra wider, away from a lamp's axis: kMostStretch in
/// shaders/shadow/filters/exact/light_cone.glsl.
inline constexpr double kMostStretch = 2.5;

/// Change of depth in a texel from which a facet may lie within the cone between a place and a source of this size:
/// metres, or a sun's tangent.
double steepest(const ShadowView& view, double texel_u, double texel_v, double source_size);

}  // namespace gnomon::shadow
