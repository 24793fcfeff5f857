#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/gl/truth_scenes.h"
#include "tests/source_paths.h"

// filter=exact_soft against 256 rays to all of each source. What is certain is right. Penumbrae are off by no more than
// the number of their rays explains.
namespace gnomon {
namespace {

/// Pixels that differ by more than chance: some of them are of another surface than the truth's (ExactScenes).
constexpr double kMostOff = 0.0005;
constexpr double kTruthRays = 256.0;

class ExactSoft : public TruthTest {
protected:
    static bench::StageOptions soft(std::vector<std::string> settings) {
        bench::StageOptions options;
        options.size_px = {320, 180};
        options.settings = {"filter=exact_soft", "source_radius_m=0.02", "sun_radius_deg=1"};
        options.settings.insert(options.settings.end(), settings.begin(), settings.end());
        return options;
    }
    struct Judged {
        std::size_t scored = 0, whole = 0, umbra = 0, penumbra = 0, off = 0;
        double square_error = 0.0, chance = 0.0;   // sums over the penumbra: measured; expected of random rays
    };
    static Judged judge(const bench::LightAccuracy& light, double rays) {
        Judged judged;
        const oracle::SoftTruth& truth = light.soft->truth;
        for (std::size_t i = 0; i < truth.visibility.size(); ++i) {
            if (!truth.scored[i]) continue;
            const double p = static_cast<double>(truth.visibility[i]), error = static_cast<double>(light.measured[i]) - p;
            // What few rays do not meet, or many do not.
            const double clamped = std::clamp(p, 1.0 / kTruthRays, 1.0 - 1.0 / kTruthRays);
            const double variance = clamped * (1.0 - clamped) * (1.0 / rays + 1.0 / kTruthRays);
            constexpr double kSigmas = 4.0, kStored = 1.0 / 255.0;
            ++judged.scored;
            judged.off += std::abs(error) > kSigmas * std::sqrt(variance) + kStored ? 1 : 0;
            if (p <= 0.0 || p >= 1.0) {
                ++(p <= 0.0 ? judged.umbra : judged.whole);
                continue;
            }
            ++judged.penumbra;
            judged.square_error += error * error;
            judged.chance += variance;
        }
        return judged;
    }
    static void expect_right(const bench::Accuracy& accuracy, std::size_t lights, double rays) {
        ASSERT_EQ(accuracy.lights.size(), lights);
        for (const bench::LightAccuracy& light : accuracy.lights) {
            SCOPED_TRACE(light.report.name);
            ASSERT_TRUE(light.soft);
            EXPECT_TRUE(light.report.state == LightState::rendered || light.report.state == LightState::reused)
                << reason_code(light.report.reason);
            const Judged found = judge(light, rays);
            const auto penumbra = static_cast<double>(found.penumbra);
            std::printf("%s: %zu scored, %zu umbra, %zu penumbra, %zu off, rms %.4f of %.4f by chance, mean error %.4f %%\n",
                        light.report.name.c_str(), found.scored, found.umbra, found.penumbra, found.off,
                        std::sqrt(found.square_error / penumbra), std::sqrt(found.chance / penumbra),
                        100.0 * light.soft->metrics.mean_error);
            EXPECT_LE(static_cast<double>(found.off), kMostOff * static_cast<double>(found.scored));
            EXPECT_LE(found.square_error, found.chance);
            EXPECT_GT(found.umbra, 500u);
            EXPECT_GT(found.whole, 1000u);
            EXPECT_GT(found.penumbra, 50u);
        }
    }
};

TEST_F(ExactSoft, TheCourtyardsThreeSourcesAreTheTruthToTheirRaysChance) {
    expect_right(measure(soft({"penumbra_rays=16"})), 3, 16.0);
}

TEST_F(ExactSoft, MoreRaysComeNearerToTheTruth) {
    expect_right(measure(soft({"penumbra_rays=64"})), 3, 64.0);
}

TEST_F(ExactSoft, TheMeanOfFramesWithOtherNoiseComesNearerThanTheirRaysChance) {
    const auto stage = open(soft({"penumbra_rays=16"}));
    ASSERT_TRUE(stage);
    const bench::Accuracy one = measure(*stage);
    const bench::Accuracy mean = measure(*stage, {.timed_frames = 0, .noise_rounds = 8});
    expect_right(mean, 3, 8.0 * 16.0);
    for (std::size_t k = 0; k < mean.lights.size(); ++k) {
        const double alone = one.lights[k].soft->metrics.penumbra_error, averaged = mean.lights[k].soft->metrics.penumbra_error;
        std::printf("%s: mean error in penumbrae %.4f alone, %.4f of 8\n", one.lights[k].report.name.c_str(), alone, averaged);
        EXPECT_LE(averaged, 0.02);
        EXPECT_LT(averaged, 0.6 * alone);
    }
}

TEST_F(ExactSoft, SponzasSunIsTheTruth) {
    auto options = soft({"penumbra_rays=32"});
    options.scene = test::data_folder() / "sponza-crytek/Sponza.gltf";
    if (!std::filesystem::exists(*options.scene)) GTEST_SKIP() << "Sponza is not there";
    expect_right(measure(options), 1, 32.0);
}

TEST_F(ExactSoft, WouldBeCaughtWithShadowsOfAPoint) {
    const bench::Accuracy accuracy = measure(soft({"filter=exact"}));
    for (const bench::LightAccuracy& light : accuracy.lights) {
        const Judged found = judge(light, 16.0);
        EXPECT_GT(found.square_error, 2.0 * found.chance) << light.report.name;
    }
}

}  // namespace
}  // namespace gnomon
