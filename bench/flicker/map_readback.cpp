#include "bench/flicker/map_readback.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "bench/flicker/camera_path.h"
#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/oracle/traced_world.h"

namespace gnomon::bench {
namespace {

constexpr std::uint64_t kSeed = 20240229;
constexpr std::uint32_t kTriesPerPoint = 4;  // rays may end in the sky, or on what receives no shadow
constexpr std::uint32_t kNoTriangle = 0xffffffffu;  // as shaders/shadow/filters/triangles/mesh_walk.glsl
constexpr std::uint32_t kProbes = 2048;      // rays for the median distance

glm::dvec2 random_place(std::mt19937_64& random) {
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const double x = place(random);
    return {x, place(random)};
}

}  // namespace

Result<std::unique_ptr<ShadowFrames>> ShadowFrames::create(Stage& stage) {
    auto scene = GpuScene::create(stage.device(), stage.library());
    if (!scene) return scene.error();
    return std::unique_ptr<ShadowFrames>(new ShadowFrames(stage, std::move(scene).value()));
}

ShadowFrames::ShadowFrames(Stage& stage, GpuScene scene)
    : stage_(stage),
      gpu_scene_(std::move(scene)),
      shadows_(stage.device()),
      caster_triangles_(caster_triangles_of(stage.library())) {}

std::optional<Error> ShadowFrames::run(const ConsumerItem& consumer) {
    place_camera(consumer, stage_.world());
    return run();
}

std::optional<Error> ShadowFrames::run() {
    commands_.clear();
    report_.clear();
    const TransformReport& transforms = transforms_.update(stage_.world());
    extractor_.update(stage_.world(), stage_.library(), transforms, stage_.settings().viewport_px, snapshot_);
    gpu_scene_.update(snapshot_, commands_);
    shadows_.update(snapshot_, gpu_scene_, {}, commands_, report_);
    shadows_.report(snapshot_, {}, report_);
    const bool drawn = stage_.device().submit(commands_).failure == gl::Failure::none;
    shadows_.commit(snapshot_, drawn);
    if (snapshot_.consumers.empty()) return Error{"no usable camera", stage_.scene_name(), "", "bench.camera"};
    if (!drawn) return Error{"the maps cannot be drawn", stage_.scene_name(), "", "bench.map"};
    return read_maps();
}

bool ShadowFrames::read_layer(const shadow::ShadowView& view, const shadow::MapAssignment& assigned, bool reuse,
                              ReadMap& map) {
    const std::size_t layer_texels = std::size_t{assigned.size_px} * assigned.size_px;
    const std::size_t start = view.layer * layer_texels, end = start + layer_texels;
    if (map.texture != assigned.texture || map.copy.size_px != assigned.size_px)
        map = {assigned.texture, {view.projection == shadow::ViewProjection::cube_face, assigned.size_px, {}, {}}, {}};
    const auto read = [&](gl::TextureHandle texture, auto& texels) {
        const bool missing = texels.size() < end;
        if (reuse && !missing) return true;
        if (missing) texels.resize(end);
        const auto layer = std::span(texels).subspan(start, layer_texels);
        return stage_.device().read_texture(texture, view.layer, std::as_writable_bytes(layer));
    };
    if (!read(assigned.texture, map.copy.texels)) return false;
    if (!assigned.triangles) return true;
    if (assigned.triangle_bits == 0) return read(assigned.triangles, map.copy.triangles);
    if (!read(assigned.triangles, map.packed_triangles)) return false;
    map.copy.triangles.resize(map.packed_triangles.size());
    const std::uint32_t bits = assigned.triangle_bits, none = (1u << bits) - 1u;
    for (std::size_t i = start; i < end; ++i) {
        const std::uint32_t number = map.packed_triangles[i], triangle = number & none;
        map.copy.triangles[i] = {number >> bits, triangle == none ? kNoTriangle : triangle};
    }
    return true;
}

std::optional<Error> ShadowFrames::read_maps() {
    maps_.resize(snapshot_.lights.size());
    const shadow::DrawnViews drawn = shadow::drawn_views(shadows_.frame());
    for (std::size_t v = 0; v < drawn.count(); ++v) {
        if (!drawn.has_map(v)) continue;
        const shadow::ShadowView& view = drawn.view(v);
        if (!knows_filter(shadow::filter_row(shadows_.frame().decisions[view.light].request.map.filter))) continue;
        if (!read_layer(view, drawn.maps[v], drawn.updates[v].reuse, maps_[view.light]))
            return Error{"a depth map cannot be read", stage_.scene_name(), "", "bench.map"};
    }
    for (ReadMap& map : maps_) {  // faces that are no view were never read
        if (!map.copy.is_cube) continue;
        map.copy.texels.resize(std::size_t{6} * map.copy.size_px * map.copy.size_px, 0.0f);
        if (!map.copy.triangles.empty()) map.copy.triangles.resize(map.copy.texels.size());
    }
    return std::nullopt;
}

std::vector<SurfacePoint> surface_points(const SceneSnapshot& scene, const assets::MeshLibrary& library,
                                         std::span<const ConsumerItem> stations, std::uint32_t count) {
    const glm::dvec3 origin_ws_m = stations.front().position_ws_m;
    const oracle::TracedWorld world(scene, library, origin_ws_m);
    std::mt19937_64 random(kSeed);
    std::vector<SurfacePoint> points;
    for (std::size_t s = 0; s < stations.size(); ++s) {
        const std::size_t goal = count * (s + 1) / stations.size();
        for (std::size_t tries = kTriesPerPoint * (count / stations.size() + 1); tries > 0 && points.size() < goal;
             --tries) {
            const oracle::ExactRay ray = ray_through(stations[s], random_place(random), origin_ws_m);
            const oracle::SurfaceHit hit = world.nearest_surface(ray, stations[s].near_m, stations[s].far_m);
            if (hit.triangle == oracle::kNoTriangle) continue;
            const oracle::WorldTriangle& triangle = world.triangles()[hit.triangle];
            if (triangle.receive_layers == 0) continue;
            const glm::dvec3 normal = glm::normalize(oracle::front_normal(triangle));
            const bool back = glm::dot(normal, ray.direction) > 0.0;
            points.push_back({origin_ws_m + ray.origin + hit.t * ray.direction, back ? -normal : normal});
        }
    }
    return points;
}

double seen_distance_m(const SceneSnapshot& scene, const assets::MeshLibrary& library, const ConsumerItem& consumer) {
    const oracle::TracedWorld world(scene, library, consumer.position_ws_m);
    std::mt19937_64 random(kSeed);
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < kProbes; ++i) {
        const oracle::ExactRay ray = ray_through(consumer, random_place(random), consumer.position_ws_m);
        const oracle::SurfaceHit hit = world.nearest_surface(ray, consumer.near_m, consumer.far_m);
        if (hit.triangle != oracle::kNoTriangle) distances.push_back(hit.t);
    }
    if (distances.empty()) return 1.0;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

bool shines_on(const LightItem& light, const SurfacePoint& point) {
    const LightFacts& facts = light_facts(light.kind);
    if (facts.parallel) return glm::dot(point.normal_ws, light.rotation_ws[2]) > oracle::kMinCosine;
    const glm::dvec3 to_light = light.position_ws_m - point.position_ws_m;
    const double distance_m = glm::length(to_light);
    if (!(glm::dot(point.normal_ws, to_light) > oracle::kMinCosine * distance_m)) return false;
    if (light.range_m > 0.0 && distance_m > light.range_m) return false;
    return !facts.cone || glm::dot(to_light, light.rotation_ws[2]) > distance_m * std::cos(light.outer_cone_rad);
}

}  // namespace gnomon::bench
