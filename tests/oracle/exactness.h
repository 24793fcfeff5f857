#pragma once
#include <cstddef>
#include <span>

#include "systems/extract/snapshot.h"
#include "tests/oracle/reference_tracer.h"

/// Comparison of a picture of visibility with the truth, exact to the pixel.
namespace gnomon::oracle {

/// Scored pixels of one light.
struct Exactness {
    std::size_t scored = 0;
    std::size_t ambiguous = 0;      // the truth itself depends on the last digits (kJitter)
    std::size_t other_surface = 0;  // measured otherwise than the truth, where the rasteriser may have drawn another
                                    // surface than the ray through the pixel's centre meets
    std::size_t wrong = 0;          // all other pixels that are measured otherwise
    std::size_t lit = 0, dark = 0;  // pixels that are not ambiguous, by the truth
};

/// Compares `measured`, a picture as --visibility writes it, with the truth. `hits` and `truth` belong to the same
/// picture. Only 0 and 1 are right.
Exactness exactness(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                    const LightTruth& truth, std::span<const float> measured);

/// Distance by which the rasteriser may move an edge, along each axis. It snaps vertices to the nearest place of 8 bits
/// of a pixel (GL_SUBPIXEL_BITS of all devices known). This is twice as much, for edges that two such vertices turn.
inline constexpr double kRasterSnap_px = 2.0 / 512.0;

}  // namespace gnomon::oracle
