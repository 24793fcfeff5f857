#include "sample_game/gui/light_history.h"

#include <gtest/gtest.h>

#include "sample_game/gui/accuracy_cost_curve.h"

namespace gnomon::game {
namespace {

LightReport light_of(const std::string& name, std::optional<double> gpu_us, double error_px) {
    LightReport light;
    light.name = name;
    light.state = LightState::rendered;
    light.gpu_us = gpu_us;
    light.cpu_us = 500.0;
    light.predicted_error_px = error_px;
    return light;
}

FrameReport frame_of(std::vector<LightReport> lights) {
    FrameReport report;
    report.lights = std::move(lights);
    return report;
}

TEST(LightGraph, HasALinePerLightInMilliseconds) {
    LightGraph graph;
    graph.add(frame_of({light_of("sun", 3000.0, 1.5), light_of("lamp", 250.0, 4.0)}));
    ASSERT_EQ(graph.lines().size(), 2u);
    EXPECT_EQ(graph.lines()[0].name(), "sun");
    EXPECT_FLOAT_EQ(graph.lines()[0].latest().gpu_ms.value(), 3.0f);
    EXPECT_FLOAT_EQ(graph.lines()[1].latest().cpu_ms, 0.5f);
    EXPECT_FLOAT_EQ(graph.lines()[1].latest().error_px.value(), 4.0f);
    EXPECT_FLOAT_EQ(graph.most_ms(), 3.0f);
    EXPECT_FLOAT_EQ(graph.most_error_px(), 4.0f);
}

TEST(LightGraph, ATimeThatWasNotMeasuredIsNoneAndNotZero) {
    LightGraph graph;
    graph.add(frame_of({light_of("sun", std::nullopt, 1.0)}));
    EXPECT_FALSE(graph.lines()[0].latest().gpu_ms);
    EXPECT_FALSE(graph.lines()[0].median_gpu_ms());
    graph.add(frame_of({light_of("sun", 2000.0, 1.0)}));
    graph.add(frame_of({light_of("sun", std::nullopt, 1.0)}));
    EXPECT_FALSE(graph.lines()[0].latest().gpu_ms);
    EXPECT_FLOAT_EQ(graph.lines()[0].median_gpu_ms().value(), 2.0f) << "of those that were";
}

TEST(LightGraph, ALightWithoutAShadowHasNoError) {
    LightReport off = light_of("sun", std::nullopt, 9.0);
    off.state = LightState::skipped;
    LightGraph graph;
    graph.add(frame_of({off}));
    EXPECT_FALSE(graph.lines()[0].latest().error_px);
    EXPECT_EQ(graph.most_error_px(), 0.0f);
}

TEST(LightGraph, KeepsTheLastFramesOldestFirstAndFollowsItsLights) {
    LightGraph graph;
    const std::size_t all = LightLine::kFrames + 3;
    for (std::size_t i = 0; i < all; ++i)
        graph.add(frame_of({light_of("lamp", 0.0, 1.0), light_of("sun", 1000.0 * static_cast<double>(i), 1.0)}));
    const LightLine& sun = graph.lines()[1];
    ASSERT_EQ(sun.size(), LightLine::kFrames);
    EXPECT_FLOAT_EQ(sun[0].gpu_ms.value(), 3.0f);
    EXPECT_FLOAT_EQ(sun.latest().gpu_ms.value(), static_cast<float>(all - 1));
    graph.add(frame_of({light_of("sun", 7000.0, 1.0)}));
    ASSERT_EQ(graph.lines().size(), 1u) << "the lamp is gone";
    EXPECT_FLOAT_EQ(graph.lines()[0][0].gpu_ms.value(), 4.0f) << "the sun's line goes on in its new place";
    EXPECT_FLOAT_EQ(graph.lines()[0].latest().gpu_ms.value(), 7.0f);
}

TEST(LightGraph, AMedianIsAValueThatWasThere) {
    EXPECT_FALSE(median({}));
    EXPECT_EQ(median({3.0f}), 3.0f);
    EXPECT_EQ(median({3.0f, 1.0f}), 1.0f);
    EXPECT_EQ(median({9.0f, 1.0f, 2.0f}), 2.0f);
}

TEST(ContractCurve, StepsAreThemselvesAgainAndStayWithinTheSlider) {
    for (int step = kLeastContractStep; step <= kMostContractStep; ++step)
        EXPECT_EQ(contract_step(contract_px(step)), step);
    EXPECT_FLOAT_EQ(contract_px(0), 1.0f);
    EXPECT_FLOAT_EQ(contract_px(4), 2.0f);
    EXPECT_EQ(contract_step(1.0e6f), kMostContractStep);
    EXPECT_EQ(contract_step(0.0f), kLeastContractStep);
    EXPECT_EQ(contract_px(kMostContractStep + 5), contract_px(kMostContractStep));
}

LightReport drawn(LightReport light, std::uint64_t texels) {
    light.counts.views_drawn = 1;
    light.counts.texels = texels;
    light.counts.bytes = 4 * texels;
    return light;
}

TEST(ContractCurve, TellsFramesThatDrewFromThoseThatKeptTheirMaps) {
    ContractCurve curve;
    curve.add(2.0f, frame_of({drawn(light_of("sun", 8000.0, 1.9), 100)}));
    curve.add(2.0f, frame_of({light_of("sun", 2000.0, 1.9)}));
    curve.add(2.0f, frame_of({light_of("sun", 3000.0, 1.9)}));
    curve.add(2.0f, frame_of({light_of("sun", 4000.0, 1.9)}));
    const std::vector<ContractPoint> points = curve.points();
    ASSERT_EQ(points.size(), 1u);
    EXPECT_FLOAT_EQ(points[0].drawn_ms.value(), 8.0f);
    EXPECT_FLOAT_EQ(points[0].kept_ms.value(), 3.0f);
    EXPECT_EQ(points[0].frames, 4u);
}

TEST(ContractCurve, IsSortedBySettingAndSumsTheLightsThatAreMeant) {
    ContractCurve all, lamp;
    const FrameReport fine =
        frame_of({drawn(light_of("sun", 6000.0, 0.4), 400), drawn(light_of("lamp", 2000.0, 0.5), 40)});
    const FrameReport coarse =
        frame_of({drawn(light_of("sun", 1000.0, 3.5), 50), drawn(light_of("lamp", 500.0, 2.0), 5)});
    for (ContractCurve* curve : {&all, &lamp}) {
        const std::string name = curve == &lamp ? "lamp" : "";
        curve->add(4.0f, coarse, name);
        curve->add(0.5f, fine, name);
    }
    const auto points = all.points();
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].max_error_px, 0.5f);
    EXPECT_FLOAT_EQ(points[0].drawn_ms.value(), 8.0f);
    EXPECT_EQ(points[0].texels, 440u);
    EXPECT_EQ(points[0].bytes, 1760u);
    EXPECT_EQ(points[0].predicted_px, 0.5);
    EXPECT_EQ(points[1].texels, 55u);
    EXPECT_FLOAT_EQ(lamp.points()[0].drawn_ms.value(), 2.0f);
    EXPECT_EQ(lamp.points()[1].texels, 5u);
}

TEST(ContractCurve, WithoutTimersThereAreTexelsAndNoTimes) {
    ContractCurve curve;
    curve.add(1.0f, frame_of({drawn(light_of("sun", 6000.0, 1.0), 10), drawn(light_of("lamp", std::nullopt, 1.0), 1)}));
    ASSERT_EQ(curve.points().size(), 1u);
    EXPECT_FALSE(curve.points()[0].drawn_ms) << "part of a sum is not the sum";
    EXPECT_EQ(curve.points()[0].texels, 11u);
    curve.add(1.0f, frame_of({}));
    EXPECT_EQ(curve.points()[0].frames, 1u) << "a frame without any light that is meant tells nothing";
    curve.clear();
    EXPECT_TRUE(curve.points().empty());
}

TEST(ContractCurve, ForgetsTimesThatAreLongGone) {
    ContractCurve curve;
    for (int i = 0; i < 200; ++i) curve.add(1.0f, frame_of({light_of("sun", i < 100 ? 9000.0 : 1000.0, 1.0)}));
    EXPECT_FLOAT_EQ(curve.points()[0].kept_ms.value(), 1.0f);
}

}  // namespace
}  // namespace gnomon::game
