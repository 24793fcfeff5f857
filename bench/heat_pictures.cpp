#include "bench/heat_pictures.h"

#include <array>

#include "sample_game/picture_files.h"

namespace gnomon::bench {
namespace {

using Colour = std::array<std::uint8_t, 4>;
constexpr Colour kBlack{0, 0, 0, 255}, kGrey{70, 70, 70, 255}, kGreen{60, 170, 80, 255}, kDark{25, 45, 30, 255},
    kRed{255, 40, 40, 255}, kBlue{60, 120, 255, 255}, kYellow{255, 220, 0, 255}, kWhite{255, 255, 255, 255},
    kNoSurface{60, 0, 80, 255};
constexpr float kHalf = 0.5f;
constexpr float kByteMax = 255.0f;

Colour grey_of(float visibility) {
    if (!(visibility >= 0.0f)) return kNoSurface;
    const auto level = static_cast<std::uint8_t>(std::min(visibility, 1.0f) * kByteMax + kHalf);
    return {level, level, level, 255};
}

Colour error_of(const LightAccuracy& light, std::size_t pixel) {
    const float truth = light.truth.visibility[pixel], measured = light.measured[pixel];
    if (!light.truth.scored[pixel]) return truth < 0.0f ? kBlack : kGrey;
    if (light.truth.ambiguous[pixel]) return kWhite;
    if (!(measured >= 0.0f)) return kYellow;
    if (truth >= kHalf) return measured >= kHalf ? kGreen : kRed;
    return measured >= kHalf ? kBlue : kDark;
}

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
    return game::write_png(file, accuracy.size_px.x, accuracy.size_px.y, rgba);
}

}  // namespace

std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder) {
    if (auto error = game::make_writable_folder(folder)) return error;
    for (const LightAccuracy& light : accuracy.lights) {
        const auto file = [&](const char* what) { return folder / (light.report.name + what); };
        if (auto error =
                write(accuracy, file("_truth.png"), [&](std::size_t i) { return grey_of(light.truth.visibility[i]); }))
            return error;
        if (auto error =
                write(accuracy, file("_measured.png"), [&](std::size_t i) { return grey_of(light.measured[i]); }))
            return error;
        if (auto error = write(accuracy, file("_error.png"), [&](std::size_t i) { return error_of(light, i); }))
            return error;
    }
    return std::nullopt;
}

}  // namespace gnomon::bench
