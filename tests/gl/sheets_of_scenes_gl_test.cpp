#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/extract/extract.h"
#include "systems/transform/transform_system.h"
#include "tests/gl/sheet_views.h"
#include "tests/gl/sheets_fixture.h"
#include "tests/long_run.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/source_paths.h"

/// What sheets leave for rays in pictures of the built-in scene and of Sponza. They must be right about the rest. One
/// map covers all of the scene, without cascades.
namespace gnomon {
namespace {

constexpr glm::uvec2 kPicture_px{480, 270};

struct LoadedScene {
    ecs::Registry world;
    assets::MeshLibrary library;
    game::SpawnedScene spawned;
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
};

std::unique_ptr<LoadedScene> load(const std::optional<std::filesystem::path>& name) {
    std::optional<std::filesystem::path> file;
    if (name) file = test::data_folder() / *name;
    if (file && !std::filesystem::exists(*file)) return nullptr;
    auto scene = game::load_scene(file);
    EXPECT_TRUE(scene);
    auto loaded = std::make_unique<LoadedScene>();
    loaded->spawned = game::spawn_scene(std::move(scene).value(), loaded->world, loaded->library);
    game::set_time(loaded->spawned, 0.0, loaded->world);
    loaded->extractor.update(loaded->world, loaded->library, loaded->transforms.update(loaded->world), kPicture_px,
                             loaded->snapshot);
    return loaded;
}

class SheetsOfScenes : public SheetsTest {
protected:
    /// Judges the scene under a sun, a spot and a lamp of the test's own.
    void judge(LoadedScene& scene, const ConsumerItem& camera, double most_uncertain_percent) {
        const math::Aabb box = scene.snapshot.tree.box();
        const glm::dvec3 size = box.max - box.min;
        LightItem sun, spot, lamp;
        sun.kind = LightKind::directional;
        sun.rotation_ws = math::basis_from_back({0.25, 1.0, 0.15});
        spot.kind = LightKind::spot;
        spot.position_ws_m = box.min + size * glm::dvec3(0.2, 0.9, 0.5);
        spot.rotation_ws = math::basis_from_back({-0.5, 0.6, 0.1});
        spot.outer_cone_rad = 0.75;
        lamp.kind = LightKind::point;
        lamp.position_ws_m = box.min + size * glm::dvec3(0.45, 0.4, 0.52);
        const oracle::ReferenceTracer tracer(scene.snapshot, scene.library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        // Sheets know of masks, but not what is on them.
        assets::MeshLibrary drawn = scene.library;
        for (assets::Texture& texture : drawn.textures) {
            texture.width = texture.height = 1;
            texture.rgba.resize(4);
        }
        SceneSnapshot snapshot = scene.snapshot;
        snapshot.consumers = {camera};
        snapshot.pictures.clear();
        for (const LightItem& light : {sun, spot, lamp}) {
            snapshot.lights = {light};
            const oracle::LightTruth truth = tracer.trace_light(hits, light, true);
            for (const std::uint32_t size_px : {512u, 1024u, 2048u}) {
                if (size_px != 1024 && !is_long_run()) continue;
                const double uncertain =
                    judge_map(snapshot, drawn, hits, truth, views_of(light, box, size_px), size_px);
                if (size_px == 1024) {
                    EXPECT_LE(uncertain, most_uncertain_percent);
                }
            }
        }
    }

private:
    static std::vector<shadow::ShadowView> views_of(const LightItem& light, const math::Aabb& box,
                                                    std::uint32_t size_px) {
        const glm::dvec3 half = math::half_extent(box);
        if (light.kind == LightKind::directional) {
            shadow::OrthographicBox all;
            all.anchor_ws_m = math::centre(box);
            all.axes = light.rotation_ws;
            const auto reach = [&](int axis) { return glm::dot(glm::abs(all.axes[axis]), half) * 1.001; };
            all.half_extent_m = {reach(0), reach(1)};
            all.near_m = -reach(2);
            all.far_m = reach(2);
            return {shadow::orthographic_view(all, size_px)};
        }
        const shadow::PerspectiveRange range = shadow::perspective_range(0.05, 2.0 * glm::length(half));
        if (light.kind == LightKind::spot)
            return {shadow::perspective_view(light.position_ws_m, light.rotation_ws, shadow::TangentRectangle{}, range,
                                             size_px)};
        return test::cube_views(light, range, size_px);
    }

    /// Returns the uncertain share of the scored pixels, percent, and expects the other pixels to be right.
    double judge_map(const SceneSnapshot& snapshot, const assets::MeshLibrary& library, const oracle::PrimaryHits& hits,
                     const oracle::LightTruth& truth, const std::vector<shadow::ShadowView>& views,
                     std::uint32_t size_px) {
        const LightItem& light = snapshot.lights[0];
        std::vector<std::size_t> pixels;
        std::vector<glm::vec4> places_ca;
        for (std::size_t i = 0; i < hits.count(); ++i) {
            if (!truth.scored[i]) continue;
            pixels.push_back(i);
            const glm::dvec3& at = hits.position_rel_m[i];  // the tracer's origin is the camera
            places_ca.emplace_back(glm::vec3(at), static_cast<float>(6.0e-8 * glm::length(at)));
        }
        const Drawn drawn = draw(snapshot, library, views, size_px, true);
        const auto found = verdicts(drawn, light.kind, places_ca, true, true);
        discard(drawn);
        std::size_t uncertain = 0, wrong = 0, ambiguous = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (found[i] == Verdict::uncertain) {
                ++uncertain;
            } else if ((found[i] == Verdict::lit) != (truth.visibility[pixels[i]] > 0.5f)) {
                ++(truth.ambiguous[pixels[i]] ? ambiguous : wrong);
            }
        }
        const double percent = 100.0 * static_cast<double>(uncertain) / static_cast<double>(pixels.size());
        std::cout << "kind " << static_cast<int>(light.kind) << ", map of " << size_px << ": " << pixels.size()
                  << " pixels, " << percent << " % uncertain, " << wrong << " wrong, " << ambiguous << " ambiguous\n";
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(ambiguous, 0u);
        return percent;
    }
};

TEST_F(SheetsOfScenes, AreRightAboutMostOfTheCourtyard) {
    const auto scene = load({});
    ASSERT_TRUE(scene);
    judge(*scene, scene->snapshot.consumers.at(0), 17.0);
}

TEST_F(SheetsOfScenes, AreRightAboutMostOfSponza) {
    const auto scene = load("sponza-crytek/Sponza.gltf");
    if (!scene) GTEST_SKIP() << "Sponza is not there";
    ConsumerItem camera;
    const math::Aabb box = scene->snapshot.tree.box();
    camera.position_ws_m = box.min + (box.max - box.min) * glm::dvec3(0.25, 0.2, 0.5);
    camera.rotation_ws = math::basis_from_back(glm::normalize(glm::dvec3(-1.0, -0.1, 0.1)));
    camera.viewport_px = kPicture_px;
    judge(*scene, camera, 63.0);
}

}  // namespace
}  // namespace gnomon
