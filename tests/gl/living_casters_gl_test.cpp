#include <filesystem>
#include <ostream>

#include "engine/assets/gltf_loader.h"
#include "sample_game/spawn.h"
#include "tests/gl/traced_frame_fixture.h"

/// A caster that bends casts the shadow of the pose that it is in.
namespace gnomon {
namespace {

constexpr double kMostWrong = 0.005;
// Of a picture in which less is shadowed nothing is learnt.
constexpr std::size_t kLeastShadowed = 500;

class LivingCasters : public TracedFrameTest {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        settings.viewport_px = {640, 480};
    }
    /// The scene over a ground, with one light and a camera that look down on it. False: there is no such file.
    bool open(const char* path, LightKind kind, std::optional<std::size_t> animation = {}) {
        const auto file = std::filesystem::path(GNOMON_DATA_DIR) / path;
        if (!std::filesystem::exists(file)) return false;
        auto scene = assets::load_gltf(file);
        EXPECT_TRUE(scene) << to_line(scene.error());
        for (assets::Node& node : scene.value().nodes) node.light = node.camera = assets::kNone;
        spawned = game::spawn_scene(std::move(scene).value(), world, library);
        spawned.played = game::played_channels(spawned.animations, spawned.nodes, animation);
        const math::Aabb box = spawned.bounds_ws;
        const glm::dvec3 size(glm::length(box.max - box.min));
        const double s = size.x;
        ground = math::centre(box);
        ground.y = box.min.y - 0.02 * s;
        place(add_mesh(game::make_card(ground, {0.0, 0.0, 4.0 * s}, {4.0 * s, 0.0, 0.0})), {}, false);
        const glm::dvec3 above = kind == LightKind::directional ? glm::dvec3(0.5, 1.0, 0.3) : glm::dvec3(0.6, 1.6, 0.4);
        light_entity = spawned.lights.front().entity;
        const glm::dvec3 at = ground + s * above;
        world.patch<Transform>(light_entity, [&](Transform& t) { t = {at, looking_along(-above), glm::dvec3(1.0)}; });
        world.patch<Light>(light_entity, [&](Light& light) {
            light = {.kind = kind, .intensity = 1000.0f, .range_m = 0.0f, .outer_cone_rad = 0.9f};
        });
        const glm::dvec3 eye(-0.13 * s, 0.95 * s, 0.65 * s);
        world.patch<Transform>(spawned.cameras.front().entity, [&](Transform& t) {
            t = {ground + eye, looking_along(-eye), glm::dvec3(1.0)};
        });
        world.patch<Camera>(spawned.cameras.front().entity,
                            [&](Camera& c) { c = {.fov_y_rad = 0.9, .near_m = 0.01 * s, .far_m = 100.0 * s}; });
        return true;
    }
    void draw_at(double time_s) {
        game::set_time(spawned, time_s, world);
        draw();
    }
    static double wrong(const Judged& judged) { return judged.metrics.fraction(judged.metrics.wrong); }
    static std::size_t shadowed(const Judged& judged) {
        return static_cast<std::size_t>(std::count(judged.truth.begin(), judged.truth.end(), 0.0f));
    }

    game::SpawnedScene spawned;
    glm::dvec3 ground{0.0};
    ecs::Entity light_entity;
};

class LivingFox : public LivingCasters, public ::testing::WithParamInterface<LightKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, LivingFox, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(LivingFox, CastsTheShadowOfItsPoseAndOfNoOther) {
    constexpr const char* kFox = "fox-draco-testdata/Fox/glTF/Fox.gltf";
    if (!open(kFox, GetParam(), 2)) GTEST_SKIP() << "no scene file " << kFox << " in the data folder";
    ASSERT_EQ(spawned.animations.size(), 3u);
    draw_at(0.0);
    const SceneSnapshot start = frame().snapshot();
    for (const double time_s : {0.0, 0.2, 0.37, 0.55, 0.9}) {
        SCOPED_TRACE(time_s);
        draw_at(time_s);
        const Judged judged = judge();
        EXPECT_LE(wrong(judged), kMostWrong) << judged.metrics.wrong << " of " << judged.metrics.scored;
        EXPECT_GE(shadowed(judged), kLeastShadowed);
        RecordProperty("wrong_ppm_at_" + std::to_string(time_s), static_cast<int>(1e6 * wrong(judged)));
        if (time_s == 0.0) continue;
        SceneSnapshot stuck = frame().snapshot();
        stuck.poses = start.poses;
        EXPECT_GT(wrong(judge(0, stuck)), kMostWrong) << "the shadow does not tell one pose from another";
    }
}

}  // namespace
}  // namespace gnomon
