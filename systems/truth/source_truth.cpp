#include "systems/truth/source_truth.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "systems/extract/light_facts.h"
#include "systems/extract/source_place.h"
#include "systems/visibility/light_rays.h"

namespace gnomon::truth {
namespace {

/// Distance of neighbours that count, too.
constexpr int kNeighbours_px = 2;

}  // namespace

bool has_size(const LightItem& light) { return source_extent(light) > 0.0f; }

bool SourceTrace::receives(std::size_t pixel) const {
    return receives_under(light_, scene_.instances[seen_.instance[pixel]]);
}

bool SourceTrace::faces_source(std::size_t pixel) const {
    const glm::dvec3 way = to_light(light_, seen_.position_ws_m[pixel]);
    if (light_facts(light_.kind).area()) return sees_source(light_, way, seen_.normal_ws[pixel]);
    return glm::dot(seen_.normal_ws[pixel], way) > kMinCosine * glm::length(way);
}

/// Returns whether the few rays of a pixel and of those around it met both light and casters.
bool SourceTrace::is_open(std::span<const float> few, const glm::ivec2& at) const {
    const glm::ivec2 last = glm::ivec2(seen_.size_px) - 1;
    const auto place = [&](int x, int y) { return static_cast<std::size_t>(y * (last.x + 1) + x); };
    const float own = few[place(at.x, at.y)];
    const glm::ivec2 from = glm::max(at - kNeighbours_px, glm::ivec2(0)), to = glm::min(at + kNeighbours_px, last);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            const float other = few[place(x, y)];
            if (truth_.scored[place(x, y)] == 0) continue;
            if ((other > 0.0f && other < 1.0f) || (other > 0.0f) != (own > 0.0f)) return true;
        }
    return false;
}

void SourceTrace::trace(std::span<const std::size_t> pixels, std::uint32_t samples,
                        visibility::LightQueries& queries) const {
    std::vector<visibility::Place> places;
    for (const std::size_t pixel : pixels) places.push_back({seen_.position_ws_m[pixel], 0.0, seen_.normal_ws[pixel]});
    std::vector<float> shares(places.size());
    queries.ask(scene_, light_, places, {.samples = samples}, shares);
    for (std::size_t i = 0; i < shares.size(); ++i) truth_.visibility[pixels[i]] = shares[i];
}

void SourceTrace::trace_few(RowRange rows, visibility::LightQueries& queries) const {
    const std::array middle{glm::dvec2(0.0)};
    const visibility::LightRays reach(light_, middle);
    std::vector<std::size_t> pixels;
    const std::size_t first = std::size_t{rows.first} * seen_.size_px.x;
    for (std::size_t pixel = first; pixel < first + std::size_t{rows.count} * seen_.size_px.x; ++pixel) {
        if (seen_.instance[pixel] == kNoSurface) continue;
        truth_.visibility[pixel] = 0.0f;
        truth_.scored[pixel] = reach.reaches(seen_.position_ws_m[pixel]) && faces_source(pixel);
        if (truth_.scored[pixel] == 0) continue;
        if (receives(pixel))
            pixels.push_back(pixel);
        else
            truth_.visibility[pixel] = 1.0f;
    }
    trace(pixels, kFewSamples, queries);
}

void SourceTrace::trace_undecided(RowRange rows, std::span<const float> few, visibility::LightQueries& queries) const {
    std::vector<std::size_t> pixels;
    for (std::uint32_t y = rows.first; y < rows.first + rows.count; ++y)
        for (std::uint32_t x = 0; x < seen_.size_px.x; ++x) {
            const std::size_t pixel = std::size_t{y} * seen_.size_px.x + x;
            if (truth_.scored[pixel] != 0 && receives(pixel) && is_open(few, {x, y})) pixels.push_back(pixel);
        }
    trace(pixels, kManySamples, queries);
}

}  // namespace gnomon::truth
