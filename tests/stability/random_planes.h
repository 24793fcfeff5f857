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
    std::uint64_t steep = 0;           // so steep that the offset is along the normal
};

/// Draws `count` random planes into their maps and counts how lookups judge them. Each step from plane to map errs at
/// worst by the bound below. Half of the planes take the worst of each at once, the others any part of it.
/// - vertices: snapped, so that all of the plane lies up to 1/256 texel aside along u and v.
/// - matrices: the floats that a frame would pass to the GPU.
/// - arithmetic: 2u of an orthographic range, 3u of a perspective depth and u of alpha; u = 2^-24. That is half of what
///   the bias allows, as the other half is the lookup's own.
/// - format: the nearest float; for fixed point either neighbour.
/// - receiver: error_m below its plane, half of kPositionRounding aside, its normal kNormalError_rad off.
/// - triangles: half of the planes show triangles to filters that read them, the others show none. They form a quad
///   around the receiver, one to sixteen times as large as a texel's footprint on the plane.
///
/// Receivers lie at the borders and corners between texels or anywhere in them; a third of a cube's lie beside seams.
/// The camera is up to a thousand times as far as the map is large, and error_m up to half of the light's distance.
/// Slopes are spread evenly over the logarithm of their tangent, 0.001 to 1000.
PlaneTally judge_planes(PlaneKind kind, ShadowFilter filter, DepthFormat format, std::uint64_t count,
                        std::uint64_t seed);

}  // namespace gnomon
