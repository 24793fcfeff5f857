#include <cmath>
#include <map>
#include <string>

#include "tests/system/frame_fixture.h"

/// A budget of time that leaves a light's views a slower pace: a light that has nothing else to give.
namespace gnomon {
namespace {

class BudgetRefresh : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        world.registry.patch<LightShadow>(lamp, [](LightShadow& s) {
            s.filter = ShadowFilter::hard;  // there is no plainer one,
            s.resolution_px = 64;           // and no coarser map
        });
    }
    void move_box() { world.move(stage.box, {0.001 * ++moves, 1, 0}); }
    /// Runs `frames` frames with a box that moves. Returns how many depth passes they draw.
    int draws_in(int frames) {
        int drawn = 0;
        for (int i = 0; i < frames; ++i) {
            move_box();
            step();
            drawn += static_cast<int>(depth_passes().size());
        }
        return drawn;
    }
    /// Sets a budget that suffices for lookups, and for this share of what drawing takes besides.
    void leave(double share) {
        settings.shadow_budget.gpu_ms = 1.0e3f;
        draws_in(60);
        const double moving_us = light("lamp").budget->us;
        for (int i = 0; i < 90; ++i) step();
        const double still_us = light("lamp").budget->us;
        ASSERT_GT(moving_us, still_us);
        settings.shadow_budget.gpu_ms = static_cast<float>((still_us + share * (moving_us - still_us)) * 1.0e-3);
    }
    TestWorld::Stage stage;
    ecs::Entity lamp;
    int moves = 0;
};

TEST_F(BudgetRefresh, IsHalvedOrQuarteredWhereThatIsEnough) {
    for (const auto& [share, every] : {std::pair{0.6, 2}, {0.3, 4}}) {
        leave(share);
        draws_in(60);
        EXPECT_EQ(draws_in(40), 40 / every);
        EXPECT_EQ(light("lamp").budget->refresh_frames, static_cast<std::uint32_t>(every));
        EXPECT_STREQ(reason_code(light("lamp").reason), "budget_shrunk");
    }
    leave(0.1);
    draws_in(60);
    EXPECT_STREQ(reason_code(light("lamp").reason), "over_budget");
}

TEST_F(BudgetRefresh, EndsWithTheLastOfWhatMoved) {
    leave(0.3);
    draws_in(60);
    for (int last = 0; last < 4; ++last) {
        draws_in(20 + last);  // ends in each of the four phases
        int drawn = 0;
        for (int i = 0; i < 4; ++i) {
            step();
            drawn += static_cast<int>(depth_passes().size());
        }
        EXPECT_LE(drawn, 1);
        for (int i = 0; i < 100; ++i) {
            step();
            if (i < 40) continue;
            EXPECT_EQ(depth_passes().size(), 0u) << "it holds what is there now";
        }
        EXPECT_TRUE(frame->report().still);
    }
}

TEST_F(BudgetRefresh, WaitsForNothingThatMovesTheMapItself) {
    leave(0.3);
    draws_in(60);
    int drawn = 0;
    for (int i = 0; i < 8; ++i) {
        move_box();
        world.registry.patch<Transform>(lamp, [i](Transform& t) { t.translation_m.x += i % 2 == 0 ? 0.01 : -0.01; });
        step();
        drawn += static_cast<int>(depth_passes().size());
    }
    EXPECT_EQ(drawn, 8) << "a map is looked up with the matrices that it was drawn with";
}

/// One thing moves that many lights' maps show: what is due at once.
class BudgetSpread : public FrameTest {
protected:
    static constexpr int kLamps = 24, kRoom = 8;  // views that a frame has time for

    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        for (int i = 0; i < kLamps; ++i) {
            const double turn = 0.25 * i;
            const glm::dvec3 at_m(4.0 * std::cos(turn), 6.0 + 0.1 * i, 4.0 * std::sin(turn));
            const ecs::Entity lamp = world.add_light(LightKind::spot, at_m, "lamp" + std::to_string(i));
            world.registry.patch<LightShadow>(lamp, [](LightShadow& s) {
                s.filter = ShadowFilter::hard;
                s.resolution_px = 64;  // there is nothing to give but time
            });
        }
        settings.shadow_budget.gpu_ms = 1.0e3f;
        for (int i = 0; i < 90; ++i) step();
        still_us = modelled_us();
    }
    void move_box() { world.move(stage.box, {0.001 * ++moves, 1, 0}); }
    double modelled_us() const {
        double sum_us = 0.0;
        for (const LightReport& light : frame->report().lights) sum_us += light.budget ? light.budget->us : 0.0;
        return sum_us;
    }
    /// What the model takes for one view: a pass, its texels, two draws at most and their triangles.
    static constexpr double kView_us = 5.0 + 64.0 * 64.0 * 0.02e-3 + 2.0 + 0.1;
    TestWorld::Stage stage;
    double still_us = 0.0;
    int moves = 0;
};

TEST_F(BudgetSpread, HasNoMoreDrawnInAFrameThanItHasTimeForOnceItIsKnownHowFarTheyAreOff) {
    settings.shadow_budget.gpu_ms = static_cast<float>((still_us + kRoom * kView_us) * 1.0e-3);
    move_box();
    step();
    ASSERT_EQ(depth_passes().size(), std::size_t{kLamps}) << "what stood still may have come from anywhere";
    std::map<std::string, int> last_drawn;
    int drawn = 0, held = 0;
    for (int i = 1; i <= 60; ++i) {
        move_box();
        step();
        EXPECT_LE(depth_passes().size(), std::size_t{kRoom + 1}) << "frame " << i;
        drawn += static_cast<int>(depth_passes().size());
        for (const LightReport& light : frame->report().lights) {
            if (light.counts.views == 0) continue;
            if (light.counts.views_drawn > 0) last_drawn[light.name] = i;
            held += light.why.stale_px > 0.0 ? 1 : 0;
            EXPECT_LE(i - last_drawn[light.name], 3) << light.name << " in frame " << i;
            EXPECT_EQ(light.counts.views_drawn == 0, light.why.stale_px > 0.0) << light.name;
        }
    }
    EXPECT_GT(drawn, 60 * kRoom / 2);
    EXPECT_GT(held, 60 * kLamps / 2);
    for (int i = 0; i < 40; ++i) step();
    for (const LightReport& light : frame->report().lights) EXPECT_EQ(light.why.stale_px, 0.0) << "all is up to date";
}

TEST_F(BudgetSpread, HasNobodyWaitWhereThereIsTime) {
    for (int i = 0; i < 10; ++i) {
        move_box();
        step();
        EXPECT_EQ(depth_passes().size(), std::size_t{kLamps});
    }
}

}  // namespace
}  // namespace gnomon
