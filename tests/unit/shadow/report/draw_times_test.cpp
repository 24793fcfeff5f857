#include "systems/shadow/report/draw_times.h"

#include <gtest/gtest.h>

#include "systems/frame_timers.h"

namespace gnomon::shadow {
namespace {

class DrawTimesTest : public ::testing::Test {
protected:
    DrawTimesTest() {
        for (const std::uint32_t index : {4u, 9u}) {
            LightItem light;
            light.entity = {index, 1};
            scene.lights.push_back(light);
        }
        report.lights.resize(2);
    }
    void submit(std::uint64_t submission, std::uint32_t first_views, std::uint32_t second_views) {
        report.lights[0].counts.views_drawn = first_views;
        report.lights[1].counts.views_drawn = second_views;
        times.submitted(submission, scene, report);
    }
    void measured(std::uint32_t timer, std::uint64_t submission, double us) {
        const gl::Timing timing{timer, submission, us};
        times.learn({&timing, 1});
    }
    std::optional<double> first() const { return times.view_us(scene.lights[0].entity); }
    std::optional<double> second() const { return times.view_us(scene.lights[1].entity); }

    SceneSnapshot scene;
    FrameReport report;
    DrawTimes times;
};

TEST_F(DrawTimesTest, NothingIsKnownBeforeItIsMeasured) {
    submit(0, 1, 1);
    EXPECT_FALSE(first());
    EXPECT_FALSE(second());
}

TEST_F(DrawTimesTest, ALightsTimersAreSharedAmongTheViewsItDrew) {
    submit(0, 4, 1);
    for (int view = 0; view < 4; ++view) measured(shadow_timer(0), 0, 10.0);
    measured(shadow_timer(1), 0, 7.0);
    EXPECT_EQ(first(), 10.0);
    EXPECT_EQ(second(), 7.0);
}

TEST_F(DrawTimesTest, ItsLightingPassIsNoDrawing) {
    submit(0, 1, 1);
    measured(lighting_timer(0), 0, 10.0);
    EXPECT_FALSE(first());
}

TEST_F(DrawTimesTest, WhatComesLateIsOfTheLightsOfItsOwnFrame) {
    submit(0, 1, 0);
    std::swap(scene.lights[0], scene.lights[1]);  // light 0 is another one now
    submit(1, 0, 0);
    measured(shadow_timer(0), 0, 10.0);
    EXPECT_FALSE(first());
    EXPECT_EQ(second(), 10.0);
}

TEST_F(DrawTimesTest, WhatComesTooLateIsOfNoUse) {
    for (std::uint64_t frame = 0; frame < DrawTimes::kFrames; ++frame) submit(frame, 1, 1);
    measured(shadow_timer(0), 0, 10.0);
    EXPECT_EQ(first(), 10.0);
    submit(DrawTimes::kFrames, 1, 1);
    measured(shadow_timer(1), 0, 10.0);
    EXPECT_FALSE(second());
}

TEST_F(DrawTimesTest, ANewEntityOfTheSameIndexHasNotBeenMeasured) {
    submit(0, 1, 1);
    measured(shadow_timer(0), 0, 10.0);
    scene.lights[0].entity.version = 2;
    EXPECT_FALSE(first());
}

}  // namespace
}  // namespace gnomon::shadow
