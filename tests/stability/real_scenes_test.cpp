#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include "gnomon/assets.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/extract/extract.h"
#include "systems/shadow/fitting/directional/slice_sphere.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/transform/transform_system.h"
#include "tests/data/data_files.h"
#include "tests/unit/shadow/fitting/directional/cascade_waste.h"
#include "tests/unit/shadow/random_scene.h"

/// What fits waste on scenes that others made. Every file of the test data is seen by its first camera, with a sun for
/// each fit, a lamp and a spot.
namespace gnomon::shadow {
namespace {

constexpr ShadowFit kFits[] = {ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised};
constexpr std::uint32_t kLamp = 3, kSpot = 4;

LightItem light_of(LightKind kind) {
    LightItem light;
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = 512;
    light.rotation_ws = math::basis_from_back({0.4, 1.0, 0.3});
    light.outer_cone_rad = 0.7;
    return light;
}

/// Returns the snapshot of a file's scene. Nothing: the file is refused, or contains nothing to see.
std::optional<SceneSnapshot> snapshot_of(const std::string& name) {
    auto scene = assets::load_gltf(test::data_folder() / name);
    if (!scene) return std::nullopt;
    ecs::Registry world;
    assets::MeshLibrary library;
    game::spawn_scene(std::move(scene).value(), world, library);
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    extractor.update(world, library, transforms.update(world), {1280, 720}, snapshot);
    math::Aabb all;
    for (const InstanceItem& item : snapshot.instances)
        all = math::extended(math::extended(all, item.bounds_ws.min), item.bounds_ws.max);
    if (math::is_empty(all) || !math::is_finite(all) || snapshot.consumers.empty()) return std::nullopt;
    snapshot.lights.clear();
    for (const ShadowFit fit : kFits) {
        snapshot.lights.push_back(light_of(LightKind::directional));
        snapshot.lights.back().tuning.cascades.fit = fit;
    }
    const double size_m = glm::length(math::half_extent(all));
    for (const LightKind kind : {LightKind::point, LightKind::spot}) {
        LightItem light = light_of(kind);
        light.position_ws_m = math::centre(all) + light.rotation_ws[2] * (0.8 * size_m);
        light.range_m = 4.0 * size_m;
        snapshot.lights.push_back(light);
    }
    return snapshot;
}

/// Returns numbers that are equal for scenes with equal boxes and camera: a fit sees no more. One set of files has the
/// same quad 166 times.
std::vector<double> looks_of(const SceneSnapshot& scene) {
    std::vector<double> looks;
    const auto add = [&](const glm::dvec3& v) { looks.insert(looks.end(), {v.x, v.y, v.z}); };
    for (const InstanceItem& item : scene.instances) {
        add(item.bounds_ws.min);
        add(item.bounds_ws.max);
    }
    add(scene.consumers[0].position_ws_m);
    add(scene.consumers[0].rotation_ws[2]);
    return looks;
}

struct Found {
    std::size_t scenes = 0;
    std::vector<double> tight, quantised, depth_gain;
    double stable_off = 0.0;  // share of the sphere's radius
    std::size_t spheres = 0;
};

void judge(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t v, Found& found) {
    const ShadowView& view = frame.fitted.views[v];
    const std::uint32_t light = view.light;
    if (light == kLamp || light == kSpot) {
        found.depth_gain.push_back(depth_step_m(1.0, 0.01, scene.lights[light].range_m, view.depth.far_m) /
                                   depth_step_m(1.0, view.depth.near_m, view.depth.far_m, view.depth.far_m));
        return;
    }
    if (kFits[light] == ShadowFit::tight) found.tight.push_back(waste(scene, frame, view));
    if (kFits[light] == ShadowFit::quantised) found.quantised.push_back(waste(scene, frame, view));
    if (kFits[light] != ShadowFit::stable) return;
    // Before a slice without receivers, a view serves farther than its own slice.
    const bool next = v + 1 < frame.fitted.views.size() && frame.fitted.views[v + 1].light == view.light;
    if (next && frame.fitted.views[v + 1].layer != view.layer + 1) return;
    constexpr double kPlace = 31.0 / 32.0;  // the rest is room to stay while the camera walks
    const double size_px = 512.0,
                 reach = static_cast<double>(frame.fitted.lights[view.light].request.map.filtering.widest_texel);
    const double border = 1.0 - 2.0 * border_px(size_px, reach) / size_px;
    const SliceSphere sphere = slice_sphere(scene.consumers[0], view.cascade.seen_from_m, view.cascade.seen_to_m);
    found.stable_off =
        std::max(found.stable_off, std::abs(view.plane.half_extent_m.x * border * kPlace / sphere.radius_m - 1.0));
    ++found.spheres;
}

TEST(RealScenes, FitsWasteLittleOfTheirMapsAndOfTheirDepth) {
    std::vector<std::string> files = test::data_files();
    if (files.empty()) GTEST_SKIP() << "no test data at " << test::data_folder();
    Found found;
    std::set<std::vector<double>> known;
    test::Watchdog watchdog;
    for (const std::string& name : files) {
        watchdog.watch(name);
        const std::optional<SceneSnapshot> scene = snapshot_of(name);
        if (!scene || !known.insert(looks_of(*scene)).second) continue;
        const ShadowFrame frame = fitted(*scene);
        found.scenes += frame.fitted.views.empty() ? 0 : 1;
        for (std::size_t v = 0; v < frame.fitted.views.size(); ++v) judge(*scene, frame, v, found);
    }
    ASSERT_GT(found.scenes, 20u);
    std::printf(
        "%zu scenes: waste of %zu tight views %.4f, of %zu quantised ones %.4f; %zu stable ones off by %.1e; "
        "depth of %zu local views %.0f times finer\n",
        found.scenes, found.tight.size(), median(found.tight), found.quantised.size(), median(found.quantised),
        found.spheres, found.stable_off, found.depth_gain.size(), median(found.depth_gain));
    EXPECT_LE(median(found.tight), 0.05);
    EXPECT_LE(median(found.quantised), 0.35);
    EXPECT_GT(found.spheres, 20u);
    EXPECT_LE(found.stable_off, 1e-3);
    EXPECT_GE(median(found.depth_gain), 20.0);
}

}  // namespace
}  // namespace gnomon::shadow
