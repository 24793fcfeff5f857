#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "tests/oracle/reference_tracer.h"

/// Ray-traced truth about the shadows of a source with a size.
namespace gnomon::oracle {

/// Returns the source's size as shadows take it: Light's radius in metres, or the tangent of a sun's angular radius. 0:
/// a point.
double source_size(const LightItem& light);

/// Maps the unit square to the unit disk, equal areas to equal areas (Shirley and Chiu 1997).
glm::dvec2 on_disk(const glm::dvec2& square);

struct SourceSampling {
    /// The disk is cut into side² parts of equal area, a ray through a random place of each.
    std::uint32_t side = 16;
    /// Traces (side / 4)² rays per pixel first. They suffice where all pixels of the 5 x 5 around it see all of the
    /// source along them, or all see none. What this misses is smaller than what two hundred rays hit on average; a
    /// test measures it.
    bool first_few = true;
};

/// One value per pixel of a PrimaryHits.
struct SoftTruth {
    std::vector<float> visibility;     // -1 no surface; else the fraction of the source that is seen, 0 to 1
    std::vector<std::uint8_t> scored;  // as LightTruth::scored
    std::size_t sampled = 0;           // pixels that got all rays
};

}  // namespace gnomon::oracle
