#include "tests/gl/truth_scenes.h"

// Where no edge, no crease and no texel explains a wrong pixel, the bias has failed.
namespace gnomon {
namespace {

// Share of scored pixels.
constexpr double kMostFarLight = 1.0e-4;
constexpr std::size_t kManyPixels = 1000;

class TruthPlanes : public TruthTest {
protected:
    static bench::StageOptions look(const std::string& filter, const std::string& size) {
        bench::StageOptions options;
        options.size_px = {640, 360};
        options.settings = {"filter=" + filter, "resolution=" + size};
        return options;
    }
};

TEST_F(TruthPlanes, AreNotDarkenedFarFromEdgesAndCreases) {
    for (const char* size : {"512", "2048"})
        for (const char* filter : {"hard", "pcf_grid", "pcf_bilinear", "sharp_4x4"}) {
            const bench::Accuracy accuracy = measure(look(filter, size));
            ASSERT_EQ(accuracy.lights.size(), 3u);
            for (const bench::LightAccuracy& light : accuracy.lights) {
                SCOPED_TRACE(std::string(filter) + " " + size + " " + light.report.name);
                const std::size_t first = light.far.each.empty() ? 0 : light.far.each.front();
                EXPECT_EQ(light.far.false_shadow, 0u)
                    << "the first at " << first % accuracy.size_px.x << ", " << first / accuracy.size_px.x;
                if (std::string(size) == "2048") {
                    EXPECT_LE(light.metrics.fraction(light.far.false_light), kMostFarLight);
                }
            }
        }
}

TEST_F(TruthPlanes, AreDarkenedWithoutABias) {
    bench::StageOptions options = look("hard", "512");
    options.settings.emplace_back("bias=0");
    for (const bench::LightAccuracy& light : measure(options).lights)
        EXPECT_GT(light.far.false_shadow, kManyPixels) << light.report.name;
}

TEST_F(TruthPlanes, AreLitWhereTheyTouchUnderABiasThatIsTooLarge) {
    bench::StageOptions options = look("hard", "2048");
    options.settings.emplace_back("bias=3");
    for (const bench::LightAccuracy& light : measure(options).lights)
        EXPECT_GT(light.far.false_light, kManyPixels) << light.report.name;
}

}  // namespace
}  // namespace gnomon
