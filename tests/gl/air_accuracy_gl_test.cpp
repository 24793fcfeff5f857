#include "gnomon/components.h"
#include "tests/gl/truth_scenes.h"

// Shadows in fog, as the bench judges them.
namespace gnomon {
namespace {

/// Largest share of wrong places.
constexpr double kFewWrong = 0.003;

class AirAccuracyOfMist : public TruthTest {
protected:
    static bench::Accuracy measure_mist(const std::vector<std::string>& settings, float mist_per_m = 0.06f) {
        bench::StageOptions options;
        options.size_px = {640, 360};
        options.settings = settings;
        options.mist_per_m = mist_per_m;
        return measure(options);
    }
};

TEST_F(AirAccuracyOfMist, IsRightForEachLightOfTheCourtyard) {
    const bench::Accuracy accuracy = measure_mist({});
    ASSERT_EQ(accuracy.lights.size(), 3u);
    for (const bench::LightAccuracy& light : accuracy.lights) {
        SCOPED_TRACE(light.report.name);
        ASSERT_TRUE(light.air);
        EXPECT_GT(light.air->ways, 1000u);
        EXPECT_GT(light.air->dark, 200u);
        EXPECT_GT(light.air->places - light.air->dark, 5000u);
        EXPECT_LE(light.air->fraction(light.air->wrong), kFewWrong);
        EXPECT_LE(light.air->way_error, kFewWrong);
        EXPECT_LE(light.metrics.fraction(light.metrics.wrong), 0.0005) << "surfaces are judged beside it";
    }
}

TEST_F(AirAccuracyOfMist, FindsTheErrorsOfCoarseMapsAndOfNoneAtAll) {
    for (const char* setting : {"resolution=32", "enabled=off"})
        for (const bench::LightAccuracy& light : measure_mist({setting}).lights) {
            SCOPED_TRACE(light.report.name + ", " + setting);
            ASSERT_TRUE(light.air);
            EXPECT_GT(light.air->fraction(light.air->wrong), kFewWrong);
        }
}

TEST_F(AirAccuracyOfMist, IsOfFogAndOfFiltersThatSeeTheMiddleAlone) {
    for (const bench::LightAccuracy& light : measure_mist({}, 0.0f).lights) EXPECT_FALSE(light.air) << "no fog";
    for (const char* filter : {"filter=pcss", "filter=evsm4", "filter=exact"})
        for (const bench::LightAccuracy& light : measure_mist({filter}).lights)
            EXPECT_FALSE(light.air) << light.report.name << ", " << filter;
}

}  // namespace
}  // namespace gnomon
