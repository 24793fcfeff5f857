#include <functional>
#include <iostream>
#include <map>

#include "tests/data/data_files.h"
#include "tests/gl/truth_scenes.h"
#include "tests/long_run.h"

// Scenes that others made, each from its own camera and with nothing tuned.
namespace gnomon {
namespace {

class TruthData : public TruthTest {
protected:
    /// Returns the largest share of wrong pixels. Cloth and leaves may have more: their folds are narrower than the
    /// map's texels.
    static double most_wrong(const std::string& name) {
        static const std::map<std::string, double> kFiner = {
            {"intel-sponza-simplified/curtains/sponza_curtains.gltf", 0.002},
            {"intel-sponza-simplified/ivy/sponza_ivy.gltf", 0.003}};
        const auto found = kFiner.find(name);
        return found == kFiner.end() ? kMostWrong : found->second;
    }
    /// Skips the test if there are none, or no time for them.
    static void for_each_light(
        const std::vector<std::string>& settings,
        const std::function<void(const std::string& name, const bench::LightAccuracy& light)>& judge) {
        if (!is_long_run()) GTEST_SKIP() << "takes a minute: with GNOMON_LONG only";
        if (test::data_files().empty()) GTEST_SKIP() << "no test data at " << test::data_folder();
        for (const auto& [name, verdict] : test::recorded_verdicts()) {
            if (verdict != test::kSeen) continue;
            bench::StageOptions options;
            options.scene = test::data_folder() / name;
            options.size_px = {640, 360};
            options.settings = settings;
            const bench::Accuracy accuracy = measure(options);
            for (const bench::LightAccuracy& light : accuracy.lights) judge(name, light);
        }
    }
};

TEST_F(TruthData, EveryFileIsShadowedRight) {
    constexpr double kMostWrongOfAll = 5.0e-5;
    // In a small picture a pixel or two are more than a share that is meant for large ones.
    constexpr double kFew_px = 3.0;
    std::size_t lights = 0;
    double scored = 0.0, wrong = 0.0;
    for_each_light({}, [&](const std::string& name, const bench::LightAccuracy& light) {
        const auto pixels = static_cast<double>(light.metrics.scored);
        const auto wrong_pixels = static_cast<double>(light.metrics.wrong);
        EXPECT_LE(wrong_pixels, most_wrong(name) * pixels + kFew_px) << name << ", " << light.report.name;
        scored += pixels;
        wrong += wrong_pixels;
        ++lights;
    });
    if (IsSkipped()) return;
    std::cout << lights << " lights, " << scored << " pixels, " << 100.0 * wrong / scored << " % wrong\n";
    EXPECT_LE(wrong, kMostWrongOfAll * scored);
}

TEST_F(TruthData, NoPixelOfAnyFileIsWrongWithTheExactFilter) {
    constexpr double kMostAmbiguous = 0.001;
    constexpr std::size_t kLeastLights = 200;
    std::size_t lights = 0;
    double scored = 0.0, ambiguous = 0.0;
    for_each_light({"filter=exact"}, [&](const std::string& name, const bench::LightAccuracy& light) {
        EXPECT_EQ(light.metrics.wrong, 0u) << name << ", " << light.report.name;
        scored += static_cast<double>(light.metrics.scored);
        ambiguous += static_cast<double>(light.metrics.ambiguous);
        ++lights;
    });
    if (IsSkipped()) return;
    std::cout << lights << " lights, " << scored << " pixels, " << 100.0 * ambiguous / scored << " % ambiguous\n";
    EXPECT_GT(lights, kLeastLights);
    EXPECT_LE(ambiguous, kMostAmbiguous * scored);
}

}  // namespace
}  // namespace gnomon
