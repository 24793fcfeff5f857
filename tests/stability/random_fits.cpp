#include "tests/stability/random_fits.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

constexpr double kLattice_m = 0x1p-20;

double on_lattice(double value) { return std::round(value / kLattice_m) * kLattice_m; }
glm::dvec3 on_lattice(const glm::dvec3& v) { return {on_lattice(v.x), on_lattice(v.y), on_lattice(v.z)}; }

/// View distances from 2^-10 to 2^13 m: 13 octaves down or 26 up they are still counted.
constexpr std::uint32_t kFirstLikelyBin = 56, kLikelyBins = 92;
constexpr std::uint32_t kSizes_px[] = {16, 64, 512, 1024, 4096, 8192};
constexpr ShadowFit kFits[] = {ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised};
constexpr CascadeSplits kSplits[] = {CascadeSplits::practical, CascadeSplits::uniform, CascadeSplits::logarithmic,
                                     CascadeSplits::seen, CascadeSplits::sampled};

}  // namespace

glm::dvec3 RandomFits::direction() {
    if (chance(0.2)) {  // along an axis of the world, or nearly
        glm::dvec3 d(0.0);
        d[static_cast<int>(number(0.0, 3.0))] = chance(0.5) ? 1.0 : -1.0;
        return chance(0.5) ? d : glm::normalize(d + vector(1e-9));
    }
    glm::dvec3 d;
    do d = vector(1.0);
    while (!(glm::length(d) > 0.05 && glm::length(d) <= 1.0));
    return glm::normalize(d);
}

InstanceItem RandomFits::box(std::uint32_t index) {
    InstanceItem item;
    item.mesh = index % 3;
    item.gpu_slot = index;
    const glm::dvec3 centre = on_lattice(vector(size(1.0, 64.0)));
    glm::dvec3 half = size(0.01, 32.0) * glm::abs(vector(1.0));
    if (chance(0.2)) half[static_cast<int>(number(0.0, 3.0))] = 0.0;
    half = on_lattice(half);
    item.bounds_ws = {centre - half, centre + half};
    item.casts = chance(0.8);
    item.receives = chance(0.8);
    item.visible = chance(0.9);
    return item;
}

ConsumerItem RandomFits::camera(const SceneSnapshot& scene) {
    ConsumerItem camera;
    camera.entity = {1, 1};
    const math::Aabb& target = scene.instances[static_cast<std::size_t>(number(0.0, static_cast<double>(scene.instances.size())))].bounds_ws;
    camera.position_ws_m = on_lattice(math::centre(target) + size(0.5, 100.0) * direction());
    const glm::dvec3 back = camera.position_ws_m - math::centre(target) + vector(1.0);
    camera.rotation_ws = math::basis_from_back(back);
    const glm::dmat3 roll(glm::dvec3(std::cos(1.0), std::sin(1.0), 0), glm::dvec3(-std::sin(1.0), std::cos(1.0), 0), glm::dvec3(0, 0, 1));
    if (chance(0.5)) camera.rotation_ws = camera.rotation_ws * roll;
    camera.projection = chance(0.2) ? CameraProjection::orthographic : CameraProjection::perspective;
    camera.fov_y_rad = size(0.02, 2.6);
    camera.half_height_m = size(0.5, 100.0);
    camera.near_m = size(1e-3, 1.0);
    camera.far_m = chance(0.3) && camera.projection == CameraProjection::perspective ? std::numeric_limits<double>::infinity() : size(10.0, 1e4);
    camera.viewport_px = {640, 360};
    return camera;
}

void RandomFits::cascades(LightItem& light) {
    ShadowTuning::Cascades& tuning = light.tuning.cascades;
    tuning.fit = kFits[static_cast<std::size_t>(number(0.0, std::size(kFits)))];
    tuning.splits = kSplits[static_cast<std::size_t>(number(0.0, std::size(kSplits)))];
    light.shadow.cascades = static_cast<std::uint32_t>(number(0.0, kMaxCascades + 1.0));
    tuning.split_lambda = static_cast<float>(number(0.0, 1.0));
    if (chance(0.3)) tuning.blend = static_cast<float>(number(0.0, 0.5));
}

void RandomFits::eye(ShadowTuning::Projection& tuning) {
    tuning.kind = LightProjection::perspective;
    tuning.eye_angle_rad = static_cast<float>(size(0.01, 2.7));
    if (chance(0.5)) tuning.eye_distance_m = static_cast<float>(size(0.5, 500.0));
}

void RandomFits::depth_range(ShadowTuning::Projection& tuning) {
    if (chance(0.7)) tuning.near_m = static_cast<float>(size(0.01, 100.0));
    if (chance(0.7))
        tuning.far_m = (tuning.near_m > 0.0f ? tuning.near_m : 1.0f) * static_cast<float>(size(1.01, 100.0));
}

