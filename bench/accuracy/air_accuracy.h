#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"
#include "systems/extract/snapshot.h"

/// Shadows in fog: places along view rays, by the shaders' own text over the drawn maps, against rays.
namespace gnomon::bench {

/// One light in all boxes of fog.
struct AirAccuracy {
    std::size_t places = 0;  // places that the light may reach: within its range and cone
    std::size_t dark = 0;    // places that no ray from the light reaches
    std::size_t wrong = 0;   // more than a half off
    std::size_t ways = 0;    // view rays with such a place
    double way_error = 0.0;  // difference between a way's mean visibilities, mean over all ways
    double fraction(std::size_t n) const {
        return places > 0 ? static_cast<double>(n) / static_cast<double>(places) : 0.0;
    }
};

/// Part of a line, metres from its origin. Empty unless from_m < to_m.
struct LineSpan {
    double from_m = 0.0, to_m = 0.0;
};

/// Returns the part of a line within `span` that lies in a box of fog. `along`: unit.
LineSpan span_in_box(const InstanceItem& box, const glm::dvec3& half_extent_m, const glm::dvec3& origin_ws_m,
                     const glm::dvec3& along, LineSpan span);

/// Draws the maps for the first camera, and judges these lights in all fog before what it sees: one result for each.
/// Empty for a light that is left out, and for filters that soften by the source's size, or that cpu_lookup.h does not
/// know. Errors: those of ShadowFrames.
Result<std::vector<std::optional<AirAccuracy>>> measure_air(Stage& stage, std::span<const std::uint32_t> lights);

}  // namespace gnomon::bench
