#pragma once
#include <cstdint>
#include <vector>

#include "systems/truth/seen_surfaces.h"
#include "systems/visibility/light_queries.h"

/// True visibility of a light on the surfaces that a camera sees.
namespace gnomon::truth {

inline constexpr double kMinCosine = 1.0e-4;  // below it shading is negligible, so that visibility is irrelevant
inline constexpr double kJitter = 1.0e-6;     // about 6 times the error of a position reconstructed from float depth

/// Values per pixel, rows bottom to top.
struct LightTruth {
    std::vector<float> visibility;  // as in --visibility: -1 no surface; 0 facing away, out of range or shadowed; 1 lit
    std::vector<std::uint8_t> scored;     // surfaces in range with cos(normal, light) > kMinCosine
    std::vector<std::uint8_t> ambiguous;  // scored, and the result changes when P moves by kJitter of its distance
    /// Resizes for a picture without any surface.
    void reset(std::size_t pixels);
};

/// Returns the light without its source's size: the reference for maps and metrics.
LightItem as_point(const LightItem& light);

/// Returns the cosine between a pixel's normal and the way to the light's middle; 0 at the light itself.
double cosine_to(const LightItem& light, const SeenSurfaces& seen, std::size_t pixel);

/// Half-open range of a picture's rows.
struct RowRange {
    std::uint32_t first = 0, count = 0;
};

/// Traces some rows. `light`: from as_point(). `queries` belongs to this thread; several threads may trace different
/// rows. Sends a ray from the surface to the light, and four more from around it.
void trace_rows(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, RowRange rows,
                visibility::LightQueries& queries, LightTruth& truth);

}  // namespace gnomon::truth
