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

/// Per pixel, whether the surface ends or bends toward its right (kCreaseRight) and its upper neighbour (kCreaseUp):
/// either of the two does not lie on the other's plane, to within kPlaneTolerance of the distance from the camera, or
/// only one of them is a surface. Silhouettes, the edges of boxes, and those of each triangle of a curved mesh.
std::vector<std::uint8_t> creases(const PrimaryHits& hits);
inline constexpr std::uint8_t kCreaseRight = 1, kCreaseUp = 2;
inline constexpr double kPlaneTolerance = 1.0e-6;  // as kJitter: positions are not told apart below

/// Wrong pixels, scored and not ambiguous, farther from every true edge than max(kEdgeBandPx, allowed_px): those that
/// are as far from every crease and from the picture's border, beyond which an edge may lie, and the others.
struct FarErrors {
    std::size_t false_shadow = 0, false_light = 0;
    std::size_t crease_shadow = 0, crease_light = 0;
    std::vector<std::size_t> each;  // pixels of the first two
};
/// Whether the light truly reaches the plane of a pixel's surface, so far from the pixel's centre.
using LitBetween = std::function<bool(std::size_t pixel, const glm::dvec2& offset_px)>;

/// `creases` as above, `allowed_px` what half a texel and the filter's half-width measure on the screen, per pixel;
/// both of the picture's size. `lit` is asked kBetween times per pixel's width around those that no edge between pixel
/// centres explains: shadows and gaps may be narrower than a pixel. It is asked until kMostUnexplained remain
/// unexplained: a bias that is wrong darkens thousands, and all that follow are counted.
FarErrors far_errors(const ComparedPictures& pictures, std::span<const std::uint8_t> creases,
                     std::span<const float> allowed_px, const LitBetween& lit);
inline constexpr int kBetween = 16;
inline constexpr std::size_t kMostUnexplained = 100;

/// Asked of the tracer; all four must outlive the result.
LitBetween lit_between(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                       const LightItem& light);

}  // namespace gnomon::oracle
