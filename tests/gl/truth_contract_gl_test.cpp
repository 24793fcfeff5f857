#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "bench/accuracy/stated_accuracy.h"
#include "bench/scaling/many_lights_scene.h"
#include "gnomon/components.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/gl/truth_scenes.h"
#include "tests/unit/math/random_seed.h"

// The accuracy contract, measured. Where a light's report states that it keeps max_error_px, its shadow edges lie
// within that of where rays find them.
namespace gnomon {
namespace {

/// Below this a map is the smallest there is, and one of half its size may still meet its light's target.
constexpr std::uint32_t kLeastToHalve_px = 512;
constexpr std::uint32_t kRandomLights = 24;

class TruthContract : public TruthTest {
protected:
    static bench::StageOptions asking_for(const std::string& max_error_px, const char* filter) {
        bench::StageOptions options;
        options.size_px = {480, 270};
        // Where two maps are mixed, a shadow of one pixel's width is grey and has no edge.
        options.settings = {"max_error_px=" + max_error_px, std::string("filter=") + filter, "cascade_blend=0"};
        return options;
    }

    struct Kept {
        std::size_t lights = 0, broken = 0, places = 0;
        oracle::EdgeExceptions beyond;
    };
    static bool walks(const LightReport& light) { return shadow::filter_row(light.filter.filter).storage.triangle_ids; }
    static void expect_kept(const bench::Accuracy& accuracy, Kept& kept) {
        for (const bench::LightAccuracy& light : accuracy.lights) {
            kept.broken += !light.report.keeps_max_error && light.report.counts.views > 0;
            if (!light.report.keeps_max_error || !light.edges) continue;
            SCOPED_TRACE(accuracy.scene + ", " + light.report.name);
            if (walks(light.report)) {
                EXPECT_EQ(bench::broken_words(light), "");
            } else {
                EXPECT_EQ(light.edges->contract.unexplained, 0u);
            }
            ++kept.lights;
            kept.places += light.metrics.edge.places;
            kept.beyond.sub_texel_caster += light.edges->contract.sub_texel_caster;
            kept.beyond.truth_ambiguous += light.edges->contract.truth_ambiguous;
            kept.beyond.unexplained += light.edges->contract.unexplained;
        }
    }
    static void print(const char* what, const Kept& kept) {
        std::printf(
            "%s: %zu lights say that they keep it, %zu that they do not; of %zu places beyond it: sub_texel_caster "
            "%zu, truth_ambiguous %zu, unexplained %zu\n",
            what, kept.lights, kept.broken, kept.places, kept.beyond.sub_texel_caster, kept.beyond.truth_ambiguous,
            kept.beyond.unexplained);
    }

