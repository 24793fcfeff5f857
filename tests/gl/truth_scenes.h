#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "bench/accuracy/accuracy.h"
#include "bench/accuracy/default_limits.h"
#include "bench/common/stage.h"
#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"
#include "sample_game/support/files/image_files.h"
#include "tests/own_folder.h"

namespace gnomon {

// The bounds that every light of every scene must meet with default settings, and no acne
// (bench/accuracy/default_limits.h).
inline constexpr double kMostWrong = bench::kMostWrongByDefault, kMostLeak = bench::kMostLeakByDefault;

/// Scene with a camera, to compare bounds of edges with.
struct TruthScene {
    const char* file;  // below the data folder; null: the built-in one
    const char* camera;
};
inline constexpr TruthScene kTruthScenes[] = {{nullptr, "main"},
                                              {nullptr, "top"},
                                              {nullptr, "low"},
                                              {"sponza-crytek/Sponza.gltf", nullptr},
                                              {"khronos-sample-models/Lantern/glTF/Lantern.gltf", nullptr},
                                              {"khronos-sample-models/SciFiHelmet/glTF/SciFiHelmet.gltf", nullptr}};

/// A folder that is gone at the end of the test.
class TruthTest : public ::testing::Test {
protected:
    std::filesystem::path courtyard_file(const game::CourtyardOptions& options) const {
        const auto file = folder_ / "courtyard.glb";
        const auto courtyard = game::make_courtyard(options);
        const auto error = game::write_file(file, std::as_bytes(std::span(courtyard.glb)));
        EXPECT_FALSE(error) << to_line(*error);
        return file;
    }

    static std::unique_ptr<bench::Stage> open(const bench::StageOptions& options) {
        auto stage = bench::Stage::open(options);
        if (!stage) {
            ADD_FAILURE() << to_line(stage.error());
            return nullptr;
        }
        return std::move(stage).value();
    }

    /// Measures without timings, and without edges unless `options` has them. Fails on any complaint of the driver.
    static bench::Accuracy measure(bench::Stage& stage, const bench::AccuracyOptions& options = {.timed_frames = 0}) {
        auto accuracy = bench::measure_accuracy(stage, options);
        if (!accuracy) {
            ADD_FAILURE() << to_line(accuracy.error());
            return {};
        }
        EXPECT_EQ(accuracy.value().gl_complaints, 0u);
        return std::move(accuracy).value();
    }
    static bench::Accuracy measure(const bench::StageOptions& options) {
        const auto stage = open(options);
        return stage ? measure(*stage) : bench::Accuracy{};
    }
    static bench::Accuracy measure_edges(bench::Stage& stage) {
        return measure(stage, {.timed_frames = 0, .with_edges = true});
    }
    static bench::Accuracy measure_edges(const bench::StageOptions& options) {
        const auto stage = open(options);
        return stage ? measure_edges(*stage) : bench::Accuracy{};
    }

private:
    OwnFolder own_;
    const std::filesystem::path& folder_ = own_.path();
};

inline const bench::LightAccuracy* find_light(const bench::Accuracy& accuracy, const std::string& name) {
    for (const bench::LightAccuracy& light : accuracy.lights)
        if (light.report.name == name) return &light;
    return nullptr;
}

inline double wrong_share(const oracle::Metrics& m) { return m.fraction(m.wrong); }
/// Bound for settings that are not the defaults.
inline constexpr double kMostAcneAndLeak = 0.001;
inline double false_shape_share(const oracle::Metrics& m) { return m.fraction(m.acne + m.leak); }

}  // namespace gnomon
