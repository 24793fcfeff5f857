#include "bench/pictures/edges.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>

#include "bench/common/png_file.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kSamples = 64, kGap_px = 4, kTimes = 2;
constexpr glm::uvec2 kPart_px{144, 144};
constexpr std::uint32_t kStep_px = 16;  // between places of the part that are tried

/// Returns the upper left corner of the part in which one sample differs most from many.
glm::uvec2 part_of(const Edges& edges, glm::uvec2 part_px) {
    glm::uvec2 best{0, 0};
    double most = -1.0;
    for (std::uint32_t y = 0; y + part_px.y <= edges.size_px.y; y += kStep_px)
        for (std::uint32_t x = 0; x + part_px.x <= edges.size_px.x; x += kStep_px) {
            double sum = 0.0;
            for (std::uint32_t v = y; v < y + part_px.y; ++v)
                for (std::uint32_t u = x; u < x + part_px.x; ++u) {
                    const std::size_t i = 4 * (std::size_t{v} * edges.size_px.x + u) + 1;
                    sum += std::abs(int{edges.pictures.one[i]} - edges.pictures.many[i]);
                }
            if (sum <= most) continue;
            most = sum;
            best = {x, y};
        }
    return best;
}

}  // namespace

Result<Edges> make_edges(Stage& stage) {
    Edges edges;
    edges.scene = stage.scene_name();
    edges.size_px = stage.settings().viewport_px;
    const auto pictures = draw_edges(stage.frame(), stage.world(), stage.settings(), kSamples);
    if (!pictures) return Error{"a picture cannot be drawn with all its samples", edges.scene, "", "bench.edges"};
    edges.pictures = *pictures;
    edges.errors = edge_errors(edges.pictures);
    return edges;
}

std::optional<Error> write_edges(const Edges& edges, const std::filesystem::path& file) {
    const glm::uvec2 part = glm::min(kPart_px, edges.size_px), low = part_of(edges, part), shown = kTimes * part;
    const std::array<const Rgba*, 3> columns = {&edges.pictures.one, &edges.pictures.smooth, &edges.pictures.many};
    const std::uint32_t width_px = 3 * shown.x + 2 * kGap_px;
    Rgba rgba;
    for (std::uint32_t y = 0; y < shown.y; ++y)
        for (std::uint32_t x = 0; x < width_px; ++x) {
            const std::uint32_t column = x / (shown.x + kGap_px), in = x % (shown.x + kGap_px);
            if (in >= shown.x) {
                rgba.insert(rgba.end(), {255, 255, 255, 255});
                continue;
            }
            const std::size_t pixel = std::size_t{low.y + y / kTimes} * edges.size_px.x + low.x + in / kTimes;
            const auto at = columns[column]->begin() + static_cast<std::ptrdiff_t>(4 * pixel);
            rgba.insert(rgba.end(), at, at + 3);
            rgba.push_back(255);
        }
    return write_png(file, width_px, shown.y, rgba);
}

std::string edges_table(const Edges& edges) {
    const EdgeErrors& e = edges.errors;
    char text[512];
    std::snprintf(
        text, sizeof text,
        "| mean squared difference to 64 samples | one sample | smoothed | times nearer |\n|---|---|---|---|\n"
        "| where one sample differs: %.1f %% of pixels | %.0f | %.0f | %.2f |\n"
        "| all pixels | %.1f | %.1f | %.2f |\n",
        100.0 * e.share, e.one, e.smooth, e.one / e.smooth, e.one_all, e.smooth_all, e.one_all / e.smooth_all);
    return text;
}

}  // namespace gnomon::bench
