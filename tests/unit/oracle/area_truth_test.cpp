#include "tests/oracle/area_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kSide_px = 48;
constexpr double kPixel_m = 4.0 / kSide_px;
// Discrepancy of a lattice of 256 points for half-planes.
constexpr double kMost = 0.03, kMean = 0.002;

/// Returns the share of the unit square around the origin where dot(across, place) is below `to`; `across` is a unit vector.
double square_below(const glm::dvec2& across, double to) {
    const double a = std::max(std::abs(across.x), std::abs(across.y)), b = std::min(std::abs(across.x), std::abs(across.y));
    const double s = std::min(std::abs(to), 0.5 * (a + b));
    // From the middle to s: a band of width 1 / a, less a triangle once the line meets a corner.
    const double flat = 0.5 * (a - b);
    double share = s / a;
    if (s > flat) share = b > 0.0 ? 0.5 - (0.5 * (a + b) - s) * (0.5 * (a + b) - s) / (2.0 * a * b) : 0.5;
    return 0.5 + (to < 0.0 ? -share : share);
}

TEST(AreaTruth, SquaresBesideALineByHand) {
    EXPECT_DOUBLE_EQ(square_below({1.0, 0.0}, 0.25), 0.75);
    EXPECT_DOUBLE_EQ(square_below({0.0, 1.0}, -0.5), 0.0);
    const double r = std::sqrt(0.5);
    EXPECT_NEAR(square_below({r, r}, 0.0), 0.5, 1e-12);
    EXPECT_NEAR(square_below({r, r}, -r / 2.0), 0.125, 1e-12);  // a corner triangle with sides of a half
}

/// A floor seen from above, and over half of it a sheet that the camera does not see. Its edge has a direction and a
/// distance from the middle.
struct HalfCovered {
    AnalyticScene scene;
    glm::dvec2 across;  // unit, in the picture, from the shadow to the light
    double off_m = 0.0;

    HalfCovered(double angle_rad, double off, double height_m) : across(std::cos(angle_rad), std::sin(angle_rad)), off_m(off) {
        scene.place_floor(40.0);
        const glm::dvec3 way(across.x, 0.0, -across.y), along(across.y, 0.0, across.x);
        scene.place(scene.add_square(), way * (off - 20.0) + glm::dvec3(0.0, height_m, 0.0),
                    glm::dmat3(way * 40.0, along * 80.0, {0, 40.0, 0}))
            .visible = false;
    }
    struct Traced {
        PrimaryHits hits;
        LightTruth middles;
        AreaTruth truth;
    };
    Traced trace(const LightItem& light, const AreaSampling& sampling = {}) const {
        const ReferenceTracer tracer = scene.tracer();
        const ConsumerItem camera = scene.view_from_above(kSide_px, 4.0);
        Traced traced{tracer.trace_primary(camera), {}, {}};
        traced.middles = tracer.trace_light(traced.hits, light, true);
        traced.truth = tracer.trace_area(camera, traced.hits, traced.middles, light, sampling);
        return traced;
    }
};

/// Expects the closed form. `magnified`: how much larger the shadow is than the sheet.
void expect_shares(const HalfCovered& world, const LightItem& light, double magnified) {
    const auto traced = world.trace(light);
    double sum = 0.0;
    std::size_t crossed = 0;
    for (std::size_t i = 0; i < traced.hits.count(); ++i) {
        ASSERT_EQ(traced.truth.area[i], PixelArea::whole);
        const glm::dvec3 p = traced.hits.position_rel_m[i];
        const double beyond_m = glm::dot(world.across, glm::dvec2(p.x, -p.z)) - world.off_m * magnified;
        const double expected = square_below(-world.across, beyond_m / kPixel_m);
        const double off = static_cast<double>(traced.truth.lit[i]) - expected;
        EXPECT_LT(std::abs(off), kMost) << "beyond by " << beyond_m / kPixel_m << " px";
        sum += off;
        crossed += expected > 0.0 && expected < 1.0;
    }
    EXPECT_GE(crossed, kSide_px);
    EXPECT_LT(std::abs(sum) / static_cast<double>(crossed), kMean * 5.0);
}

