#pragma once
#include <cstdint>

#include "tests/stability/lone_plane.h"

/// Random lone planes, each in the map that it would draw.
namespace gnomon {

struct PlaneTally {
    std::uint64_t planes = 0;
    std::uint64_t looked_up = 0;       // the others were lit without a look at the map
    std::uint64_t dark = 0;            // shadowed by themselves, if only in part: must be 0
    std::uint64_t dark_with_less = 0;  // the same with nine tenths of the automatic offset
    std::uint64_t steep = 0;           // of a slope that is offset along the normal
};

/// How a plane gets into its map, at worst; half of the planes take the worst of each at once, the others any.
///   vertices     snapped, so that all of the plane lies up to 1/256 texel aside along u and v
///   matrices     the floats that a frame would hand to the GPU
///   arithmetic   2u of an orthographic range, 3u of a perspective depth and u of alpha: half of what the bias allows,
///                as the other half is the lookup's own; u = 2^-24
///   format       float: the nearest; fixed point: either neighbour
///   receiver     error_m below its plane, half of kPositionRounding aside, its normal kNormalError_rad off
///   triangles    half of the planes show, to filters that ask, those of a quad around the receiver that reaches one to
///                sixteen times as far as a texel's footprint on the plane; the others show none
/// Receivers lie at the borders and corners between texels or anywhere in them; of a cube, a third beside seams.
/// The camera is up to a thousand times as far as the map is large, and error_m up to half of the light's distance.
/// Slopes are spread evenly over the logarithm of their tangent, 0.001 to 1000.
PlaneTally judge_planes(PlaneKind kind, ShadowFilter filter, DepthFormat format, std::uint64_t count,
                        std::uint64_t seed);

}  // namespace gnomon
