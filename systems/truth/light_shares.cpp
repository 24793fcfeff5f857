#include "systems/truth/light_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// Places that are traced together: more use more memory, fewer share less of their way through the trees.
constexpr std::size_t kPlacesAtOnce = 16384;

/// Fills in `places` of the square of one pixel around `middle_px`. A lattice, since rows of a grid lie all on one side
/// of an edge along them.
void fill_area(const glm::dvec2& middle_px, std::span<glm::dvec2> places) {
    constexpr double kGolden = 0.6180339887498949;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double turns = (static_cast<double>(i) + 0.5) * kGolden;
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(places.size());
        places[i] = middle_px + glm::dvec2(share, turns - std::floor(turns)) - 0.5;
    }
}

}  // namespace

bool has_size(const LightItem& light) { return source_extent(light) > 0.0f; }

ShareSteps share_steps(const LightItem& light, bool over_area) {
    if (!over_area) return {{1, 16}, {1, 256}};
    return has_size(light) ? ShareSteps{{1, 16}, {4, 64}} : ShareSteps{{4, 1}, {256, 1}};
}

/// Places of some pixels.
struct ShareTrace::Batch {
    std::vector<visibility::Place> places;
    std::vector<std::size_t> pixel_of;  // place by place
    SeenSurfaces found;                 // by one pixel's rays
    std::vector<glm::dvec2> at_px;      // places in the picture that these go through
    std::vector<float> shares;
};

bool ShareTrace::receives(std::size_t pixel) const {
    return receives_under(light_, scene_.instances[seen_.instance[pixel]]);
}

bool ShareTrace::faces_source(const glm::dvec3& at_ws_m, const glm::dvec3& normal_ws) const {
    const glm::dvec3 way = to_light(light_, at_ws_m);
    if (has_size(light_) && light_facts(light_.kind).area()) return sees_source(light_, way, normal_ws);
    return glm::dot(normal_ws, way) > kMinCosine * glm::length(way);
}

/// Returns whether the few rays of a pixel and of those around it met both light and casters.
bool ShareTrace::is_open(const LightTruth& few, const glm::ivec2& at) const {
    const glm::ivec2 last = glm::ivec2(seen_.size_px) - 1;
    const auto place = [&](int x, int y) { return static_cast<std::size_t>(y * (last.x + 1) + x); };
    const float own = few.visibility[place(at.x, at.y)];
    const glm::ivec2 from = glm::max(at - kNeighbours_px, glm::ivec2(0)), to = glm::min(at + kNeighbours_px, last);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            const float other = few.visibility[place(x, y)];
            if (few.scored[place(x, y)] == 0) continue;
            if ((other > 0.0f && other < 1.0f) || (other > 0.0f) != (own > 0.0f)) return true;
        }
    return false;
}

void ShareTrace::add_area(std::size_t pixel, std::uint32_t places, std::uint32_t& hint, Batch& batch) const {
    const std::array middle{glm::dvec2(0.0)};
    const visibility::LightRays reach(light_, middle);
    const glm::dvec2 middle_px(static_cast<double>(pixel % seen_.size_px.x),
                               static_cast<double>(pixel / seen_.size_px.x));
    batch.at_px.resize(places);
    fill_area(middle_px, batch.at_px);
    surfaces_->trace(batch.at_px, hint, batch.found);
    const double within_m = kSameSurface_px * surfaces_->pixel_width_m(seen_.position_ws_m[pixel]);
    const std::size_t before = batch.places.size();
    // The middle itself, as the surface may be so narrow that no other ray meets it.
    batch.places.push_back({seen_.position_ws_m[pixel], 0.0, seen_.normal_ws[pixel]});
    for (std::size_t i = 0; i < places; ++i) {
        const glm::dvec3 &at = batch.found.position_ws_m[i], &normal = batch.found.normal_ws[i];
        const double off_m = glm::dot(seen_.normal_ws[pixel], at - seen_.position_ws_m[pixel]);
        if (batch.found.instance[i] == kNoSurface || !(std::abs(off_m) <= within_m)) continue;
        if (!reach.reaches(at) || !faces_source(at, normal)) {
            batch.places.resize(before);
            truth_.scored[pixel] = 0;
            break;
        }
        batch.places.push_back({at, 0.0, normal});
    }
    batch.pixel_of.resize(batch.places.size(), pixel);
}

void ShareTrace::trace(std::span<const std::size_t> pixels, const ShareRays& rays,
                       visibility::LightQueries& queries) const {
    Batch batch;
    std::uint32_t hint = kNoSurface;
    const std::size_t at_once = kPlacesAtOnce / rays.places;
    for (std::size_t first = 0; first < pixels.size(); first += at_once) {
        const auto some = pixels.subspan(first, std::min(at_once, pixels.size() - first));
        batch.places.clear();
        batch.pixel_of.clear();
        for (const std::size_t pixel : some) {
            truth_.visibility[pixel] = 0.0f;
            if (surfaces_ != nullptr) {
                add_area(pixel, rays.places, hint, batch);
            } else {
                batch.places.push_back({seen_.position_ws_m[pixel], 0.0, seen_.normal_ws[pixel]});
                batch.pixel_of.push_back(pixel);
            }
        }
        batch.shares.resize(batch.places.size());
        queries.ask(scene_, light_, batch.places, {.samples = rays.samples}, batch.shares);
        for (std::size_t i = 0, end = 0; i < batch.shares.size(); i = end) {
            float sum = 0.0f;
            for (end = i; end < batch.shares.size() && batch.pixel_of[end] == batch.pixel_of[i]; ++end)
                sum += batch.shares[end];
            truth_.visibility[batch.pixel_of[i]] = sum / static_cast<float>(end - i);
        }
    }
}

void ShareTrace::trace_few(RowRange rows, visibility::LightQueries& queries) const {
    const std::array middle{glm::dvec2(0.0)};
    const visibility::LightRays reach(light_, middle);
    std::vector<std::size_t> pixels;
    const std::size_t first = std::size_t{rows.first} * seen_.size_px.x;
    for (std::size_t pixel = first; pixel < first + std::size_t{rows.count} * seen_.size_px.x; ++pixel) {
        if (seen_.instance[pixel] == kNoSurface) continue;
        truth_.visibility[pixel] = 0.0f;
        truth_.scored[pixel] = reach.reaches(seen_.position_ws_m[pixel]) &&
                               faces_source(seen_.position_ws_m[pixel], seen_.normal_ws[pixel]);
        if (truth_.scored[pixel] == 0) continue;
        if (receives(pixel))
            pixels.push_back(pixel);
        else
            truth_.visibility[pixel] = 1.0f;
    }
    trace(pixels, steps_.few, queries);
}

void ShareTrace::trace_undecided(RowRange rows, const LightTruth& few, visibility::LightQueries& queries) const {
    std::vector<std::size_t> pixels;
    for (std::uint32_t y = rows.first; y < rows.first + rows.count; ++y)
        for (std::uint32_t x = 0; x < seen_.size_px.x; ++x) {
            const std::size_t pixel = std::size_t{y} * seen_.size_px.x + x;
            if (truth_.scored[pixel] != 0 && receives(pixel) && is_open(few, {x, y})) pixels.push_back(pixel);
        }
    trace(pixels, steps_.many, queries);
}

}  // namespace gnomon::truth
