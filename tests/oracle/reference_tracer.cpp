#include "tests/oracle/reference_tracer.h"

#include <cmath>

#include "tests/oracle/light_reach.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/pixel_ray.h"
#include "tests/oracle/reference_world.h"

namespace gnomon::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One light over one picture.
struct LightTracer {
    const TracedWorld& world;
    const PrimaryHits& hits;
    const LightItem& light;
    glm::dvec3 light_rel_m;

    float trace(const glm::dvec3& point, std::uint32_t triangle, std::uint32_t& hint) const {
        glm::dvec3 to_light;
        double t_max = 0.0;
        if (!reach(light, light_rel_m, point, to_light, t_max)) return 0.0f;
        const ShadowLayers layers = light.shadow.layers;
        if ((world.triangles()[triangle].receive_layers & layers) == 0) return 1.0f;
        const std::uint32_t found = world.occluder(make_ray(point, to_light), t_max, triangle, hint, layers);
        if (found == kNoTriangle) return 1.0f;
        hint = found;
        return 0.0f;
    }

    // The jitter stays in the surface: off it, P would be inside its own solid and grazing rays would meet neighbours.
    bool flips(std::size_t pixel, float answer, std::uint32_t hint) const {
        const glm::dvec3& point = hits.position_rel_m[pixel];
        const double step_m = kJitter * glm::length(point - hits.camera_rel_m);
        for (const glm::dvec3& axis : tangents(hits.normal_ws[pixel]))
            for (const double sign : {-1.0, 1.0})
                if (trace(point + axis * (sign * step_m), hits.triangle[pixel], hint) != answer) return true;
        return false;
    }

    void trace_pixel(std::size_t pixel, bool with_ambiguous, std::uint32_t& hint, LightTruth& truth) const {
        if (hits.triangle[pixel] == kNoTriangle) return;
        truth.visibility[pixel] = 0.0f;
        const glm::dvec3& point = hits.position_rel_m[pixel];
        glm::dvec3 to_light;
        double t_max = 0.0;
        const bool reached = reach(light, light_rel_m, point, to_light, t_max);
        const double cosine = glm::length(to_light) > 0.0 ? cosine_between(hits.normal_ws[pixel], to_light) : 0.0;
        if (!(cosine > 0.0)) return;
        if (reached) truth.visibility[pixel] = trace(point, hits.triangle[pixel], hint);
        truth.scored[pixel] = reached && cosine > kMinCosine;
        if (with_ambiguous && truth.scored[pixel]) truth.ambiguous[pixel] = flips(pixel, truth.visibility[pixel], hint);
    }
};

// From `least_m` before a point to the light's middle, at t_max; 0: the light is not as far away.
struct WayToLight {
    ExactRay ray;
    double t_max = 0.0;
};

WayToLight way_to_light(const LightItem& light, const glm::dvec3& origin_ws_m, const glm::dvec3& point_rel_m,
                        double least_m) {
    const bool parallel = light.kind == LightKind::directional;
    const glm::dvec3 to_light = parallel ? light.rotation_ws[2] : light.position_ws_m - origin_ws_m - point_rel_m;
    const double distance_m = glm::length(to_light);
    if (!(parallel || distance_m > least_m)) return {};
    const glm::dvec3 start = point_rel_m + to_light * (least_m / distance_m);
    return {make_ray(start, parallel ? to_light : to_light * (1.0 - least_m / distance_m)), parallel ? kInfinity : 1.0};
}

}  // namespace

ReferenceTracer::ReferenceTracer(const SceneSnapshot& snapshot, const assets::MeshLibrary& library,
                                 const glm::dvec3& origin_ws_m, unsigned threads)
    : world_(new World{{snapshot, library, origin_ws_m}, threads}) {}

ReferenceTracer::~ReferenceTracer() = default;

std::size_t ReferenceTracer::triangle_count() const { return world_->traced.triangles().size(); }

PlacedTriangle ReferenceTracer::source_of(std::uint32_t triangle) const {
    if (triangle == kNoTriangle) return {};
    const WorldTriangle& found = world_->traced.triangles()[triangle];
    return {found.instance, found.first_index / 3};
}

