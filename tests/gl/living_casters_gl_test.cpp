#include <algorithm>
#include <filesystem>
#include <ostream>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "tests/gl/traced_frame_fixture.h"
#include "tests/source_paths.h"

/// A caster that bends casts the shadow of the pose that it is in.
namespace gnomon {
namespace {

constexpr double kMostWrong = 0.005;
// With fewer shadowed pixels a picture shows nothing about shadows.
constexpr std::size_t kLeastShadowed = 500;

class LivingCasters : public TracedFrameTest {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        settings.viewport_px = {640, 480};
    }
    /// Opens the scene over a ground, with one light and a camera that look down on it. False: there is no such file.
    bool open(const char* path, LightKind kind, std::optional<std::size_t> animation = {}) {
        const auto file = test::data_folder() / path;
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
        EXPECT_GT(wrong(judge(0, start)), kMostWrong) << "the shadow does not tell one pose from another";
    }
}

struct AnimatedFile {
    const char* name;
    const char* path;
    double time_s;  // at which it is far from where it began
    friend void PrintTo(const AnimatedFile& file, std::ostream* out) { *out << file.name; }
};
class LivingFiles : public LivingCasters, public ::testing::WithParamInterface<AnimatedFile> {};
constexpr const char* kGenerated = "gltf-asset-generator/Positive/";
INSTANTIATE_TEST_SUITE_P(
    Data, LivingFiles,
    ::testing::Values(AnimatedFile{"Skin", "Animation_Skin/Animation_Skin_01.gltf", 1.0},
                      AnimatedFile{"SkinBelowATransform", "Animation_Skin/Animation_Skin_04.gltf", 1.0},
                      AnimatedFile{"OneMeshWithTwoSkins", "Animation_Skin/Animation_Skin_07.gltf", 1.0},
                      AnimatedFile{"SkinOfFourJoints", "Animation_Skin/Animation_Skin_09.gltf", 1.0},
                      AnimatedFile{"JointsAsBytes", "Animation_SkinType/Animation_SkinType_00.gltf", 1.0},
                      AnimatedFile{"WeightsAsBytes", "Animation_SkinType/Animation_SkinType_02.gltf", 1.0},
                      AnimatedFile{"LinearTurn", "Animation_Node/Animation_Node_01.gltf", 1.3},
                      AnimatedFile{"LinearScale", "Animation_Node/Animation_Node_02.gltf", 1.0},
                      AnimatedFile{"SteppedSlide", "Animation_Node/Animation_Node_03.gltf", 2.5},
                      AnimatedFile{"CubicSlide", "Animation_Node/Animation_Node_04.gltf", 1.0},
                      AnimatedFile{"CubicTurn", "Animation_Node/Animation_Node_05.gltf", 1.3},
                      AnimatedFile{"NormalisedTurn", "Animation_SamplerType/Animation_SamplerType_01.gltf", 1.3},
                      AnimatedFile{"BoxAnimated", "../../khronos-sample-models/BoxAnimated/glTF/BoxAnimated.gltf",
                                   2.2}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(LivingFiles, CastTheShadowOfWhereTheyAreAtATimeAndNotOfTheirFirstFrame) {
    const std::string path = std::string(kGenerated) + GetParam().path;
    if (!open(path.c_str(), LightKind::directional)) GTEST_SKIP() << "no scene file " << path << " in the data folder";
    ASSERT_FALSE(spawned.played.empty());
    draw_at(0.0);
    const SceneSnapshot start = frame().snapshot();
    draw_at(GetParam().time_s);
    const Judged judged = judge();
    EXPECT_LE(wrong(judged), kMostWrong) << judged.metrics.wrong << " of " << judged.metrics.scored;
    EXPECT_GE(shadowed(judged), kLeastShadowed);
    EXPECT_GT(wrong(judge(0, start)), kMostWrong) << "nothing moved that a shadow shows";
}

/// A ball above a ground, under a light of each kind.
class LivingBall : public LivingCasters, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Makes the ball's world. `bend` fills in the deformer of a mesh that has its vertices already.
    template <class Bend>
    void make_world(Bend&& bend, const LightShadow& shadow = {}) {
        ball = add_analysed(game::make_sphere(1.0, 32, 16));
        assets::Mesh& mesh = library.meshes[ball];
        assets::Deformer deformer;
        bend(mesh, deformer);
        assets::measure(deformer, mesh);
        mesh.deformer = std::make_shared<const assets::Deformer>(std::move(deformer));
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0})), {}, false);
        entity = place(ball, {.translation_m = {0.0, 1.6, 0.0}});
        add_light_of(GetParam(), {2.0, 6.0, 1.5}, shadow);
        add_camera({.fov_y_rad = 0.8}, {0.0, 7.0, 6.0}, {0.0, -7.0, -6.0});
    }
    void expect_right() {
        draw();
        const Judged judged = judge();
        EXPECT_LE(wrong(judged), kMostWrong) << judged.metrics.wrong << " of " << judged.metrics.scored;
        EXPECT_GE(shadowed(judged), kLeastShadowed);
    }
    std::uint32_t ball = 0;
    ecs::Entity entity;
};
INSTANTIATE_TEST_SUITE_P(Kinds, LivingBall,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(LivingBall, CastsTheShadowThatItsMorphWeightsGiveIt) {
    make_world([](const assets::Mesh& mesh, assets::Deformer& deformer) {
        deformer.targets.resize(2);
        for (const assets::Vertex& v : mesh.vertices) {
            deformer.targets[0].positions.push_back(v.position_ms * glm::vec3(1.2f, -0.3f, 0.0f));
            deformer.targets[1].positions.push_back(v.position_ms.x > 0.0f ? glm::vec3(0.0f, 0.0f, v.position_ms.x)
                                                                           : glm::vec3(0.0f));
        }
    });
    draw();
    const SceneSnapshot start = frame().snapshot();
    for (const std::vector<float>& weights : {std::vector<float>{1.0f, 0.0f}, {0.5f, -1.5f}, {-0.4f, 1.0f}}) {
        world.emplace<MorphWeights>(entity, {weights});
        expect_right();
        EXPECT_GT(wrong(judge(0, start)), kMostWrong);
    }
}

TEST_P(LivingBall, CastsWholeShadowsWhereJointsMirrorIt) {
    make_world([](const assets::Mesh& mesh, assets::Deformer& deformer) {
        for (const assets::Vertex& v : mesh.vertices) {
            deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
            deformer.influences.push_back({v.position_ms.x > 0.0f ? 1u : 0u, 1.0f});
        }
        deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
    });
    const ecs::Entity left = world.create(), right = world.create();
    for (const ecs::Entity joint : {left, right}) world.emplace<Transform>(joint, {.translation_m = {0.0, 1.6, 0.0}});
    world.emplace<Skin>(entity, {{left, right}, {glm::dmat4x3(1.0), glm::dmat4x3(1.0)}});
    expect_right();
    world.patch<Transform>(right, [](Transform& t) { t.scale = {1.0, -1.0, 1.0}; });
    expect_right();
    world.patch<Transform>(left, [](Transform& t) { t.scale = {1.0, 1.0, -1.0}; });
    expect_right();
    world.patch<Transform>(left, [](Transform& t) { t.scale = {1.0, 0.0, 1.0}; });  // flat
    expect_right();
}

}  // namespace
}  // namespace gnomon
