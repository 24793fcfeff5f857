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
    /// In so many frames with a box that moves.
    int draws_in(int frames) {
        int drawn = 0;
        for (int i = 0; i < frames; ++i) {
            move_box();
            step();
            drawn += static_cast<int>(depth_passes().size());
        }
        return drawn;
    }
    /// A budget between what looking up takes and what drawing takes besides, at that share of it.
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
        world.registry.patch<Transform>(lamp, [i](Transform& t) { t.translation_m.x += i % 2 == 0 ? 0.5 : -0.5; });
        step();
        drawn += static_cast<int>(depth_passes().size());
    }
    EXPECT_EQ(drawn, 8) << "a map is looked up with the matrices that it was drawn with";
}

}  // namespace
}  // namespace gnomon