PrimaryHits ReferenceTracer::trace_primary(const ConsumerItem& consumer, const glm::dvec2& jitter_px) const {
    const TracedWorld& world = world_->traced;
    const std::size_t count = std::size_t{consumer.viewport_px.x} * consumer.viewport_px.y;
    PrimaryHits hits;
    hits.size_px = consumer.viewport_px;
    hits.camera_rel_m = consumer.position_ws_m - world.origin_ws_m();
    hits.jitter_px = jitter_px;
    hits.triangle.assign(count, kNoTriangle);
    hits.position_rel_m.assign(count, glm::dvec3(0.0));
    hits.normal_ws.assign(count, glm::dvec3(0.0));
    parallel_rows(hits.size_px.y, world_->threads, [&](std::uint32_t row) {
        for (std::uint32_t x = 0; x < hits.size_px.x; ++x) {
            const PixelRay pixel = pixel_ray(consumer, hits.camera_rel_m, glm::dvec2(x, row) + jitter_px);
            const SurfaceHit hit = world.nearest_surface(pixel.ray, pixel.t_min, pixel.t_max);
            if (hit.triangle == kNoTriangle) continue;
            const WorldTriangle& triangle = world.triangles()[hit.triangle];
            const glm::dvec3 normal = glm::normalize(front_normal(triangle));
            const double side = glm::dot(normal, pixel.ray.direction);
            const glm::dvec3 point = pixel.ray.origin + pixel.ray.direction * hit.t;
            const std::size_t i = std::size_t{row} * hits.size_px.x + x;
            hits.triangle[i] = hit.triangle;
            hits.normal_ws[i] = side > 0.0 ? -normal : normal;
            // One Newton step puts the point on the plane to the last bits also where the ray grazes it.
            hits.position_rel_m[i] = point - normal * glm::dot(normal, point - triangle.a);
        }
    });
    return hits;
}

LightTruth ReferenceTracer::trace_light(const PrimaryHits& hits, const LightItem& light, bool with_ambiguous) const {
    const LightTracer tracer{world_->traced, hits, light, light.position_ws_m - world_->traced.origin_ws_m()};
    LightTruth truth;
    truth.visibility.assign(hits.count(), -1.0f);
    truth.scored.assign(hits.count(), 0);
    truth.ambiguous.assign(hits.count(), 0);
    parallel_rows(hits.size_px.y, world_->threads, [&](std::uint32_t row) {
        std::uint32_t hint = kNoTriangle;
        const std::size_t first = std::size_t{row} * hits.size_px.x;
        for (std::uint32_t x = 0; x < hits.size_px.x; ++x) tracer.trace_pixel(first + x, with_ambiguous, hint, truth);
    });
    return truth;
}

std::vector<float> ReferenceTracer::visibility(const PrimaryHits& hits, const LightItem& light) const {
    return trace_light(hits, light, false).visibility;
}

bool ReferenceTracer::sees_plane(const ConsumerItem& consumer, const glm::dvec2& at_px, std::uint32_t triangle) const {
    const TracedWorld& world = world_->traced;
    const PixelRay pixel = pixel_ray(consumer, consumer.position_ws_m - world.origin_ws_m(), at_px);
    const SurfaceHit hit = world.nearest_surface(pixel.ray, pixel.t_min, pixel.t_max);
    if (hit.triangle == kNoTriangle || hit.triangle == triangle) return hit.triangle == triangle;
    const glm::dvec3 point = pixel.ray.origin + pixel.ray.direction * hit.t;
    return world.on_plane(point, triangle);
}

std::uint32_t ReferenceTracer::blocker(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light,
                                       double least_m) const {
    const WayToLight way = way_to_light(light, world_->traced.origin_ws_m(), point_rel_m, least_m);
    if (way.t_max == 0.0) return kNoTriangle;
    return world_->traced.occluder(way.ray, way.t_max, triangle, kNoTriangle, light.shadow.layers);
}

std::uint32_t ReferenceTracer::nearest_to_light(const glm::dvec3& point_rel_m, std::uint32_t triangle,
                                                const LightItem& light, double least_m) const {
    const WayToLight way = way_to_light(light, world_->traced.origin_ws_m(), point_rel_m, least_m);
    if (way.t_max == 0.0) return kNoTriangle;
    return world_->traced.farthest_occluder(way.ray, way.t_max, triangle, light.shadow.layers);
}

bool ReferenceTracer::faces(std::uint32_t triangle, const LightItem& light) const {
    const WorldTriangle& t = world_->traced.triangles()[triangle];
    const glm::dvec3 to_light = light.kind == LightKind::directional
                                    ? light.rotation_ws[2]
                                    : light.position_ws_m - world_->traced.origin_ws_m() - t.a;
    return glm::dot(glm::cross(t.b - t.a, t.c - t.a), to_light) > 0.0;
}

std::vector<std::uint8_t> ReferenceTracer::ambiguous(const PrimaryHits& hits, const LightItem& light) const {
    return trace_light(hits, light, true).ambiguous;
}

}  // namespace gnomon::oracle
