#include <cstdio>
#include <filesystem>

#include "tests/gl/truth_scenes.h"
#include "tests/oracle/exactness.h"
#include "tests/source_paths.h"

// filter=exact against rays in double: no pixel is wrong, unless its truth depends on the last digits.
namespace gnomon {
namespace {

constexpr glm::uvec2 kSize_px{640, 360};
// Shares of the scored pixels.
constexpr double kMostAmbiguous = 0.001, kMostOtherSurface = 0.0005;

class ExactScenes : public TruthTest {
protected:
    static bench::StageOptions exact(std::vector<std::string> settings = {"filter=exact"}) {
        bench::StageOptions options;
        options.size_px = kSize_px;
        options.settings = std::move(settings);
        return options;
    }
    struct Judged {
        std::string name;
        LightReport report;
        oracle::Exactness found;
    };
    /// Judges every light of the stage's last frame by its snapshot.
    static std::vector<Judged> judge(bench::Stage& stage) {
        const SceneSnapshot& scene = stage.frame().snapshot();
        const ConsumerItem& camera = scene.consumers.front();
        const oracle::ReferenceTracer tracer(scene, stage.library(), camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        std::vector<Judged> judged;
        for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
            std::vector<float> measured;
            EXPECT_TRUE(stage.frame().read_visibility(i, measured));
            const oracle::LightTruth truth = tracer.trace_light(hits, scene.lights[i], true);
            judged.push_back({scene.lights[i].name, stage.frame().report().lights[i],
                              oracle::exactness(tracer, hits, camera, truth, measured)});
        }
        return judged;
    }
    static void expect_exact(const std::vector<Judged>& judged) {
        for (const auto& [name, report, found] : judged) {
            SCOPED_TRACE(name);
            const auto scored = static_cast<double>(found.scored);
            std::printf("%s: %zu scored, %zu wrong, %zu ambiguous, %zu of another surface\n", name.c_str(),
                        found.scored, found.wrong, found.ambiguous, found.other_surface);
            // Drawn, or of a map that is not worth it while things move.
            EXPECT_EQ(report.state, LightState::rendered) << reason_code(report.reason);
            EXPECT_EQ(report.counts.views_drawn > 0, report.reason != Reason::rays_cheaper);
            EXPECT_EQ(found.wrong, 0u) << "of " << found.scored;
            EXPECT_LE(static_cast<double>(found.ambiguous), kMostAmbiguous * scored);
            EXPECT_LE(static_cast<double>(found.other_surface), kMostOtherSurface * scored);
            EXPECT_GT(found.lit, 1000u);
            EXPECT_GT(found.dark, 1000u);
        }
    }
};

TEST_F(ExactScenes, TheCourtyardsThreeLightsAreTheTruthFromItsCameras) {
    for (const char* camera : {"0", "1", "2"}) {
        SCOPED_TRACE(camera);
        auto options = exact();
        options.camera = camera;
        const auto stage = open(options);
        ASSERT_TRUE(stage);
        stage->run_frame();
        const auto judged = judge(*stage);
        ASSERT_EQ(judged.size(), 3u);
        expect_exact(judged);
        EXPECT_GT(stage->frame().report().rays.bytes, 0u);
    }
}

TEST_F(ExactScenes, TheCourtyardIsTheTruthAHundredMillionMetresAway) {
    auto options = exact();
    options.offset_m = {1.0e8, -1.0e8, 0.5e8};
    const auto stage = open(options);
    ASSERT_TRUE(stage);
    stage->run_frame();
    expect_exact(judge(*stage));
}

TEST_F(ExactScenes, CastersThatMovedAreWhereTheyAreAndNotWhereTheyWere) {
    const auto stage = open(exact());
    ASSERT_TRUE(stage);
    stage->run_frame();
    stage->move_to(2.3);
    stage->run_frame();
    EXPECT_TRUE(stage->frame().report().rays.instances_written);
    expect_exact(judge(*stage));
}

TEST_F(ExactScenes, SponzasSunIsTheTruth) {
    auto options = exact();
    options.scene = test::data_folder() / "sponza-crytek/Sponza.gltf";
    if (!std::filesystem::exists(*options.scene)) GTEST_SKIP() << "Sponza is not there";
    const auto stage = open(options);
    ASSERT_TRUE(stage);
    stage->run_frame();
    expect_exact(judge(*stage));
}

/// Draws a mesh that bends: it is measured for contours and put into the trees again.
TEST_F(ExactScenes, ARunningFoxIsTheTruth) {
    auto options = exact();
    options.scene = test::data_folder() / "fox-draco-testdata/Fox/glTF/Fox.gltf";
    if (!std::filesystem::exists(*options.scene)) GTEST_SKIP() << "the fox is not there";
    const auto stage = open(options);
    ASSERT_TRUE(stage);
    for (const double time_s : {0.1, 0.4}) {
        stage->move_to(time_s);
        stage->run_frame();
        SCOPED_TRACE(time_s);
        const std::vector<Judged> judged = judge(*stage);
        ASSERT_FALSE(judged.empty());
        for (const auto& [name, report, found] : judged) {
            std::printf("%s: %zu scored, %zu dark, %zu ambiguous\n", name.c_str(), found.scored, found.dark,
                        found.ambiguous);
            EXPECT_EQ(found.wrong, 0u) << name << " of " << found.scored;
            EXPECT_GT(found.dark, 100u);
            EXPECT_GT(found.lit, 100u);
        }
    }
    EXPECT_GT(stage->frame().report().rays.meshes_written, 0u) << "it bent";
}

TEST_F(ExactScenes, WouldBeCaughtWithOneTapOfAMap) {
    const auto stage = open(exact({"filter=hard"}));
    ASSERT_TRUE(stage);
    stage->run_frame();
    for (const Judged& light : judge(*stage)) EXPECT_GT(light.found.wrong, 20u) << light.name;
}

}  // namespace
}  // namespace gnomon
