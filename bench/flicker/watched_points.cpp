#include "bench/flicker/watched_points.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bench/flicker/camera_path.h"
#include "tests/oracle/area_truth.h"

namespace gnomon::bench {
namespace {

// Finds crossed pixels as well as many places do, since pixels beside those are watched, too.
constexpr std::uint32_t kFindingSide = 4;

/// Returns whether an edge crosses the pixel or one of its neighbours.
bool is_beside_edge(const oracle::AreaTruth& truth, const glm::ivec2& size_px, const glm::ivec2& at) {
    for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, size_px.y - 1); ++y)
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, size_px.x - 1); ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x) + static_cast<std::size_t>(x);
            if (truth.area[i] == oracle::PixelArea::whole && truth.lit[i] > 0.0f && truth.lit[i] < 1.0f) return true;
        }
    return false;
}

/// Returns the pixel with the place in its square; kNoPixel if there is none.
std::size_t nearest_pixel(const PathFrame& frame, const glm::dvec3& point_ws_m) {
    if (!in_view(frame.pose, point_ws_m)) return kNoPixel;
    const glm::dvec2 at = glm::floor(place_px(frame.pose, point_ws_m) - frame.jitter_px + 0.5);
    const glm::dvec2 size(frame.pose.viewport_px);
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y)) return kNoPixel;
    return static_cast<std::size_t>(at.y) * frame.pose.viewport_px.x + static_cast<std::size_t>(at.x);
}

/// Returns whether the pixel's centre sees the point's surface. Its tangent plane passes by the point as near as by
/// places of one area (oracle::kSameSurface_px).
bool shows(const oracle::PrimaryHits& hits, const ConsumerItem& pose, std::size_t pixel, const SurfacePoint& point,
           const glm::dvec3& origin_ws_m) {
    if (hits.triangle[pixel] == oracle::kNoTriangle) return false;
    const glm::dvec3 off = point.position_ws_m - origin_ws_m - hits.position_rel_m[pixel];
    const double within_m = oracle::kSameSurface_px * pixel_width_m(pose, point.position_ws_m);
    return std::abs(glm::dot(hits.normal_ws[pixel], off)) <= within_m;
}

oracle::WatchedState state_of(oracle::PixelArea area) {
    if (area == oracle::PixelArea::unscored) return oracle::WatchedState::unreached;
    return area == oracle::PixelArea::partial ? oracle::WatchedState::partial : oracle::WatchedState::whole;
}

}  // namespace

std::vector<SurfacePoint> points_beside_edges(const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits,
                                              const ConsumerItem& camera, const glm::dvec3& origin_ws_m,
                                              const LightItem& light, std::uint32_t count) {
    const oracle::LightTruth middles = tracer.trace_light(hits, light, false);
    const oracle::AreaTruth truth = tracer.trace_area(camera, hits, middles, light, {kFindingSide});
    const glm::ivec2 size(hits.size_px);
    std::vector<std::size_t> beside;
    for (std::size_t i = 0; i < hits.count(); ++i)
        if (truth.area[i] == oracle::PixelArea::whole &&
            is_beside_edge(truth, size, {static_cast<int>(i % hits.size_px.x), static_cast<int>(i / hits.size_px.x)}))
            beside.push_back(i);
    std::vector<SurfacePoint> points;
    const std::size_t taken = std::min<std::size_t>(count, beside.size());
    for (std::size_t k = 0; k < taken; ++k) {
        const std::size_t pixel = beside[k * beside.size() / taken];
        points.push_back({origin_ws_m + hits.position_rel_m[pixel], hits.normal_ws[pixel]});
    }
    return points;
}

std::vector<WatchedFrames> trace_watched(const oracle::ReferenceTracer& tracer, const SceneSnapshot& scene,
                                         const glm::dvec3& origin_ws_m, const std::vector<WatchedLight>& lights,
                                         const std::vector<PathFrame>& frames, std::uint32_t area_side) {
    std::vector<WatchedFrames> watched(lights.size());
    for (const PathFrame& frame : frames) {
        const oracle::PrimaryHits hits = tracer.trace_primary(frame.pose, frame.jitter_px);
        for (std::size_t l = 0; l < lights.size(); ++l) {
            const std::vector<SurfacePoint>& points = lights[l].points;
            std::vector<std::size_t> pixels(points.size(), kNoPixel), seen, seen_by;
            std::vector<oracle::WatchedTruth> truth(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                pixels[i] = nearest_pixel(frame, points[i].position_ws_m);
                if (pixels[i] == kNoPixel) continue;
                truth[i].state = oracle::WatchedState::hidden;
                if (!shows(hits, frame.pose, pixels[i], points[i], origin_ws_m)) continue;
                seen.push_back(pixels[i]);
                seen_by.push_back(i);
            }
            const oracle::AreaTruth areas =
                tracer.trace_area(frame.pose, hits, seen, scene.lights[lights[l].light], {area_side});
            for (std::size_t k = 0; k < seen.size(); ++k) truth[seen_by[k]] = {state_of(areas.area[k]), areas.lit[k]};
            watched[l].pixels.push_back(std::move(pixels));
            watched[l].truth.push_back(std::move(truth));
        }
    }
    return watched;
}

double median_way_px(const std::vector<WatchedLight>& lights, const ConsumerItem& from, const ConsumerItem& to) {
    std::vector<double> ways;
    for (const WatchedLight& light : lights)
        for (const SurfacePoint& point : light.points)
            ways.push_back(glm::length(place_px(to, point.position_ws_m) - place_px(from, point.position_ws_m)));
    if (ways.empty()) return 0.0;
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::nth_element(ways.begin(), middle, ways.end());
    return *middle;
}

}  // namespace gnomon::bench
