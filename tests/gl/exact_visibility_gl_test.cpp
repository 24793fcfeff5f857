#include <cmath>

#include "bench/compare/filter_gallery.h"
#include "bench/flicker/flicker.h"
#include "bench/flicker/map_readback.h"
#include "bench/glsl_on_cpu/cpu_lookup.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/gl/truth_scenes.h"

// The flicker bench looks maps up in double; that must be the lookup of the shaders.
namespace gnomon {
namespace {

class ExactVisibility : public TruthTest {
protected:
    static bench::StageOptions small(const std::string& filter) {
        bench::StageOptions options;
        options.size_px = {320, 180};
        options.settings = {"filter=" + filter};
        return options;
    }
};

TEST_F(ExactVisibility, IsWhatTheShadersShowButForRounding) {
    // Pixels may differ where a tap is as near to a texel's border or a depth tie as a picture's positions are off.
    // That is half a sub-pixel step of the rasteriser, 2^-9 pixel each way. The shader's bias allows for it, the
    // bench's does not.
    constexpr double kMostRounded = 5e-3, kLeastMoved = 2e-2;
    const auto stage = open(small("hard"));
    ASSERT_TRUE(stage);
    ASSERT_FALSE(stage->apply_setting("fit=tight"));  // its maps do not depend on the filters looked through before
    stage->run_frame();
    const SceneSnapshot scene = stage->frame().snapshot();
    const ConsumerItem& camera = scene.consumers.front();
    const oracle::ReferenceTracer tracer(scene, stage->library(), camera.position_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(camera);
    std::vector<oracle::LightTruth> truths;
    for (const LightItem& light : scene.lights) truths.push_back(tracer.trace_light(hits, light, false));
    std::vector<std::pair<std::string, std::string>> looks;
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (bench::knows_filter(row)) looks.emplace_back(row.name, "automatic");
    for (const char* filter : {"pcf_grid", "sharp_4x4"})
        for (const char* bias : {"0.05", "slope", "normal_offset", "receiver_plane"})
            looks.emplace_back(filter, bias);
    for (const auto& [filter, bias] : looks) {
        ASSERT_FALSE(stage->apply_setting("filter=" + filter));
        ASSERT_FALSE(stage->apply_setting("bias=" + bias));
        for (int i = 0; i < 2; ++i) stage->run_frame();
        std::vector<std::vector<float>> shown(scene.lights.size());
        for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
            ASSERT_TRUE(stage->frame().read_visibility(l, shown[l]));

        auto frames = bench::ShadowFrames::create(*stage);
        ASSERT_TRUE(frames) << to_line(frames.error());
        for (int i = 0; i < 2; ++i) ASSERT_FALSE(frames.value()->run());
        for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
            SCOPED_TRACE(filter + ", " + bias + ", " + scene.lights[l].name);
            const auto light = frames.value()->exact_light(l);
            ASSERT_TRUE(light) << "a row that the bench does not know";
            const oracle::LightTruth& truth = truths[l];
            std::size_t scored = 0, different = 0, dark = 0, moved = 0;
            for (std::size_t i = 0; i < hits.count(); ++i) {
                if (!truth.scored[i] || shown[l][i] < 0.0f) continue;
                bench::SurfacePoint point{camera.position_ws_m - hits.camera_rel_m + hits.position_rel_m[i],
                                          hits.normal_ws[i]};
                bench::ExactVisibility exact;
                light->evaluate({&point, 1}, {&exact, 1});
                ++scored;
                dark += exact.value < 0.5f;
                different += std::abs(exact.value - shown[l][i]) > 0.02f;  // hardware blends in steps of 1/256
                point.position_ws_m += glm::dvec3(0.2, 0.1, -0.2);
                light->evaluate({&point, 1}, {&exact, 1});
                moved += std::abs(exact.value - shown[l][i]) > 0.02f;
            }
            EXPECT_GT(scored, 5000u);
            EXPECT_GT(dark, 200u);
            EXPECT_LE(static_cast<double>(different), kMostRounded * static_cast<double>(scored))
                << different << " of " << scored;
            EXPECT_GE(static_cast<double>(moved), kLeastMoved * static_cast<double>(scored))
                << "another place looks the same";
        }
    }
}

TEST_F(ExactVisibility, BailingEarlySavesMostOfSixteenTapsOrMoreAndMakesOnePointOfAThousandWrongAtMost) {
    constexpr std::uint32_t kPoints = 20000;
    constexpr double kLeastSaved = 0.6, kMostWrong = 0.001, kMostChanged = 0.01;
    const auto stage = open(small("poisson"));
    ASSERT_TRUE(stage);
    ASSERT_FALSE(stage->apply_setting("resolution=2048"));
    const std::vector<std::vector<std::string>> rows = {{"filter=poisson", "filter_taps=16"},
                                                        {"filter=poisson_rotated", "filter_taps=32"},
                                                        {"filter=pcf_grid", "filter_size=5"},
                                                        {"filter=pcf_bilinear", "filter_size=7"},
                                                        {"filter=cube_grid"}};
    for (const auto& settings : rows) {
        for (const std::string& setting : settings) ASSERT_FALSE(stage->apply_setting(setting));
        const auto counts = bench::count_taps(*stage, kPoints);
        ASSERT_TRUE(counts) << to_line(counts.error());
        double all = 0.0, early = 0.0, wrong = 0.0, changed = 0.0, points = 0.0;
        for (const bench::TapCount& count : counts.value()) {
            const auto weight = static_cast<double>(count.points);
            all += weight * count.all;
            early += weight * count.early;
            wrong += static_cast<double>(count.wrong);
            changed += static_cast<double>(count.changed);
            points += weight;
        }
        EXPECT_GT(points, 20000.0);
        EXPECT_GE(all / points, 12.0) << settings.front() << ": places that no map holds take no tap";
        EXPECT_LE(early, (1.0 - kLeastSaved) * all) << settings.front();
        EXPECT_LE(wrong, kMostWrong * points) << settings.front();
        EXPECT_LE(changed, kMostChanged * points) << settings.front();
        EXPECT_GT(early, 4.0 * points * kLeastSaved) << settings.front() << ": nothing was looked up";
    }
    ASSERT_FALSE(stage->apply_setting("filter=hard"));
    const auto one_tap = bench::count_taps(*stage, kPoints);
    ASSERT_TRUE(one_tap);
    for (const bench::TapCount& count : one_tap.value()) EXPECT_EQ(count.saved(), 0.0) << "one tap cannot be spared";
}

TEST_F(ExactVisibility, AFitThatFollowsTheCameraFlickersAndHoldsEveryPointInView) {
    const auto stage = open(small("hard"));
    ASSERT_TRUE(stage);
    const auto measured =
        bench::measure_stability(*stage, {.frames = 6, .points = 2000, .paths = {"walk"}, .fits = {}});
    ASSERT_TRUE(measured) << to_line(measured.error());
    std::uint64_t flips = 0;
    for (const bench::PathFlicker& row : measured.value().rows) {
        SCOPED_TRACE(row.fit + " " + row.light);
        EXPECT_EQ(row.path, "walk");
        EXPECT_EQ(row.flips_by_frame.size(), 6u);
        EXPECT_GT(row.points, 100u);
        EXPECT_EQ(row.still_flips, 0u) << "a map that stayed shows something else";
        if (row.fit == "stable") {
            EXPECT_EQ(row.flips, 0u);
        }
        EXPECT_EQ(row.uncovered, 0u) << "a point in view is in no map";
        flips += row.flips + row.edge_flips;
    }
    EXPECT_GT(flips, 0u) << "a fit that follows the camera flickers: the bench sees nothing";
    EXPECT_FALSE(bench::measure_stability(*stage, {.frames = 2, .points = 10, .paths = {"fly"}, .fits = {}}));
}

}  // namespace
}  // namespace gnomon
