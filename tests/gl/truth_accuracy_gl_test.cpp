#include <cstring>
#include <ostream>

#include "tests/gl/truth_scenes.h"
#include "tests/source_paths.h"

// What the project promises: on these scenes, with default settings, each light's shadows are right.
namespace gnomon {
namespace {

// A picture in which a light decides fewer pixels than this proves nothing about it.
constexpr std::size_t kLeastScored = 10000, kLeastShadowed = 500;

std::size_t shadowed_px(const bench::LightAccuracy& light) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < light.truth.scored.size(); ++i)
        count += light.truth.scored[i] != 0 && light.truth.visibility[i] == 0.0f;
    return count;
}

void expect_right(const bench::Accuracy& accuracy, std::size_t lights, std::size_t most_acne_px = 0) {
    ASSERT_EQ(accuracy.lights.size(), lights);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(accuracy.scene + ", " + light.report.name);
        EXPECT_GE(light.metrics.scored, kLeastScored);
        EXPECT_GE(shadowed_px(light), kLeastShadowed) << "nothing to get wrong";
        EXPECT_LE(wrong_share(light.metrics), kMostWrong);
        // A texel of the map is many pixels where the light grazes a surface, and some where a picture shows little at
        // all.
        if (light.metrics.acne > 0) {
            EXPECT_LE(light.metrics.acne, most_acne_px);
            EXPECT_EQ(light.far.false_shadow + light.far.crease_shadow, 0u) << "not for want of texels alone";
        }
        EXPECT_LE(light.metrics.fraction(light.metrics.leak), kMostLeak) << light.metrics.leak << " pixels";
        EXPECT_NE(light.report.state, LightState::skipped) << reason_code(light.report.reason);
    }
}

class TruthAccuracy : public TruthTest {};

TEST_F(TruthAccuracy, TheBuiltInSceneIsRightUnderSunLanternAndLamp) { expect_right(measure(bench::StageOptions{}), 3); }

TEST_F(TruthAccuracy, TheBuiltInSceneIsRightAMillionMetresAway) {
    bench::StageOptions options;
    options.scene = courtyard_file({.offset_m = glm::dvec3(1.0e6, 0.0, -1.0e6)});
    expect_right(measure(options), 3);
}

TEST_F(TruthAccuracy, TheBuiltInSceneIsRightFromItsOtherCamerasAndTimes) {
    for (const char* camera : {"top", "low"}) {
        SCOPED_TRACE(camera);
        bench::StageOptions options;
        options.camera = camera;
        options.time_s = 2.5;
        expect_right(measure(options), 3);
    }
}

/// Expects no wrong pixel among scored and unambiguous ones, and next to none to be ambiguous.
void expect_exact(const bench::Accuracy& accuracy, std::size_t lights) {
    constexpr double kMostAmbiguous = 0.001;
    ASSERT_EQ(accuracy.lights.size(), lights);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(accuracy.scene + ", " + light.report.name);
        EXPECT_GE(light.metrics.scored, kLeastScored);
        EXPECT_GE(shadowed_px(light), kLeastShadowed) << "nothing to get wrong";
        EXPECT_EQ(light.metrics.wrong, 0u);
        EXPECT_LE(light.metrics.fraction(light.metrics.ambiguous), kMostAmbiguous);
        EXPECT_NE(light.report.state, LightState::degraded) << reason_code(light.report.reason);
    }
}

TEST_F(TruthAccuracy, ExactErrsInNoPixelOfTheBuiltInScenes) {
    for (const char* camera : {"main", "top", "low"}) {
        SCOPED_TRACE(camera);
        bench::StageOptions options;
        options.camera = camera;
        options.settings = {"filter=exact"};
        expect_exact(measure(options), 3);
    }
}

TEST_F(TruthAccuracy, TrianglesErrByLessThanAThousandthWhereVotesOfAsManyTexelsErrByMore) {
    constexpr double kThousandth = 0.001;
    for (const char* filter : {"filter=triangles", "filter=sharp_4x4"}) {
        SCOPED_TRACE(filter);
        bench::StageOptions options;
        options.settings = {filter, "resolution=1024"};
        const bench::Accuracy accuracy = measure(options);
        const bool exact = std::string(filter) == "filter=triangles";
        if (exact) expect_right(accuracy, 3);
        for (const bench::LightAccuracy& light : accuracy.lights)
            EXPECT_EQ(wrong_share(light.metrics) <= kThousandth, exact)
                << light.report.name << ": " << light.metrics.wrong << " of " << light.metrics.scored;
    }
}

