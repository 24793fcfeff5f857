#pragma once
#include <cstdint>
#include <vector>

#include "systems/truth/seen_surfaces.h"
#include "systems/visibility/light_queries.h"

/// What a light truly does to the surfaces that a camera sees.
namespace gnomon::truth {

inline constexpr double kMinCosine = 1.0e-4;  // below it shading is nothing, so visibility decides nothing
inline constexpr double kJitter = 1.0e-6;     // about 6 times the error of a position rebuilt from float depth

/// One value per pixel, rows bottom to top.
struct LightTruth {
    std::vector<float> visibility;     // as --visibility: -1 no surface; 0 facing away, out of reach or shadowed; 1 lit
    std::vector<std::uint8_t> scored;  // surfaces within reach with cos(normal, light) > kMinCosine
    std::vector<std::uint8_t> ambiguous;  // scored, and the answer changes when P moves by kJitter of its distance
    /// Room for a picture; nothing is there.
    void reset(std::size_t pixels);
};

/// The light as a point, its source's size left out: what maps and metrics are about.
LightItem as_point(const LightItem& light);

/// Answers `rows` rows from `first_row` on. `light`: as_point(). `queries` answers for this thread alone; rows may be
/// traced at once by several. A ray goes from the surface itself to the light, four more from around it.
void trace_rows(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, std::uint32_t first_row,
                std::uint32_t rows, visibility::LightQueries& queries, LightTruth& truth);

}  // namespace gnomon::truth
