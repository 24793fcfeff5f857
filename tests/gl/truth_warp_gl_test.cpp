#include "tests/gl/truth_scenes.h"

// What a warped map is for: the same texels, nearer to the truth.
namespace gnomon {
namespace {

class TruthWarp : public TruthTest {
protected:
    bench::LightAccuracy sun(const char* cascades, const char* warp) {
        bench::StageOptions options;
        options.settings = {"resolution=1024", "filter=hard", "fit=tight", cascades, warp};
        const bench::Accuracy accuracy = measure(options);
        const bench::LightAccuracy* light = find_light(accuracy, "sun");
        EXPECT_NE(light, nullptr);
        return light ? *light : bench::LightAccuracy{};
    }
};

TEST_F(TruthWarp, OneWarpedMapIsNearerToTheTruthThanOneThatIsNotAndShadowsNoPlane) {
    const bench::LightAccuracy flat = sun("cascades=1", "warp=0"), warped = sun("cascades=1", "warp=1");
    EXPECT_GT(flat.metrics.wrong, 0u);
    EXPECT_LT(wrong_share(warped.metrics), 0.97 * wrong_share(flat.metrics));
    EXPECT_LE(false_shape_share(warped.metrics), kMostAcneAndLeak);
    EXPECT_LT(warped.report.predicted_error_px, flat.report.predicted_error_px);
}

TEST_F(TruthWarp, FourCascadesAreNoWorseForIt) {
    const bench::LightAccuracy flat = sun("cascades=4", "warp=0"), warped = sun("cascades=4", "warp=1");
    EXPECT_LE(wrong_share(warped.metrics), 1.02 * wrong_share(flat.metrics));
    EXPECT_LE(false_shape_share(warped.metrics), kMostAcneAndLeak);
}

}  // namespace
}  // namespace gnomon
