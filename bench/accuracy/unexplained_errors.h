#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bench/accuracy/edge_error_bounds.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/far_errors.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::bench {

/// A picture and one of its lights, as they were traced. `creases`: oracle::creases(hits).
struct TracedPicture {
    const oracle::ReferenceTracer& tracer;
    const oracle::PrimaryHits& hits;
    std::span<const std::uint8_t> creases;
    const SceneSnapshot& scene;
    std::uint32_t light = 0;  // index into the scene's lights
    const oracle::LightTruth& truth;
};

/// Returns the wrong pixels that lie farther from every true edge than half a texel and the filter's half-width, as
/// they measure on the screen. There should be none: on planes the bias is proven.
oracle::FarErrors errors_beyond_texels(const TracedPicture& picture, const EdgeBounds& bounds,
                                       const std::vector<float>& measured);

}  // namespace gnomon::bench
