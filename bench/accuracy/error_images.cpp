#include "bench/accuracy/error_images.h"

#include "bench/common/png_file.h"
#include "sample_game/support/files/image_files.h"
#include "systems/truth/error_colours.h"

namespace gnomon::bench {
namespace {

using truth::Colour;
using truth::error_colour;
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

}  // namespace

std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder) {
    if (auto error = game::make_writable_folder(folder)) return error;
    for (const LightAccuracy& light : accuracy.lights) {
        const auto file = [&](const char* what) { return folder / (light.report.name + what); };
        const auto truth = [&](std::size_t i) { return visibility_colour(light.truth.visibility[i]); };
        const auto measured = [&](std::size_t i) { return visibility_colour(light.measured[i]); };
        const auto off = [&](std::size_t i) {
            return error_colour({light.truth.visibility[i], light.measured[i], light.truth.scored[i] != 0,
                                 light.truth.ambiguous[i] != 0});
        };
        if (auto error = write(accuracy, file("_truth.png"), truth)) return error;
        const auto area = [&](std::size_t i) {
            const float lit = light.area->truth.lit[i];
            return visibility_colour(lit >= 0.0f ? lit : light.truth.visibility[i]);
        };
        if (light.area)
            if (auto error = write(accuracy, file("_area.png"), area)) return error;
        if (auto error = write(accuracy, file("_measured.png"), measured)) return error;
        if (auto error = write(accuracy, file("_error.png"), off)) return error;
    }
    return std::nullopt;
}

}  // namespace gnomon::bench