    static std::uint32_t map_px(const LightReport& light) {
        return light.views.count == 0 ? 0u
                                      : static_cast<std::uint32_t>(
                                            std::sqrt(static_cast<double>(light.counts.texels / light.views.count)));
    }
};

TEST_F(TruthContract, IsKeptAtEveryEdgeOfEveryLightThatSaysSo) {
    for (const char* filter : {"hard", "triangles"}) {
        Kept kept;
        for (const char* wish_px : {"1", "3", "6"})
            for (const char* camera : {"main", "top", "low"}) {
                SCOPED_TRACE(std::string(filter) + ", " + wish_px + " px, " + camera);
                bench::StageOptions options = asking_for(wish_px, filter);
                options.camera = camera;
                expect_kept(measure_edges(options), kept);
            }
        print(filter, kept);
        EXPECT_GE(kept.lights, 6u);
        EXPECT_GT(kept.places, 10000u);
    }
}

/// Checks that every light meets its target if it may choose its filter. Where no map of the usual filter does, another
/// filter does.
TEST_F(TruthContract, IsKeptByEveryLightWhoseFilterIsTheContractsToChoose) {
    std::size_t chosen = 0;
    Kept named, kept;
    for (const char* wish_px : {"0.5", "1", "3"})
        for (const char* camera : {"main", "low"}) {
            SCOPED_TRACE(std::string(wish_px) + " px, " + camera);
            bench::StageOptions options = asking_for(wish_px, "triangles");
            options.camera = camera;
            const auto stage = open(options);
            ASSERT_TRUE(stage);
            stage->run_frame();
            for (const LightReport& light : stage->frame().report().lights)
                named.broken += !light.keeps_max_error && light.counts.views > 0;
            options.settings[1] = "filter=automatic";
            const bench::Accuracy accuracy = measure_edges(options);
            expect_kept(accuracy, kept);
            for (const bench::LightAccuracy& light : accuracy.lights)
                chosen += light.report.filter.reason == Reason::map_too_coarse;
        }
    print("automatic", kept);
    EXPECT_EQ(kept.broken, 0u);
    EXPECT_GE(chosen, 6u);
    EXPECT_EQ(chosen, named.broken) << "and only those that would have broken it";
    EXPECT_GT(kept.places, 5000u);
}

TEST_F(TruthContract, IsKeptInRandomLevels) {
    const std::uint64_t seed = print_seed();
    Kept kept;
    for (std::uint64_t i = 0; i < 4; ++i) {
        const char* const wish_px = i % 2 == 0 ? "3" : "6";
        const bench::StageOptions options = asking_for(wish_px, i < 2 ? "hard" : "triangles");
        auto stage = bench::Stage::open(options, bench::demand_scene(kRandomLights, seed + i));
        ASSERT_TRUE(stage);
        // From above: at the height of eyes no map is as fine as the nearest ground needs.
        std::mt19937_64 random(seed + i);
        const auto number = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
        const glm::dvec3 eye_m(number(-15.0, 15.0), number(10.0, 20.0), number(-15.0, 15.0));
        stage.value()->world().patch<Transform>(
            stage.value()->spawned().cameras.front().entity, [&](Transform& camera) {
                camera.translation_m = eye_m;
                camera.rotation = glm::quatLookAt(glm::normalize(-eye_m), glm::dvec3(0.0, 1.0, 0.0));
            });
        expect_kept(measure_edges(*stage.value()), kept);
    }
    print("random levels", kept);
    EXPECT_GE(kept.lights, 8u);
    EXPECT_GT(kept.places, 100u);
}

/// Checks that half the texels break the contract. Texels decide under `hard`. Walks find edges by any texels, and
/// resolve less: only casters twice as wide.
TEST_F(TruthContract, IsBrokenByMapsHalfAsLargeAsItChose) {
    std::size_t halved = 0;
    for (const char* filter : {"hard", "triangles"})
        for (const char* wish_px : {"2", "4"}) {
            const auto stage = open(asking_for(wish_px, filter));
            ASSERT_TRUE(stage);
            stage->run_frame();
            const std::vector<LightReport> chosen = stage->frame().report().lights;
            for (std::size_t i = 0; i < chosen.size(); ++i) {
                const std::uint32_t size_px = map_px(chosen[i]);
                if (!chosen[i].keeps_max_error || size_px < kLeastToHalve_px) continue;
                SCOPED_TRACE(chosen[i].name + ", " + std::to_string(size_px));
                ASSERT_FALSE(stage->apply_setting("resolution=" + std::to_string(size_px / 2)));
                stage->run_frame();
                const LightReport& coarse = stage->frame().report().lights[i];
                EXPECT_EQ(coarse.keeps_max_error, walks(coarse));
                EXPECT_GT(coarse.resolved.px, 1.5 * chosen[i].resolved.px);
                EXPECT_GT(coarse.resolved.m, 1.5 * chosen[i].resolved.m);
                ++halved;
            }
        }
    EXPECT_GE(halved, 3u);
}

TEST_F(TruthContract, IsFoundBrokenWhereMapsHaveFourTimesTheTexelsThatTheySay) {
    std::size_t asked = 0, found = 0;
    for (const char* camera : {"main", "low"}) {
        bench::StageOptions options = asking_for("6", "hard");
        options.camera = camera;
        const auto stage = open(options);
        ASSERT_TRUE(stage);
        const auto accuracy =
            bench::measure_accuracy(*stage, {.timed_frames = 0, .with_edges = true, .target_factor = 0.25});
        ASSERT_TRUE(accuracy);
        for (const bench::LightAccuracy& light : accuracy.value().lights) {
            asked += light.report.keeps_max_error;
            found += light.edges && light.edges->contract.unexplained > 0;
        }
    }
    std::printf("%zu lights keep it, %zu of them are found out\n", asked, found);
    EXPECT_GE(asked, 3u);
    EXPECT_GE(found, 2u);
}

}  // namespace
}  // namespace gnomon
