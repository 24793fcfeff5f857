#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/common/stage.h"
#include "tests/oracle/reference_tracer.h"

/// Pixels in which the picture shows another surface than the ray through the pixel's middle meets: vertices are
/// snapped to 1/256 px. Light on one of them does not imply light on the other.
namespace gnomon::bench {

/// Returns a flag per pixel of the stage's last picture. Triangles of one plane are the same surface. Empty: unknown,
/// because the device does not repeat the picture's surfaces to the bit.
std::optional<std::vector<std::uint8_t>> other_surfaces(Stage& stage, const oracle::ReferenceTracer& tracer,
                                                        const oracle::PrimaryHits& hits);

/// Leaves them out of what is counted, as ambiguous. Returns how many of the scored pixels those were that were not
/// left out before.
std::size_t leave_out(const std::vector<std::uint8_t>& other, oracle::LightTruth& truth);

}  // namespace gnomon::bench