TEST(AreaTruth, OfAStraightEdgeIsTheShareOfThePixelBesideIt) {
    for (const double angle_rad : {0.0, 0.3, 0.8, 1.2, 2.5, 4.0})
        for (const double off_m : {0.0, 0.013, -0.37}) {
            SCOPED_TRACE(std::to_string(angle_rad) + ", " + std::to_string(off_m));
            const HalfCovered world(angle_rad, off_m, 5.0);
            expect_shares(world, world.scene.sun({0.0, 1.0, 0.0}), 1.0);
        }
}

TEST(AreaTruth, UnderALampTheShadowIsLarger) {
    const HalfCovered world(0.5, 0.31, 3.0);
    expect_shares(world, world.scene.lamp({0.0, 12.0, 0.0}), 12.0 / 9.0);
    expect_shares(world, world.scene.spot({0.0, 12.0, 0.0}, {0.0, 1.0, 0.0}, 0.9), 12.0 / 9.0);
}

/// Returns the share of the unit disk where x is below `to`.
double disk_below(double to) {
    const double x = std::clamp(to, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::acos(-1.0);
}

TEST(AreaTruth, OfASourceIsTheShareOfItsDiskWhereThatIsManyPixelsWide) {
    constexpr double kHeight_m = 5.0, kWide_px = 12.0, kMostOfDisk = 0.05, kMeanOfDisk = 0.01;
    for (const double angle_rad : {0.0, 0.8, 2.5}) {
        SCOPED_TRACE(angle_rad);
        const HalfCovered world(angle_rad, 0.013, kHeight_m);
        LightItem sun = world.scene.sun({0.0, 1.0, 0.0});
        sun.sun_radius_rad = static_cast<float>(std::atan(kWide_px * kPixel_m / kHeight_m));
        const auto soft = world.trace(sun, {.of_source = true}), hard = world.trace(sun);
        double error = 0.0, hard_error = 0.0;
        for (std::size_t i = 0; i < soft.hits.count(); ++i) {
            const glm::dvec3 p = soft.hits.position_rel_m[i];
            const double beyond_m = glm::dot(world.across, glm::dvec2(p.x, -p.z)) - world.off_m;
            const double expected = disk_below(beyond_m / (kWide_px * kPixel_m));
            const double off = std::abs(static_cast<double>(soft.truth.lit[i]) - expected);
            EXPECT_LT(off, kMostOfDisk) << "beyond by " << beyond_m / kPixel_m << " px";
            error += off;
            hard_error += std::abs(static_cast<double>(hard.truth.lit[i]) - expected);
        }
        const auto pixels = static_cast<double>(soft.hits.count());
        EXPECT_LT(error / pixels, kMeanOfDisk);
        EXPECT_GT(hard_error / pixels, 5.0 * kMeanOfDisk) << "the control: rays to the middle alone";
    }
}

TEST(AreaTruth, OfASourceWithoutASizeIsThatOfItsMiddleToTheBit) {
    const HalfCovered world(0.8, 0.013, 5.0);
    const LightItem sun = world.scene.sun({0.0, 1.0, 0.0});
    EXPECT_EQ(world.trace(sun, {.of_source = true}).truth.lit, world.trace(sun).truth.lit);
}

TEST(AreaTruth, WithoutCasterNoPixelIsCrossed) {
    AnalyticScene scene;
    scene.place_floor(40.0);
    const ReferenceTracer tracer = scene.tracer();
    const ConsumerItem camera = scene.view_from_above(kSide_px, 4.0);
    const PrimaryHits hits = tracer.trace_primary(camera);
    const LightItem sun = scene.sun({0.3, 1.0, 0.2});
    const AreaTruth truth = tracer.trace_area(camera, hits, tracer.trace_light(hits, sun, false), sun, {});
    const std::vector<float> lit(hits.count(), 1.0f), half(hits.count(), 0.5f);
    const AreaMetrics right = compare_area(truth, lit, {}), wrong = compare_area(truth, half, {});
    EXPECT_EQ(right.crossed, 0u);
    EXPECT_EQ(right.uncrossed, hits.count());
    EXPECT_EQ(right.uncrossed_error, 0.0);
    EXPECT_EQ(wrong.uncrossed_error, 0.5);
    EXPECT_EQ(truth.sampled, 0u);
}

TEST(AreaTruth, WhereAnotherSurfaceShowsInAPixelItIsPartial) {
    AnalyticScene scene;
    scene.place_floor(40.0);
    // A box's top covers the pixels where x and z are below 1/3 of a pixel beyond whole ones.
    scene.place(scene.add_cube(), {-5.0 + kPixel_m / 3.0, 0.5, -5.0 + kPixel_m / 3.0}, glm::dmat3({10, 0, 0}, {0, 1, 0}, {0, 0, 10}));
    const ReferenceTracer tracer = scene.tracer();
    const ConsumerItem camera = scene.view_from_above(kSide_px, 4.0);
    const PrimaryHits hits = tracer.trace_primary(camera);
    const LightItem sun = scene.sun({0.0, 1.0, 0.0});
    const AreaTruth truth = tracer.trace_area(camera, hits, tracer.trace_light(hits, sun, false), sun, {});
    EXPECT_EQ(std::count(truth.area.begin(), truth.area.end(), PixelArea::partial), kSide_px + 1);
    EXPECT_EQ(std::count(truth.area.begin(), truth.area.end(), PixelArea::unscored), 0);
    // What shows of the floor is lit, and of the box, too: the crease is no shadow's edge.
    EXPECT_EQ(*std::min_element(truth.lit.begin(), truth.lit.end()), 1.0f);
}

TEST(AreaTruth, OfAFewPixelsIsThatOfThePicture) {
    const HalfCovered world(0.5, 0.31, 3.0);
    const LightItem light = world.scene.lamp({0.0, 12.0, 0.0});
    const auto traced = world.trace(light);
    std::vector<std::size_t> crossed;
    for (std::size_t i = 0; i < traced.hits.count(); ++i)
        if (traced.truth.lit[i] > 0.0f && traced.truth.lit[i] < 1.0f) crossed.push_back(i);
    ASSERT_GE(crossed.size(), kSide_px);
    const AreaTruth few = world.scene.tracer().trace_area(world.scene.view_from_above(kSide_px, 4.0), traced.hits, crossed, light, {});
    for (std::size_t k = 0; k < crossed.size(); ++k) {
        EXPECT_EQ(few.lit[k], traced.truth.lit[crossed[k]]);
        EXPECT_EQ(few.area[k], PixelArea::whole);
    }
}

TEST(AreaTruth, JitteredByAPixelItIsThatOfTheNeighbour) {
    const HalfCovered world(0.5, 0.31, 3.0);
    const ReferenceTracer tracer = world.scene.tracer();
    const ConsumerItem camera = world.scene.view_from_above(kSide_px, 4.0);
    const LightItem light = world.scene.lamp({0.0, 12.0, 0.0});
    const PrimaryHits still = tracer.trace_primary(camera), moved = tracer.trace_primary(camera, {1.0, 0.0});
    std::vector<std::size_t> pixels, beside;
    for (std::size_t i = 0; i < still.count(); ++i) {
        if (i % kSide_px + 1 == kSide_px) continue;
        pixels.push_back(i);
        beside.push_back(i + 1);
    }
    const AreaTruth of_moved = tracer.trace_area(camera, moved, pixels, light, {}),
                    of_still = tracer.trace_area(camera, still, beside, light, {}),
                    unmoved = tracer.trace_area(camera, still, pixels, light, {});
    std::size_t same = 0, same_unmoved = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        same += of_moved.lit[k] == of_still.lit[k];
        same_unmoved += of_moved.lit[k] == unmoved.lit[k];
    }
    EXPECT_EQ(same, pixels.size());
    EXPECT_LT(same_unmoved + kSide_px, pixels.size());  // control: the edge has moved
}

TEST(AreaTruth, YesOrNoIsOffByAQuarterOnAverage) {
    double error = 0.0;
    std::size_t count = 0;
    for (const double angle_rad : {0.2, 0.5, 0.9, 1.3}) {
        const HalfCovered world(angle_rad, 0.01, 5.0);
        const auto traced = world.trace(world.scene.sun({0.0, 1.0, 0.0}));
        const AreaMetrics m = compare_area(traced.truth, traced.middles.visibility, traced.middles.ambiguous);
        const AreaMetrics same = compare_area(traced.truth, traced.truth.lit, traced.middles.ambiguous);
        EXPECT_EQ(same.mean_error, 0.0);
        EXPECT_EQ(m.uncrossed_error, 0.0);
        EXPECT_LT(std::abs(m.bias), 0.03);
        EXPECT_GT(m.p99_error, 0.45);
        error += m.mean_error * static_cast<double>(m.crossed);
        count += m.crossed;
    }
    EXPECT_NEAR(error / static_cast<double>(count), 0.2, 0.06);
}

}  // namespace
}  // namespace gnomon::oracle
