#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"

/// Wrong pixels that no edge explains: where a bias proven for planes must not err.
namespace gnomon::oracle {

/// Finds, per pixel, if the surface ends or bends toward its right (kCreaseRight) or its upper neighbour (kCreaseUp).
/// It does if only one of the two pixels shows a surface, or if one lies off the other's plane.
/// Off means more than kPlaneTolerance of the distance from the camera.
/// Creases are silhouettes, the edges of boxes and the edges of each triangle of a curved mesh.
std::vector<std::uint8_t> creases(const PrimaryHits& hits);
inline constexpr std::uint8_t kCreaseRight = 1, kCreaseUp = 2;
inline constexpr double kPlaneTolerance = 1.0e-6;  // as kJitter: positions have no more precision

/// Wrong pixels, scored and not ambiguous, farther from every true edge than max(kEdgeBandPx, allowed_px).
struct FarErrors {
    std::size_t false_shadow = 0, false_light = 0;    // as far from creases and from the picture's border
    std::size_t crease_shadow = 0, crease_light = 0;  // nearer to a crease or the border, where an edge may hide
    std::vector<std::size_t> each;                    // indices of the pixels of the first two
};
/// Returns true if the light truly reaches the plane of a pixel's surface, at an offset from the pixel's centre.
using LitBetween = std::function<bool(std::size_t pixel, const glm::dvec2& offset_px)>;

/// Counts wrong pixels that no edge explains. `creases` is as above; `allowed_px` is half a texel and the filter's
/// half-width on the screen, per pixel. Both have the picture's size.
/// Calls `lit` kBetween times per pixel's width around pixels that no edge between pixel centres explains.
/// Shadows and gaps may be narrower than a pixel. After kMostUnexplained unexplained pixels all others count
/// without a search: a wrong bias darkens thousands.
FarErrors far_errors(const ComparedPictures& pictures, std::span<const std::uint8_t> creases,
                     std::span<const float> allowed_px, const LitBetween& lit);
inline constexpr int kBetween = 16;
inline constexpr std::size_t kMostUnexplained = 100;

/// Makes a test that casts the tracer's rays; all four must outlive the result.
LitBetween lit_between(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                       const LightItem& light);

}  // namespace gnomon::oracle
