#include <cmath>

#include "tests/gl/truth_scenes.h"

// Soft shadows of the built-in scene, against rays to all of each source.
namespace gnomon {
namespace {

class TruthOfSources : public TruthTest {
protected:
    static bench::Accuracy measure_with(const std::vector<std::string>& settings) {
        bench::StageOptions options;
        options.size_px = {640, 360};
        options.settings = {"resolution=1024", "source_radius_m=0.02", "sun_radius_deg=1"};
        options.settings.insert(options.settings.end(), settings.begin(), settings.end());
        return measure(options);
    }
};

TEST_F(TruthOfSources, AreMetByPcssWithHalfTheErrorOfSevenBySevenTexelsOrLess) {
    constexpr double kShare = 0.5, kMostLoss = 0.002;
    const bench::Accuracy fixed = measure_with({"filter=pcf_grid", "filter_size=7"}),
                          soft = measure_with({"filter=pcss"});
    ASSERT_EQ(soft.lights.size(), 3u);
    ASSERT_EQ(fixed.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(soft.lights[i].soft && fixed.lights[i].soft);
        const oracle::SoftMetrics &a = soft.lights[i].soft->metrics, &b = fixed.lights[i].soft->metrics;
        SCOPED_TRACE(soft.lights[i].report.name);
        EXPECT_GT(a.umbra, 1000u);
        EXPECT_GT(a.lit, 10000u);
        EXPECT_LE(a.mean_error, kShare * b.mean_error) << a.mean_error << " against " << b.mean_error;
        EXPECT_LE(a.lit_loss, kMostLoss) << "darkness where all of the source is seen";
        for (const float value : soft.lights[i].measured)
            ASSERT_TRUE(std::isfinite(value) && value >= -1.0f && value <= 1.0f);
    }
}

TEST_F(TruthOfSources, AreMetBySoftTrianglesCloserThanByTaps) {
    constexpr double kMostLeak = 0.015, kMostLoss = 0.002, kShare = 0.6;
    struct Sources {
        std::vector<std::string> settings;
        double most_error;
    };
    // The lantern's cage is hardly larger than 5 cm: bars hide most of what stands behind them from the map.
    const Sources cases[] = {{{"source_radius_m=0.02", "sun_radius_deg=1"}, 0.03},
                             {{"source_radius_m=0.05", "sun_radius_deg=0.27"}, 0.05}};
    for (const Sources& of : cases) {
        const std::vector<std::string>& light = of.settings;
        const auto with = [&](const char* filter) {
            std::vector<std::string> settings = light;
            settings.emplace_back(filter);
            return measure_with(settings);
        };
        const bench::Accuracy taps = with("filter=pcss"), triangles = with("filter=soft_triangles");
        ASSERT_EQ(taps.lights.size(), 3u);
        ASSERT_EQ(triangles.lights.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            SCOPED_TRACE(light.front() + " " + triangles.lights[i].report.name);
            const oracle::SoftMetrics &a = triangles.lights[i].soft->metrics, &b = taps.lights[i].soft->metrics;
            EXPECT_GT(a.penumbra, 300u);
            EXPECT_LE(a.penumbra_error, of.most_error);
            EXPECT_LE(a.umbra_leak, kMostLeak);
            EXPECT_LE(a.lit_loss, kMostLoss);
            EXPECT_LE(a.penumbra_error, kShare * b.penumbra_error) << "the control: " << b.penumbra_error;
        }
    }
}

TEST_F(TruthOfSources, AreAskedForOnlyByLightsWhoseSourceHasASize) {
    bench::StageOptions options;
    options.size_px = {160, 90};
    options.settings = {"filter=pcss", "resolution=256", "sun_radius_deg=1"};
    const bench::Accuracy accuracy = measure(options);
    ASSERT_EQ(accuracy.lights.size(), 3u);
    for (const bench::LightAccuracy& light : accuracy.lights)
        EXPECT_EQ(light.soft.has_value(), light.report.kind == LightKind::directional) << light.report.name;
    EXPECT_NE(bench::accuracy_table(accuracy).find("soft light"), std::string::npos);
    EXPECT_NE(bench::accuracy_json(accuracy).find("\"width_ratio\""), std::string::npos);
}

}  // namespace
}  // namespace gnomon