TEST_F(TruthAccuracy, TrianglesErrNoMoreByOtherRoutesFitsAndFaces) {
    constexpr double kThousandth = 0.001;
    for (const char* setting : {"cube_route=layered_vertex", "cube_route=layered_geometry", "fit=quantised",
                                "cascade_blend=0.1", "caster_faces=back"}) {
        SCOPED_TRACE(setting);
        bench::StageOptions options;
        options.settings = {"filter=triangles", "resolution=2048", setting};
        const bench::Accuracy accuracy = measure(options);
        ASSERT_EQ(accuracy.lights.size(), 3u);
        for (const bench::LightAccuracy& light : accuracy.lights)
            EXPECT_LE(wrong_share(light.metrics), kThousandth) << light.report.name;
    }
}

struct SceneFile {
    const char* name;
    const char* path;  // below the data folder
    friend void PrintTo(const SceneFile& file, std::ostream* out) { *out << file.name; }
};
class TruthOfFiles : public TruthTest, public ::testing::WithParamInterface<SceneFile> {};

TEST_P(TruthOfFiles, TheirSunShadowsAreRight) {
    const auto file = test::data_folder() / GetParam().path;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no scene file " << GetParam().path << " in the data folder";
    bench::StageOptions options;
    options.scene = file;
    expect_right(measure(options), 1, 1);
    options.settings = {"filter=exact"};
    expect_exact(measure(options), 1);
}
INSTANTIATE_TEST_SUITE_P(Data, TruthOfFiles,
                         ::testing::Values(SceneFile{"Sponza", "sponza-crytek/Sponza.gltf"},
                                           SceneFile{"Lantern", "khronos-sample-models/Lantern/glTF/Lantern.gltf"},
                                           SceneFile{"SciFiHelmet",
                                                     "khronos-sample-models/SciFiHelmet/glTF/SciFiHelmet.gltf"}),
                         [](const auto& param) { return std::string(param.param.name); });

bool equal_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(TruthAccuracy, TwoRunsAreBitIdenticalInPictureAndVisibility) {
    bench::StageOptions options;
    options.size_px = {640, 360};
    std::vector<std::uint8_t> pictures[2];
    std::vector<float> fields[2][3];
    for (int run = 0; run < 2; ++run) {
        const auto stage = open(options);
        ASSERT_TRUE(stage);
        stage->run_frame();
        ASSERT_TRUE(stage->frame().read_picture(pictures[run]));
        for (std::uint32_t light = 0; light < 3; ++light)
            ASSERT_TRUE(stage->frame().read_visibility(light, fields[run][light]));
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    for (int light = 0; light < 3; ++light) EXPECT_TRUE(equal_bits(fields[0][light], fields[1][light])) << light;
    EXPECT_FALSE(equal_bits(fields[0][0], fields[0][1])) << "two lights with one field: the comparison is blind";
}

TEST_F(TruthAccuracy, ReusedMapsGiveTheBitsOfRedrawnOnes) {
    bench::StageOptions options;
    options.size_px = {640, 360};
    const auto stage = open(options);
    ASSERT_TRUE(stage);
    stage->run_frame();
    stage->run_frame();
    std::vector<float> kept[3], redrawn;
    for (std::uint32_t light = 0; light < 3; ++light) {
        EXPECT_EQ(stage->frame().report().lights[light].state, LightState::reused);
        ASSERT_TRUE(stage->frame().read_visibility(light, kept[light]));
    }
    stage->set_economy(false);
    stage->run_frame();
    for (std::uint32_t light = 0; light < 3; ++light) {
        EXPECT_EQ(stage->frame().report().lights[light].state, LightState::rendered);
        ASSERT_TRUE(stage->frame().read_visibility(light, redrawn));
        EXPECT_TRUE(equal_bits(kept[light], redrawn)) << light;
    }
}

}  // namespace
}  // namespace gnomon
