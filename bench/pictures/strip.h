#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"

/// One view as a tutorial's shadow map draws it, as Gnomon does by default, and by rays.
namespace gnomon::bench {

struct StripLight {
    std::string name;
    std::size_t scored = 0, wrong = 0;  // pixels; wrong: on the other side of 1/2 than ray-traced truth
};
/// Column of the strip.
struct StripColumn {
    std::string name;                   // "tutorial", "gnomon", "truth"
    std::vector<std::string> settings;  // set for every light
    std::vector<StripLight> lights;
    std::vector<std::uint8_t> rgba;   // the whole picture, top row first
    std::vector<std::uint8_t> wrong;  // 1 where any light is wrong, rows from the bottom
    double share() const;             // wrong pixels of all lights, of the scored ones
};
struct Strip {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    glm::uvec2 part_low_px{0, 0}, part_px{0, 0};  // shown part, from the lower left
    std::vector<StripColumn> columns;
};

/// Draws and judges the three columns. The part that is shown has most edges of the first light's true shadow. Errors:
/// those of the frames; "bench.truth": the column by rays has a wrong pixel, and so is no truth.
Result<Strip> make_strip(Stage& stage);

/// Writes the strip: the pictures' parts above, below them in grey with wrong pixels in red.
std::optional<Error> write_strip(const Strip& strip, const std::filesystem::path& file);

/// Returns a table for people.
std::string strip_table(const Strip& strip);
/// Returns the figures by name, for pages (.ci/generate_pages.py).
std::string strip_json(const Strip& strip);

}  // namespace gnomon::bench