LightItem RandomFits::light(LightKind kind, const SceneSnapshot& scene) {
    LightItem light;
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = kSizes_px[static_cast<std::size_t>(number(0.0, std::size(kSizes_px)))];
    do {
        light.shadow.filter = filter_table()[static_cast<std::size_t>(number(0.0, static_cast<double>(filter_table().size())))].id;
    } while (filter_row(light.shadow.filter).rays);
    if (kind == LightKind::directional) {
        cascades(light);
        if (chance(0.15)) eye(light.tuning.projection);
    }
    if (chance(0.15)) depth_range(light.tuning.projection);
    const math::Aabb& near = scene.instances.front().bounds_ws;
    light.position_ws_m = on_lattice(chance(0.1) ? near.min : chance(0.2) ? math::centre(near) : vector(size(1.0, 128.0)));
    const math::Aabb& aim = scene.instances.back().bounds_ws;
    const glm::dvec3 away = light.position_ws_m - math::centre(aim) + vector(2.0);
    light.rotation_ws = math::basis_from_back(chance(kind == LightKind::spot ? 0.1 : 0.5) ? direction() : away);
    light.range_m = chance(0.3) ? 0.0 : size(0.5, 500.0);
    light.outer_cone_rad = chance(0.1) ? 1.5707963267948966 : size(0.05, 1.57);
    if (chance(0.05)) light.outer_cone_rad = size(1e-4, 0.05);
    return light;
}

/// Draws the depths of an earlier picture: a few distances, all or none, and sometimes those of another camera.
SampledDepths RandomFits::depths(const ConsumerItem& camera) {
    SampledDepths depths{.camera = chance(0.1) ? ecs::Entity{77, 7} : camera.entity};
    const double share = chance(0.2) ? 1.0 : number(0.0, 0.2);
    for (std::uint32_t bin = kFirstLikelyBin; bin < kLikelyBins + kFirstLikelyBin; ++bin)
        if (chance(share)) depths.pixels[bin] = static_cast<std::uint32_t>(size(1.0, 1e6));
    return depths;
}

SampledScene RandomFits::scene(LightKind kind) {
    SampledScene s;
    const auto count = static_cast<std::uint32_t>(number(1.0, 10.0));
    for (std::uint32_t i = 0; i < count; ++i) s.instances.push_back(box(i));
    const std::size_t cameras = chance(0.15) ? static_cast<std::size_t>(number(2.0, 5.0)) : 1;
    while (s.consumers.size() < cameras) s.consumers.push_back(camera(s));
    s.lights.push_back(light(kind, s));
    if (s.lights[0].tuning.cascades.splits == CascadeSplits::sampled) s.sampled_depths = depths(s.consumers[0]);
    return s;
}

SampledScene RandomFits::wild_scene(LightKind kind) {
    SampledScene s = scene(kind);
    const auto any = [&] { return (chance(0.5) ? 1.0 : -1.0) * (chance(0.05) ? 0.0 : size(1e-30, 1e30)); };
    const auto disturb = [&](double& value) {
        if (chance(0.1)) value = any();
    };
    for (InstanceItem& item : s.instances) {
        math::Aabb& box = item.bounds_ws;
        for (int i = 0; i < 3; ++i) {
            disturb(box.min[i]);
            disturb(box.max[i]);
            if (box.min[i] > box.max[i]) std::swap(box.min[i], box.max[i]);
        }
    }
    for (int i = 0; i < 3; ++i) {
        disturb(s.consumers[0].position_ws_m[i]);
        disturb(s.lights[0].position_ws_m[i]);
    }
    if (chance(0.1)) s.sampled_depths.pixels.front() = s.sampled_depths.pixels.back() = 1;
    if (chance(0.2)) s.lights[0].range_m = std::abs(any());
    if (chance(0.2)) s.lights[0].outer_cone_rad = size(1e-12, 1.5707);
    if (chance(0.2)) s.consumers[0].fov_y_rad = size(1e-12, 3.14159);
    if (chance(0.2)) s.consumers[0].far_m = s.consumers[0].near_m * (1.0 + size(1e-12, 1e20));
    return s;
}

void scale(SampledScene& s, int power) {
    const double by = std::exp2(power);
    for (InstanceItem& i : s.instances) i.bounds_ws = {i.bounds_ws.min * by, i.bounds_ws.max * by};
    for (ConsumerItem& c : s.consumers) {
        c.position_ws_m *= by;
        c.near_m *= by;
        c.far_m *= by;
        c.half_height_m *= by;
    }
    std::array<std::uint32_t, kDepthBins> shifted{};
    for (std::uint32_t bin = kFirstLikelyBin; bin < kLikelyBins + kFirstLikelyBin; ++bin)
        shifted[static_cast<std::size_t>(static_cast<int>(bin) + 4 * power)] = s.sampled_depths.pixels[bin];
    s.sampled_depths.pixels = shifted;
    for (LightItem& l : s.lights) {
        l.position_ws_m *= by;
        l.range_m *= by;
        ShadowTuning::Projection& given = l.tuning.projection;
        for (float* metres : {&given.near_m, &given.far_m, &given.eye_distance_m}) *metres *= static_cast<float>(by);
    }
}

void move(SceneSnapshot& s, const glm::dvec3& by_m) {
    for (InstanceItem& i : s.instances) i.bounds_ws = {i.bounds_ws.min + by_m, i.bounds_ws.max + by_m};
    for (ConsumerItem& c : s.consumers) c.position_ws_m += by_m;
    for (LightItem& l : s.lights) l.position_ws_m += by_m;
}

}  // namespace gnomon::shadow
