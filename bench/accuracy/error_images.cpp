#include "bench/accuracy/error_images.h"

#include <functional>
#include <glm/common.hpp>
#include <vector>

#include "bench/common/png_file.h"
#include "sample_game/support/files/image_files.h"
#include "systems/truth/error_colours.h"

namespace gnomon::bench {
namespace {

using truth::Colour;
using truth::error_colour;
using truth::soft_error_colour;
using truth::visibility_colour;

template <class ColourOf>
std::optional<Error> write(const Accuracy& accuracy, const std::filesystem::path& file, const ColourOf& colour_of) {
    const std::size_t width = accuracy.size_px.x, height = accuracy.size_px.y;
    std::vector<std::uint8_t> rgba;
    rgba.reserve(width * height * 4);
    for (std::size_t row = 0; row < height; ++row)  // pictures start at the top, visibility at the bottom
        for (std::size_t x = 0; x < width; ++x) {
            const Colour colour = colour_of((height - 1 - row) * width + x);
            rgba.insert(rgba.end(), colour.begin(), colour.end());
        }
    return write_png(file, accuracy.size_px.x, accuracy.size_px.y, rgba);
}

/// Returns the colour of what passes through translucent casters.
Colour tint_colour(const glm::dvec3& share) {
    const glm::dvec3 level = glm::clamp(share, 0.0, 1.0) * 255.0 + 0.5;
    return {static_cast<std::uint8_t>(level.r), static_cast<std::uint8_t>(level.g), static_cast<std::uint8_t>(level.b),
            255};
}

float mean_of(const glm::dvec3& share) { return static_cast<float>((share.r + share.g + share.b) / 3.0); }

/// Picture of a light: what its file is named after, and the colour of each pixel.
struct Picture {
    const char* name;
    std::function<Colour(std::size_t)> colour_at;
};

/// Returns the pictures of a light, each beside its truth.
std::vector<Picture> pictures_of(const LightAccuracy& light) {
    std::vector<Picture> pictures;
    const auto add = [&](const char* name, std::function<Colour(std::size_t)> at) { pictures.push_back({name, at}); };
    add("_truth.png", [&](std::size_t i) { return visibility_colour(light.truth.visibility[i]); });
    add("_measured.png", [&](std::size_t i) { return visibility_colour(light.measured[i]); });
    add("_error.png", [&](std::size_t i) {
        return error_colour(
            {light.truth.visibility[i], light.measured[i], light.truth.scored[i] != 0, light.truth.ambiguous[i] != 0});
    });
    if (light.soft) {
        const oracle::SoftTruth& soft = light.soft->truth;
        add("_soft.png", [&](std::size_t i) { return visibility_colour(soft.visibility[i]); });
        add("_soft_error.png", [&](std::size_t i) {
            return soft_error_colour({soft.visibility[i], light.measured[i], soft.scored[i] != 0, false});
        });
    }
    if (light.area) {
        const auto lit = [&](std::size_t i) {
            const float share = light.area->truth.lit[i];
            return share >= 0.0f ? share : light.truth.visibility[i];
        };
        add("_area.png", [lit](std::size_t i) { return visibility_colour(lit(i)); });
        add("_area_error.png", [&, lit](std::size_t i) {
            return soft_error_colour({lit(i), light.measured[i], light.area->truth.lit[i] >= 0.0f, false});
        });
    }
    if (light.tint) {
        add("_tint.png", [&](std::size_t i) { return tint_colour(light.tint->truth[i]); });
        add("_tint_measured.png", [&](std::size_t i) { return tint_colour(glm::dvec3(light.tint->measured[i])); });
        add("_tint_error.png", [&](std::size_t i) {
            return soft_error_colour({light.truth.visibility[i] < 0.0f ? -1.0f : mean_of(light.tint->truth[i]),
                                      mean_of(glm::dvec3(light.tint->measured[i])), !(light.truth.visibility[i] < 0.0f),
                                      false});
        });
    }
    return pictures;
}

}  // namespace

std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder) {
    if (auto error = game::make_writable_folder(folder)) return error;
    for (const LightAccuracy& light : accuracy.lights)
        for (const Picture& picture : pictures_of(light))
            if (auto error = write(accuracy, folder / (light.report.name + picture.name), picture.colour_at))
                return error;
    return std::nullopt;
}

}  // namespace gnomon::bench
