#include "bench/compare/crop_images.h"

#include <glm/common.hpp>

#include "bench/common/png_file.h"
#include "engine/image/encode_image.h"
#include "sample_game/support/files/image_files.h"
#include "systems/truth/error_colours.h"

namespace gnomon::bench {
namespace {

using truth::Colour;
using truth::ComparedPixel;
using truth::error_colour;
using truth::soft_error_colour;
using truth::visibility_colour;

constexpr std::uint32_t kPlaceStep_px = 16;
constexpr int kJpegQuality = 85;

/// Sums over all pixels to the left of and below each, so that those of a rectangle are four lookups.
class Sums {
public:
    Sums(const oracle::LightTruth& truth, glm::uvec2 size_px) : width_(size_px.x + 1) {
        sums_.assign(std::size_t{width_} * (size_px.y + 1), 0);
        for (std::uint32_t y = 0; y < size_px.y; ++y)
            for (std::uint32_t x = 0; x < size_px.x; ++x)
                at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + is_edge(truth, size_px, {x, y});
    }
    std::int64_t of(glm::uvec2 low, glm::uvec2 high) const {
        return at(high.x, high.y) - at(low.x, high.y) - at(high.x, low.y) + at(low.x, low.y);
    }

private:
    static std::int64_t is_edge(const oracle::LightTruth& truth, glm::uvec2 size_px, glm::uvec2 p) {
        const std::size_t here = std::size_t{p.y} * size_px.x + p.x;
        const auto differs = [&](std::size_t there) {
            return truth.scored[here] && truth.scored[there] && truth.visibility[here] != truth.visibility[there];
        };
        return (p.x + 1 < size_px.x && differs(here + 1)) || (p.y + 1 < size_px.y && differs(here + size_px.x));
    }
    std::int64_t& at(std::uint32_t x, std::uint32_t y) { return sums_[std::size_t{y} * width_ + x]; }
    std::int64_t at(std::uint32_t x, std::uint32_t y) const { return sums_[std::size_t{y} * width_ + x]; }

    std::uint32_t width_;
    std::vector<std::int64_t> sums_;
};

/// Returns the shown part, top row first. `colour_of(pixel)` counts rows from the bottom.
template <class ColourOf>
std::vector<std::uint8_t> part_of(glm::uvec2 low, glm::uvec2 part_px, std::uint32_t width, const ColourOf& colour_of) {
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t row = 0; row < part_px.y; ++row)
        for (std::uint32_t x = 0; x < part_px.x; ++x) {
            const Colour colour = colour_of(std::size_t{low.y + part_px.y - 1 - row} * width + low.x + x);
            rgba.insert(rgba.end(), colour.begin(), colour.end());
        }
    return rgba;
}

}  // namespace

glm::uvec2 shown_part(const oracle::LightTruth& truth, glm::uvec2 size_px, glm::uvec2 part_px) {
    const Sums edges(truth, size_px);
    part_px = glm::min(part_px, size_px);
    glm::uvec2 best{0, 0};
    std::int64_t most = -1;
    for (std::uint32_t y = 0; y + part_px.y <= size_px.y; y += kPlaceStep_px)
        for (std::uint32_t x = 0; x + part_px.x <= size_px.x; x += kPlaceStep_px)
            if (const std::int64_t count = edges.of({x, y}, glm::uvec2(x, y) + part_px); count > most) {
                most = count;
                best = {x, y};
            }
    return best;
}

Result<RowPictures> RowPictures::make(const std::filesystem::path& folder, const TracedTruths& truths) {
    if (auto error = game::make_writable_folder(folder)) return *error;
    RowPictures pictures(folder, truths.hits.size_px);
    const glm::uvec2 part_px = glm::min(kShownPart_px, pictures.size_px_);
    for (const TracedLight& light : truths.lights) {
        const glm::uvec2 low = pictures.shown_[light.name] = shown_part(light.point, pictures.size_px_);
        const auto write = [&](const char* name, const std::vector<float>& visibility) {
            const auto rgba = part_of(low, part_px, pictures.size_px_.x,
                                      [&](std::size_t i) { return visibility_colour(visibility[i]); });
            return write_png(folder / (light.name + name), part_px.x, part_px.y, rgba);
        };
        if (auto error = write("_point.png", light.point.visibility)) return *error;
        if (light.disk.visibility.empty()) continue;
        if (auto error = write("_disk.png", light.disk.visibility)) return *error;
    }
    return pictures;
}

std::optional<Error> RowPictures::write(const std::string& stem, const TracedLight& light,
                                        const std::vector<float>& measured, const std::vector<std::uint8_t>& rgba,
                                        bool by_disk) const {
    const glm::uvec2 part_px = glm::min(kShownPart_px, size_px_), low = shown_.at(light.name);
    const auto part = [&](const auto& colour_of) { return part_of(low, part_px, size_px_.x, colour_of); };
    const auto drawn = part([&](std::size_t i) {
        const std::size_t from_top = (size_px_.y - 1 - i / size_px_.x) * size_px_.x + i % size_px_.x;
        return from_top * 4 + 3 < rgba.size()
                   ? Colour{rgba[from_top * 4], rgba[from_top * 4 + 1], rgba[from_top * 4 + 2], 255}
                   : Colour{};
    });
    const auto shown = part([&](std::size_t i) { return visibility_colour(measured[i]); });
    const auto off = part([&](std::size_t i) {
        const auto& truth = by_disk ? light.disk.visibility : light.point.visibility;
        const ComparedPixel pixel{truth[i], measured[i], light.point.scored[i] != 0, light.point.ambiguous[i] != 0};
        return by_disk ? soft_error_colour(pixel) : error_colour(pixel);
    });
    const auto jpeg = encode_jpeg(part_px.x, part_px.y, drawn, kJpegQuality);
    if (auto error = game::write_file(folder_ / (stem + "_render.jpg"), std::as_bytes(std::span(jpeg)))) return error;
    if (auto error = write_png(folder_ / (stem + "_shown.png"), part_px.x, part_px.y, shown)) return error;
    return write_png(folder_ / (stem + "_error.png"), part_px.x, part_px.y, off);
}

}  // namespace gnomon::bench
