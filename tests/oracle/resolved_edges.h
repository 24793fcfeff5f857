#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/oracle/edge_exceptions.h"

/// How far off the edges are of what a map resolves: casters, and gaps between them, wide enough for its texels. Rays
/// into the world decide what is wide enough, never the picture.
namespace gnomon::oracle {

struct ResolvedEdges {
    std::size_t places = 0;      // with a caster and a gap that are wide enough; the figures below are of these
    std::size_t unresolved = 0;  // narrower casters or gaps: the map need not show them
    std::size_t ambiguous = 0;   // the truth depends on the last digits
    /// Over absolute values. A hundredth of the places, or a thousandth, rounded up, is farther off.
    double p99_px = 0.0, p999_px = 0.0, max_px = 0.0;
    std::vector<std::size_t> each;  // indices into EdgeDisplacement::each, the farthest off first
};

/// Sorts the places of `edge`. A place is resolved if both of its pixels lie in wide squares. Throughout the dark
/// pixel's square the light meets one piece of a caster first; the bright pixel's is lit throughout. The squares are
/// as wide as (1/2 + E) diagonals of a texel, along the map's rows and columns. They lie on the plane that the pixel
/// shows and its continuation. Each then contains a texel that decides the pixel, wherever the map's texels lie.
/// Casters count that stand off the plane by more than its own rise over the texel, and than the depth format's steps.
/// `pieces`: a number per triangle of the tracer (CasterPieces).
ResolvedEdges resolved_edges(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                             const LightItem& light, const LightTruth& truth, const EdgeDisplacement& edge,
                             std::span<const std::uint32_t> pieces, const TexelAt& texel_at);

}  // namespace gnomon::oracle
