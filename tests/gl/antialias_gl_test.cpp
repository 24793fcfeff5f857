#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/gl/truth_scenes.h"

// Antialiased edges against the lit share of each pixel's area (bench accuracy --area).
namespace gnomon {
namespace {

constexpr std::uint32_t kSide = 8;
constexpr glm::uvec2 kLarge_px{1280, 720}, kSmall_px{640, 360}, kTiny_px{320, 180};
// A light with fewer crossed pixels proves nothing.
constexpr std::size_t kLeastCrossed = 1000;

bench::StageOptions courtyard(glm::uvec2 size_px, std::vector<std::string> settings) {
    bench::StageOptions options;
    options.size_px = size_px;
    options.settings = std::move(settings);
    return options;
}

class Antialias : public TruthTest {
protected:
    static bench::Accuracy measure_areas(const bench::StageOptions& options, std::uint32_t side = kSide) {
        const auto stage = open(options);
        if (!stage) return {};
        auto accuracy = bench::measure_accuracy(*stage, {.timed_frames = 0, .area_side = side});
        if (!accuracy) {
            ADD_FAILURE() << to_line(accuracy.error());
            return {};
        }
        EXPECT_EQ(accuracy.value().gl_complaints, 0u);
        return std::move(accuracy).value();
    }
};

TEST_F(Antialias, EdgesHaveTheLitShareOfEachPixel) {
    constexpr double kMostError = 0.03, kMostBias = 0.005;
    const auto on = measure_areas(courtyard(kLarge_px, {"antialias=on"}));
    ASSERT_EQ(on.lights.size(), 3u);
    for (const char* name : {"sun", "lantern", "guard_lamp"}) {
        const bench::LightAccuracy* light = find_light(on, name);
        ASSERT_NE(light, nullptr) << name;
        EXPECT_GE(light->area->metrics.crossed, kLeastCrossed) << name;
        EXPECT_LE(light->area->metrics.mean_error, kMostError) << name;
        EXPECT_LE(std::abs(light->area->metrics.bias), kMostBias) << name;
    }
}

// Counts of a light's pixels, with antialiased edges beside without.
struct Changes {
    std::size_t between = 0;           // shares that are neither 0 nor 1
    std::size_t same = 0, others = 0;  // pixels that no edge crosses: equal to those without, or not
    std::size_t apart = 0;             // pixels without a share between that differ from those without, by any bit
};

Changes changes_of(const bench::LightAccuracy& on, const bench::LightAccuracy& off) {
    const oracle::AreaTruth& truth = on.area->truth;
    Changes changes;
    for (std::size_t pixel = 0; pixel < truth.lit.size(); ++pixel) {
        const float with = on.measured[pixel], without = off.measured[pixel];
        EXPECT_TRUE(without <= 0.0f || without >= 1.0f);
        const bool between = with > 0.0f && with < 1.0f;
        changes.between += between;
        changes.apart += !between && std::bit_cast<std::uint32_t>(with) != std::bit_cast<std::uint32_t>(without);
        const bool crossed = truth.lit[pixel] > 0.0f && truth.lit[pixel] < 1.0f;
        if (truth.area[pixel] == oracle::PixelArea::whole && !crossed)
            (std::abs(with - without) > 0.0f ? changes.others : changes.same) += 1;
    }
    return changes;
}

// One test, since each measurement traces 64 rays a pixel.
TEST_F(Antialias, IsFourTimesNearerThanYesOrNoAndLeavesPixelsThatNoEdgeCrosses) {
    constexpr double kMostExceptions = 0.005;  // what no texel shows, and facets that the area's plane leaves
    const auto on = measure_areas(courtyard(kSmall_px, {"antialias=on"})), off = measure_areas(courtyard(kSmall_px, {"antialias=off"}));
    ASSERT_EQ(on.lights.size(), 3u);
    ASSERT_EQ(off.lights.size(), 3u);
    for (std::size_t i = 0; i < on.lights.size(); ++i) {
        SCOPED_TRACE(on.lights[i].report.name);
        EXPECT_GE(on.lights[i].area->metrics.crossed, kLeastCrossed);
        EXPECT_GE(off.lights[i].area->metrics.mean_error, 4.0 * on.lights[i].area->metrics.mean_error);
        EXPECT_EQ(on.lights[i].report.counts.bytes, off.lights[i].report.counts.bytes);
        const Changes changes = changes_of(on.lights[i], off.lights[i]);
        EXPECT_GT(changes.between, kLeastCrossed) << "nothing is antialiased";
        EXPECT_EQ(changes.apart, 0u);
        // Control: another light's pixels are apart.
        EXPECT_GT(changes_of(on.lights[i], off.lights[(i + 1) % off.lights.size()]).apart, kLeastCrossed);
        EXPECT_LE(static_cast<double>(changes.others), kMostExceptions * static_cast<double>(changes.same + changes.others));
    }
}

/// Expects less error than without antialiased edges, as a share of that.
class AntialiasOfSources : public Antialias {
protected:
    static void expect_nearer(const std::vector<std::string>& light, double most_ratio) {
        const auto measured = [&](const char* antialias) {
            std::vector<std::string> settings = light;
            settings.emplace_back(antialias);
            return measure_areas(courtyard(kTiny_px, settings));
        };
        const auto on = measured("antialias=on"), off = measured("antialias=off");
        ASSERT_EQ(on.lights.size(), 3u);
        ASSERT_EQ(off.lights.size(), 3u);
        for (std::size_t i = 0; i < on.lights.size(); ++i) {
            SCOPED_TRACE(on.lights[i].report.name);
            const oracle::AreaMetrics &with = on.lights[i].area->metrics, &without = off.lights[i].area->metrics;
            EXPECT_GE(with.crossed, kLeastCrossed);
            EXPECT_LE(with.mean_error, without.mean_error * most_ratio);
            EXPECT_LE(std::abs(with.bias), std::abs(without.bias) + 0.01);
            EXPECT_EQ(on.lights[i].report.counts.bytes, off.lights[i].report.counts.bytes);
        }
    }
};

TEST_F(AntialiasOfSources, RaysHaveNoStairsInNarrowPenumbrae) {
    expect_nearer({"filter=exact_soft", "source_radius_m=0.02", "sun_radius_deg=0.27"}, 0.6);
}

TEST_F(AntialiasOfSources, TapsHaveFewerStairsInNarrowPenumbrae) {
    expect_nearer({"filter=pcss", "source_radius_m=0.02", "sun_radius_deg=0.27"}, 0.95);
}

TEST_F(AntialiasOfSources, TrianglesHaveFewerStairsInNarrowPenumbrae) {
    expect_nearer({"filter=soft_triangles", "source_radius_m=0.02", "sun_radius_deg=0.27"}, 0.75);
}

TEST_F(AntialiasOfSources, TapsHaveNoMoreErrorInWidePenumbrae) {
    expect_nearer({"filter=pcss", "source_radius_m=0.1", "sun_radius_deg=1"}, 1.0);
}

// Counts pixels that show another surface, too, and of their own lit places alone.
struct Feet { std::size_t all = 0, darkened = 0; };

Feet feet_of(const bench::LightAccuracy& light) {
    const oracle::AreaTruth& truth = light.area->truth;
    Feet feet;
    for (std::size_t pixel = 0; pixel < truth.lit.size(); ++pixel) {
        if (truth.area[pixel] != oracle::PixelArea::partial || truth.lit[pixel] < 1.0f) continue;
        ++feet.all;
        feet.darkened += light.measured[pixel] < 1.0f;
    }
    return feet;
}

// Rays from places of a pixel's area: what lies under a wall's foot, or in another surface, darkens no pixel beside it.
TEST_F(Antialias, RaysGiveTheLitShareToo) {
    constexpr double kMostError = 0.02, kMostBias = 0.005;
    constexpr std::uint32_t kManyPlaces = 16;    // with kSide, truth itself is off by as much as rays
    constexpr double kMostDarkenedFeet = 0.06;   // a quarter, where places inside other surfaces count
    constexpr double kMostExceptions = 0.005;
    const auto on = measure_areas(courtyard(kTiny_px, {"filter=exact", "antialias=on"}), kManyPlaces);
    const auto off = measure_areas(courtyard(kTiny_px, {"filter=exact", "antialias=off"}));
    ASSERT_EQ(on.lights.size(), 3u);
    ASSERT_EQ(off.lights.size(), 3u);
    for (std::size_t i = 0; i < on.lights.size(); ++i) {
        SCOPED_TRACE(on.lights[i].report.name);
        const oracle::AreaMetrics& metrics = on.lights[i].area->metrics;
        EXPECT_GE(metrics.crossed, kLeastCrossed);
        EXPECT_LE(metrics.mean_error, kMostError);
        EXPECT_LE(std::abs(metrics.bias), kMostBias);
        EXPECT_GE(off.lights[i].area->metrics.mean_error, 10.0 * metrics.mean_error);
        const Changes changes = changes_of(on.lights[i], off.lights[i]);
        EXPECT_EQ(changes.apart, 0u);
        EXPECT_LE(static_cast<double>(changes.others), kMostExceptions * static_cast<double>(changes.same + changes.others));
        const Feet feet = feet_of(on.lights[i]);
        EXPECT_GE(feet.all, kLeastCrossed);
        EXPECT_LE(static_cast<double>(feet.darkened), kMostDarkenedFeet * static_cast<double>(feet.all));
    }
}

}  // namespace
}  // namespace gnomon
