#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

namespace gnomon::picture {

/// Returns the place of sample `index` in a pixel, from its middle, pixels. Sample 0 is the middle. Any first n of them
/// are spread evenly: additive recurrence R2 of the plastic number (M. Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences").
glm::dvec2 sample_place_px(std::uint32_t index);

}  // namespace gnomon::picture
