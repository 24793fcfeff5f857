#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/common/stage.h"
#include "tests/oracle/reference_tracer.h"

/// Where the picture shows another surface than the ray through the pixel's middle meets: vertices are snapped to 1/256
/// px. What reaches the one says nothing about the other.
namespace gnomon::bench {

/// A flag per pixel of the stage's last picture. Triangles of one plane are the same surface. Empty: the device does
/// not draw the picture's surfaces over again bit for bit, so that nobody knows.
std::optional<std::vector<std::uint8_t>> other_surfaces(Stage& stage, const oracle::ReferenceTracer& tracer,
                                                        const oracle::PrimaryHits& hits);

/// Leaves them out of what is counted, as ambiguous. Returns how many of the scored pixels those were that were not
/// left out before.
std::size_t leave_out(const std::vector<std::uint8_t>& other, oracle::LightTruth& truth);

}  // namespace gnomon::bench
