#pragma once
#include <cstddef>
#include <span>

#include "systems/extract/snapshot.h"
#include "tests/oracle/reference_tracer.h"

/// Whether a picture of visibility is the truth, to the pixel.
namespace gnomon::oracle {

/// Scored pixels of one light.
struct Exactness {
    std::size_t scored = 0;
    std::size_t ambiguous = 0;      // the truth itself hangs on the last digits (kJitter)
    std::size_t other_surface = 0;  // measured otherwise than the truth, where the rasteriser may have drawn another
                                    // surface than the ray through the pixel's centre meets
    std::size_t wrong = 0;          // all others that are measured otherwise
    std::size_t lit = 0, dark = 0;  // of those that are not ambiguous, by the truth
};

/// `measured` as --visibility, of the picture that `hits` and `truth` are of. Only 0 and 1 are right.
Exactness exactness(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                    const LightTruth& truth, std::span<const float> measured);

/// How far the rasteriser may move a vertex, along each axis: it snaps to 8 bits of a pixel (GL_SUBPIXEL_BITS of all
/// devices known), to the nearest; twice that, for edges that two such vertices turn.
inline constexpr double kRasterSnap_px = 2.0 / 512.0;

}  // namespace gnomon::oracle
