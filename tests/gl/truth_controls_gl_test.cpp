#include <glm/gtc/matrix_transform.hpp>

#include "bench/audit/audit.h"
#include "tests/gl/truth_scenes.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"

// Negative controls: the measurement that gates must fail when something is broken on purpose.
namespace gnomon {
namespace {

constexpr glm::uvec2 kControlSize_px{640, 360};

class TruthControls : public TruthTest {
protected:
    static bench::StageOptions small(std::vector<std::string> settings = {}) {
        bench::StageOptions options;
        options.size_px = kControlSize_px;
        options.settings = std::move(settings);
        return options;
    }
    static oracle::Metrics against(const bench::LightAccuracy& truth, const std::vector<float>& measured) {
        return oracle::compare({kControlSize_px, measured, truth.truth.visibility, truth.truth.scored, truth.truth.ambiguous});
    }
    /// Fails if the measured picture would pass for the truth.
    static void expect_caught(const oracle::Metrics& metrics) {
        EXPECT_GT(wrong_share(metrics), kMostWrong);
        EXPECT_GT(false_shape_share(metrics), kMostAcneAndLeak);
    }
};

TEST_F(TruthControls, WithoutCastersEverySurfaceThatFacesALightIsLit) {
    auto options = small();
    options.scene = courtyard_file({.casters = false});
    const auto bare = measure(options);
    const auto full = measure(small());
    ASSERT_EQ(bare.lights.size(), 3u);
    ASSERT_EQ(full.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const bench::LightAccuracy& light = bare.lights[i];
        SCOPED_TRACE(light.report.name);
        EXPECT_EQ(light.report.reason, Reason::no_caster);
        std::size_t dark = 0;
        for (std::size_t p = 0; p < light.measured.size(); ++p)
            dark += light.truth.scored[p] && !light.truth.ambiguous[p] && light.measured[p] >= 0.0f &&
                    light.measured[p] != 1.0f;
        EXPECT_EQ(dark, 0u) << "not even where the picture shows another surface, of which one faces away: left out";
        ASSERT_TRUE(light.other_surface);
        EXPECT_LE(light.metrics.fraction(*light.other_surface), bench::kMostOtherSurface);
        EXPECT_EQ(light.metrics.false_light, 0u);
        const auto blind = against(full.lights[i], light.measured);
        expect_caught(blind);
        EXPECT_EQ(blind.false_shadow, 0u);
    }
}

TEST_F(TruthControls, ShadowsSwitchedOffAreFalseLight) {
    const auto stage = open(small());
    ASSERT_TRUE(stage);
    stage->show_shadows(false);
    const auto accuracy = measure(*stage);
    ASSERT_EQ(accuracy.lights.size(), 3u);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(light.report.name);
        expect_caught(light.metrics);
        EXPECT_EQ(light.metrics.false_shadow, 0u);
        EXPECT_GT(light.metrics.fraction(light.metrics.leak), 10.0 * kMostAcneAndLeak);
    }
}

TEST_F(TruthControls, ALightFromElsewhereIsCaught) {
    const auto stage = open(small());
    ASSERT_TRUE(stage);
    const auto accuracy = measure(*stage);
    const SceneSnapshot& snapshot = stage->frame().snapshot();
    const ConsumerItem& camera = snapshot.consumers.front();
    const oracle::ReferenceTracer tracer(snapshot, stage->library(), camera.position_ws_m);
    const auto hits = tracer.trace_primary(camera);
    for (const LightItem& real : snapshot.lights) {
        SCOPED_TRACE(real.name);
        const bench::LightAccuracy* light = find_light(accuracy, real.name);
        ASSERT_TRUE(light);
        // The sun turned half around the vertical; the lamps moved across the yard.
        LightItem moved = real;
        const glm::dmat3 half_turn(glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0));
        if (moved.kind == LightKind::directional)
            moved.rotation_ws = half_turn * moved.rotation_ws;
        else
            moved.position_ws_m += glm::dvec3(1.0, 0.5, 1.0);
        const oracle::LightTruth truth = tracer.trace_light(hits, moved, true);
        const auto metrics =
            oracle::compare({kControlSize_px, light->measured, truth.visibility, truth.scored, truth.ambiguous});
        expect_caught(metrics);
    }
}

TEST_F(TruthControls, NoBiasAtAllShowsAsAcne) {
    const auto accuracy = measure(small({"filter=hard", "bias=0"}));
    ASSERT_EQ(accuracy.lights.size(), 3u);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(light.report.name);
        EXPECT_GT(light.metrics.fraction(light.metrics.acne), 10.0 * kMostAcneAndLeak);
        EXPECT_GT(light.metrics.fraction(light.metrics.false_shadow), 10.0 * kMostWrong);
    }
}

TEST_F(TruthControls, AHugeBiasShowsAsLeak) {
    const auto accuracy = measure(small({"filter=hard", "bias=3"}));
    ASSERT_EQ(accuracy.lights.size(), 3u);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(light.report.name);
        EXPECT_GT(light.metrics.fraction(light.metrics.leak), 3.0 * kMostAcneAndLeak);
        EXPECT_GT(wrong_share(light.metrics), kMostWrong);
        EXPECT_GT(light.metrics.false_light, 4 * light.metrics.false_shadow);
    }
}

TEST_F(TruthControls, ATinyMapShowsAsWrongEdges) {
    const auto fine = measure(small({"filter=hard"})), coarse = measure(small({"filter=hard", "resolution=64"}));
    ASSERT_EQ(fine.lights.size(), coarse.lights.size());
    for (std::size_t i = 0; i < fine.lights.size(); ++i) {
        SCOPED_TRACE(fine.lights[i].report.name);
        EXPECT_GT(wrong_share(coarse.lights[i].metrics), kMostWrong);
        EXPECT_GT(wrong_share(coarse.lights[i].metrics), 4.0 * wrong_share(fine.lights[i].metrics));
        EXPECT_GT(coarse.lights[i].report.predicted_error_px, 4.0 * fine.lights[i].report.predicted_error_px);
    }
}

}  // namespace
}  // namespace gnomon
