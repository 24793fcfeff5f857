#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/oracle/reference_tracer.h"

/// Ray-traced truth about the lit share of each pixel's area, and the distance of a picture from it.
namespace gnomon::oracle {

/// A pixel's area is a square one pixel wide around its centre. Rays of the camera through side² points of it, a
/// lattice, find places. A place counts if it lies on the surface that the pixel's centre sees.
///
/// That surface is what lies within kSameSurface_px of the tangent plane there: the seen triangle, its flat
/// neighbours, and facets that bend by little. A shadow ray in double then starts at the place itself, from its own
/// triangle.
struct AreaSampling {
    std::uint32_t side = 16;
    bool of_source = false;  // each place's ray goes to a place of its own on the source (source_size()), not its middle
};

/// Distance from the tangent plane up to which a place is on the same surface, widths of a pixel there.
inline constexpr double kSameSurface_px = 0.1;

enum class PixelArea : std::uint8_t {
    unscored,  // no surface, or the light reaches or faces not all of it
    whole,     // every place is on the seen surface
    partial,   // the camera sees another surface in part of it: that is up to the picture's own antialiasing
};

/// One value per pixel of a PrimaryHits.
struct AreaTruth {
    std::vector<float> lit;  // share of the places on the seen surface that the light reaches; -1: unscored
    std::vector<PixelArea> area;
    std::size_t sampled = 0;  // pixels that got all rays
};

/// Errors against that share. Only whole, unambiguous pixels count.
struct AreaMetrics {
    std::size_t crossed = 0;  // pixels with a share above 0 and below 1
    double mean_error = 0.0;  // difference from the share over them; no surface measured: 1
    double bias = 0.0;        // mean of measured - share over them; above 0: too bright
    double p99_error = 0.0;
    std::size_t uncrossed = 0;     // pixels with a share of 0 or 1
    double uncrossed_error = 0.0;  // mean error over these
    std::size_t partial = 0;       // pixels with PixelArea::partial and a share above 0 and below 1
    double partial_error = 0.0;    // mean error over these
};

/// Compares. `ambiguous`: flags of pixels that do not count; empty: all count.
AreaMetrics compare_area(const AreaTruth& truth, std::span<const float> measured,
                         std::span<const std::uint8_t> ambiguous);

}  // namespace gnomon::oracle
