#include "tests/oracle/soft_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/oracle/soft_metrics.h"
#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {
namespace {

constexpr double kPi = glm::pi<double>();

/// Computes the share of a unit disk on one side of a line that passes at x from its middle.
double disk_beside(double x) {
    const double c = std::clamp(x, -1.0, 1.0);
    return 0.5 + (c * std::sqrt(1.0 - c * c) + std::asin(c)) / kPi;
}

/// Makes a floor and a sheet at that height over all of it where x is below 0. The camera does not see the sheet.
AnalyticScene half_covered(double height_m) {
    AnalyticScene scene;
    scene.place_floor(40.0);
    scene.place(scene.add_square(), {-20.0, height_m, 0.0}, glm::dmat3({40.0, 0, 0}, {0, 0, -40.0}, {0, 40.0, 0})).visible = false;
    return scene;
}

struct Traced {
    PrimaryHits hits;
    SoftTruth truth;
};
Traced trace(const AnalyticScene& scene, const LightItem& light, const SourceSampling& sampling = {}) {
    const ReferenceTracer tracer = scene.tracer();
    Traced traced{tracer.trace_primary(scene.view_from_above(64, 4.0)), {}};
    traced.truth = tracer.trace_source(traced.hits, light, sampling);
    return traced;
}

// Stratified: an edge crosses 4 / pi * 16 of 256 cells, each off by a half at most, of random sign.
constexpr double kNoise = 0.03, kMeanNoise = 0.002;

void expect_share(const Traced& traced, double radius_m) {
    double sum = 0.0, worst = 0.0;
    std::size_t between = 0;
    for (std::size_t i = 0; i < traced.hits.count(); ++i) {
        ASSERT_TRUE(traced.truth.scored[i]);
        const glm::dvec3 p = traced.hits.position_rel_m[i];
        const double expected = disk_beside(p.x / radius_m);
        const double off = static_cast<double>(traced.truth.visibility[i]) - expected;
        between += expected > 0.0 && expected < 1.0;
        worst = std::max(worst, std::abs(off));
        sum += off;
    }
    EXPECT_GT(between, 500u);
    EXPECT_LT(worst, kNoise);
    EXPECT_LT(std::abs(sum) / static_cast<double>(traced.hits.count()), kMeanNoise);
}

TEST(SoftTruth, UnderASunWithADiskIsTheShareOfTheDiskBesideTheEdge) {
    const AnalyticScene scene = half_covered(5.0);
    LightItem sun = scene.sun({0.0, 1.0, 0.0});
    sun.sun_radius_rad = static_cast<float>(std::atan(0.2));
    expect_share(trace(scene, sun), 5.0 * 0.2);
}

TEST(SoftTruth, UnderALampWidensWithTheWayFromTheCaster) {
    const AnalyticScene scene = half_covered(3.0);
    LightItem lamp = scene.lamp({0.0, 12.0, 0.0});
    lamp.source_radius_m = 1.0f;
    const Traced traced = trace(scene, lamp);
    double worst = 0.0;
    for (std::size_t i = 0; i < traced.hits.count(); ++i) {
        const glm::dvec3 p = traced.hits.position_rel_m[i];
        if (std::abs(p.z) > 0.5 || std::abs(p.x) > 1.0) continue;  // beyond, the disk tilts by more than the noise
        const double at_source_m = p.x - p.x * 12.0 / 3.0;          // where the ray over the edge gets there
        worst = std::max(worst, std::abs(static_cast<double>(traced.truth.visibility[i]) - disk_beside(-at_source_m)));
    }
    EXPECT_LT(worst, 1.5 * kNoise);
}

TEST(SoftTruth, OfAPointIsTheHardTruth) {
    const AnalyticScene scene = half_covered(5.0);
    const LightItem sun = scene.sun({0.1, 1.0, 0.0});
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(64, 4.0));
    EXPECT_EQ(source_size(sun), 0.0);
    EXPECT_EQ(tracer.trace_source(hits, sun, {}).visibility, tracer.visibility(hits, sun));
}

TEST(SoftTruth, FewRaysWhereAllAgreeGiveWhatAllRaysGiveForFarLess) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    for (int i = 0; i < 9; ++i) scene.place(scene.add_cube(), {i % 3 - 1.2, 0.9 + 0.4 * i, i / 3 - 0.8}, glm::dmat3(0.3)).visible = false;
    LightItem sun = scene.sun({0.3, 1.0, 0.2});
    sun.sun_radius_rad = 0.03f;
    const Traced few = trace(scene, sun), all = trace(scene, sun, {.first_few = false});
    EXPECT_EQ(all.truth.sampled, all.hits.count());
    EXPECT_LT(few.truth.sampled, all.hits.count() / 2);
    double off = 0.0;
    for (std::size_t i = 0; i < all.hits.count(); ++i)
        off += static_cast<double>(std::abs(few.truth.visibility[i] - all.truth.visibility[i]));
    EXPECT_LT(off / static_cast<double>(all.hits.count()), 1.0e-4);
}

