#include "bench/accuracy/air_accuracy.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "bench/flicker/map_readback.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/oracle/light_reach.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/pixel_ray.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kStep_px = 8;  // from one view ray to the next, both ways
constexpr std::uint32_t kPlaces = 16;  // places on each, evenly spread: as many as fog_light.frag looks up

/// View ray before the surface that it meets.
struct ViewWay {
    glm::dvec3 origin_rel_m{0.0}, along{0.0};  // relative to the camera; unit
    LineSpan span;
};

std::vector<ViewWay> view_ways(const ConsumerItem& camera, const oracle::PrimaryHits& hits) {
    std::vector<ViewWay> ways;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        const oracle::PixelRay pixel =
            oracle::pixel_ray(camera, hits.camera_rel_m, {i % hits.size_px.x, i / hits.size_px.x});
        const double per_t_m = glm::length(pixel.ray.direction);
        ViewWay& way = ways.emplace_back();
        way.origin_rel_m = pixel.ray.origin;
        way.along = pixel.ray.direction / per_t_m;
        way.span = {pixel.t_min * per_t_m, pixel.t_max * per_t_m};
        if (hits.triangle[i] != oracle::kNoTriangle)
            way.span.to_m = glm::dot(hits.position_rel_m[i] - way.origin_rel_m, way.along);
    }
    return ways;
}

/// Places of the fog that a light may reach, way after way.
struct LitPlaces {
    std::vector<SurfacePoint> points;  // normals toward the light, as fog passes have them
    std::vector<std::size_t> ways;     // number of places of each way that has any
};

LitPlaces places_in_fog(const SceneSnapshot& scene, const LightItem& light, const std::vector<ViewWay>& ways) {
    const glm::dvec3& anchor_ws_m = scene.consumers.front().position_ws_m;
    LitPlaces lit;
    for (const FogItem& fog : scene.air.fogs) {
        const InstanceItem& box = scene.instances[fog.instance];
        if (!receives_under(light, box)) continue;
        for (const ViewWay& way : ways) {
            const LineSpan span =
                span_in_box(box, fog.half_extent_m, anchor_ws_m + way.origin_rel_m, way.along, way.span);
            if (!(span.from_m < span.to_m)) continue;
            const std::size_t before = lit.points.size();
            for (std::uint32_t i = 0; i < kPlaces; ++i) {
                const double at_m = glm::mix(span.from_m, span.to_m, (i + 0.5) / kPlaces);
                const glm::dvec3 place_rel_m = way.origin_rel_m + at_m * way.along;
                glm::dvec3 to_light;
                double t_max = 0.0;
                if (oracle::reach(light, light.position_ws_m - anchor_ws_m, place_rel_m, to_light, t_max))
                    lit.points.push_back({anchor_ws_m + place_rel_m, glm::normalize(to_light)});
            }
            if (lit.points.size() > before) lit.ways.push_back(lit.points.size() - before);
        }
    }
    return lit;
}

/// Traces whether the light reaches each place: 1 or 0.
std::vector<std::uint8_t> trace_places(const oracle::ReferenceTracer& tracer, const LightItem& light,
                                       const glm::dvec3& anchor_ws_m, const std::vector<SurfacePoint>& points) {
    constexpr std::size_t kTogether = 1024;
    std::vector<std::uint8_t> reached(points.size());
    const auto groups = static_cast<std::uint32_t>((points.size() + kTogether - 1) / kTogether);
    oracle::parallel_rows(groups, 0, [&](std::uint32_t group) {
        const std::size_t first = group * kTogether, last = std::min(first + kTogether, points.size());
        for (std::size_t i = first; i < last; ++i)
            reached[i] = !tracer.blocked(points[i].position_ws_m - anchor_ws_m, oracle::kNoTriangle, light, 0.0);
    });
    return reached;
}

AirAccuracy judge_places(const LitPlaces& lit, const std::vector<std::uint8_t>& reached,
                         const std::vector<ExactVisibility>& shown) {
    constexpr double kHalf = 0.5;
    AirAccuracy air;
    air.places = lit.points.size();
    air.ways = lit.ways.size();
    std::size_t i = 0;
    for (const std::size_t count : lit.ways) {
        double difference = 0.0;
        for (const std::size_t end = i + count; i < end; ++i) {
            const double off = static_cast<double>(shown[i].value) - reached[i];
            difference += off;
            air.dark += reached[i] == 0;
            air.wrong += !(std::abs(off) <= kHalf);
        }
        air.way_error += std::abs(difference) / static_cast<double>(count);
    }
    if (air.ways > 0) air.way_error /= static_cast<double>(air.ways);
    return air;
}

bool can_judge(const LightReport& report) {
    const shadow::FilterRow& filter = shadow::filter_row(report.filter.filter);
    return !is_left_out(report) && knows_filter(filter) && filter.width != shadow::FilterWidth::source;
}

}  // namespace

LineSpan span_in_box(const InstanceItem& box, const glm::dvec3& half_extent_m, const glm::dvec3& origin_ws_m,
                     const glm::dvec3& along, LineSpan span) {
    const glm::dmat3 box_from_world = glm::inverse(box.basis);
    const glm::dvec3 place = (box_from_world * (origin_ws_m - box.translation_ws_m)) / half_extent_m;
    const glm::dvec3 way = (box_from_world * along) / half_extent_m;
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) {
            if (!(std::abs(place[axis]) < 1.0)) return {};
            continue;
        }
        const double one_m = (-1.0 - place[axis]) / way[axis], other_m = (1.0 - place[axis]) / way[axis];
        span.from_m = std::max(span.from_m, std::min(one_m, other_m));
        span.to_m = std::min(span.to_m, std::max(one_m, other_m));
    }
    return span;
}

Result<std::vector<std::optional<AirAccuracy>>> measure_air(Stage& stage, std::span<const std::uint32_t> lights) {
    auto made = ShadowFrames::create(stage);
    if (!made) return made.error();
    ShadowFrames& frames = *made.value();
    if (auto error = frames.run()) return *error;
    const SceneSnapshot& scene = frames.snapshot();
    ConsumerItem camera = scene.consumers.front();
    camera.viewport_px = glm::max(camera.viewport_px / kStep_px, glm::uvec2(1));
    const oracle::ReferenceTracer tracer(scene, stage.library(), camera.position_ws_m);
    const std::vector<ViewWay> ways = view_ways(camera, tracer.trace_primary(camera));
    std::vector<std::optional<AirAccuracy>> found;
    for (const std::uint32_t index : lights) {
        std::optional<AirAccuracy>& air = found.emplace_back();
        if (!can_judge(frames.report().lights[index])) continue;
        const auto lookup = frames.exact_light(index);
        if (!lookup) continue;
        const LightItem& light = scene.lights[index];
        const LitPlaces lit = places_in_fog(scene, light, ways);
        std::vector<ExactVisibility> shown(lit.points.size());
        lookup->evaluate(lit.points, shown);
        air = judge_places(lit, trace_places(tracer, light, camera.position_ws_m, lit.points), shown);
    }
    return found;
}

}  // namespace gnomon::bench