// A picture of one plane, seen from above: pixels a metre apart.
struct Plain {
    PrimaryHits hits;
    SoftTruth truth;
};
Plain plain(glm::uvec2 size_px) {
    Plain p;
    p.hits.size_px = size_px;
    const std::size_t count = std::size_t{size_px.x} * size_px.y;
    p.hits.triangle.assign(count, 0);
    p.hits.normal_ws.assign(count, {0.0, 1.0, 0.0});
    for (std::size_t i = 0; i < count; ++i)
        p.hits.position_rel_m.emplace_back(static_cast<double>(i % size_px.x), 0.0, static_cast<double>(i / size_px.x));
    p.truth.visibility.assign(count, 1.0f);
    p.truth.scored.assign(count, 1);
    return p;
}
float ramp(double x, double middle, double width) {
    return static_cast<float>(std::clamp((x - middle) / width + 0.5, 0.0, 1.0));
}

TEST(SoftMetrics, AreNothingForThePictureItself) {
    Plain p = plain({100, 20});
    for (std::size_t i = 0; i < p.hits.count(); ++i) p.truth.visibility[i] = ramp(static_cast<double>(i % 100), 50.0, 25.0);
    const SoftMetrics m = compare_soft(p.hits, p.truth, p.truth.visibility);
    EXPECT_EQ(m.scored, 2000u);
    EXPECT_EQ(m.mean_error + m.umbra_leak + m.lit_loss + m.penumbra_error, 0.0);
    EXPECT_EQ(m.umbra + m.lit + m.penumbra, 2000u);
    EXPECT_EQ(m.widths.places, 20u);
    EXPECT_EQ(m.widths.median_ratio, 1.0);
}

TEST(SoftMetrics, TellHowWideAPenumbraIsOfWhatItShouldBeRisingAndFalling) {
    Plain p = plain({100, 20});
    for (const double wrong : {0.5, 0.8, 1.0, 1.25, 2.0}) {
        std::vector<float> measured(p.hits.count());
        for (std::size_t i = 0; i < p.hits.count(); ++i) {
            const auto x = static_cast<double>(i % 100);
            const bool falls = i / 100 >= 10;
            p.truth.visibility[i] = falls ? ramp(-x, -50.0, 20.0) : ramp(x, 50.0, 20.0);
            measured[i] = falls ? ramp(-x, -50.0, 20.0 * wrong) : ramp(x, 50.0, 20.0 * wrong);
        }
        const SoftMetrics m = compare_soft(p.hits, p.truth, measured);
        EXPECT_EQ(m.widths.places, 20u);
        EXPECT_NEAR(m.widths.median_ratio, wrong, 1e-5);
    }
}

TEST(SoftMetrics, CountLightInUmbraDarknessInLightAndHardEdges) {
    Plain p = plain({100, 10});
    std::vector<float> measured(p.hits.count());
    for (std::size_t i = 0; i < p.hits.count(); ++i) {
        p.truth.visibility[i] = ramp(static_cast<double>(i % 100), 50.0, 30.0);
        measured[i] = i % 100 < 50 ? 0.0f : 1.0f;
        if (i % 100 < 10) measured[i] = 0.5f;
        if (i % 100 >= 90) measured[i] = 0.75f;
    }
    const SoftMetrics m = compare_soft(p.hits, p.truth, measured);
    EXPECT_NEAR(m.umbra_leak, 0.5 * 100.0 / static_cast<double>(m.umbra), 1e-9);
    EXPECT_NEAR(m.lit_loss, 0.25 * 100.0 / static_cast<double>(m.lit), 1e-9);
    EXPECT_EQ(m.widths.places, 10u);
    EXPECT_LT(m.widths.median_ratio, 0.05);
}

TEST(SoftMetrics, MeasureNoWidthAcrossACreaseAndCallWhatIsMissingWrong) {
    Plain p = plain({100, 10});
    for (std::size_t i = 0; i < p.hits.count(); ++i) {
        p.truth.visibility[i] = ramp(static_cast<double>(i % 100), 50.0, 30.0);
        if (i % 100 >= 50) p.hits.normal_ws[i] = glm::normalize(glm::dvec3(0.01, 1.0, 0.0));
    }
    EXPECT_EQ(compare_soft(p.hits, p.truth, p.truth.visibility).widths.places, 0u);
    std::vector<float> measured(p.hits.count(), std::nanf(""));
    EXPECT_EQ(compare_soft(p.hits, p.truth, measured).mean_error, 1.0);
}

}  // namespace
}  // namespace gnomon::oracle
