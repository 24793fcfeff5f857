#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "gnomon/frame.h"
#include "tests/gl/frame_fixture.h"
#include "tests/gl/gl_state_record.h"
#include "tests/gl/unusual_gl_state.h"

/// gnomon::Frame, as users have it: what FrameSystem draws, with a device of its own in the engine's context.
namespace gnomon {
namespace {

class PublicFrame : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        place(add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0})), {}, false);
        moving =
            place(add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5})), {.translation_m = {0.0, 0.3, 0.0}});
        add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        add_light({.kind = LightKind::directional, .intensity = 100.0f}, {}, {1.0, -2.0, 0.5});
        lamp = add_light({.kind = LightKind::spot, .intensity = 100.0f}, {2.0, 4.0, 0.0}, {-2.0, -4.0, 0.0},
                         {.filter = ShadowFilter::exact, .resolution_px = 64});
        settings.viewport_px = {96, 64};
        settings.repeatable = true;
    }
    ecs::Entity moving, lamp;
};

TEST_F(PublicFrame, DrawsWhatItsStagesDraw) {
    auto made = Frame::create(library);
    ASSERT_TRUE(made) << to_line(made.error());
    Frame& shown = *made.value();
    std::vector<std::uint8_t> rgba;
    std::vector<float> values;
    EXPECT_FALSE(shown.read_picture(rgba));
    EXPECT_FALSE(shown.read_visibility(lamp, values));
    EXPECT_EQ(shown.picture_texture(), 0u);
    std::vector<std::uint8_t> first;
    for (int i = 0; i < 3; ++i) {
        world.patch<Transform>(moving, [&](Transform& at) { at.translation_m.x = 0.4 * i; });
        draw();
        shown.run(world, settings);
        ASSERT_TRUE(shown.read_picture(rgba));
        EXPECT_EQ(rgba, picture());
        ASSERT_TRUE(shown.read_visibility(lamp, values));
        EXPECT_EQ(values, visibility(1));
        EXPECT_NE(values, visibility(0)) << "the lights differ, or none was chosen";
        ASSERT_EQ(shown.report().lights.size(), 2u);
        EXPECT_EQ(shown.report().lights[1].entity, lamp);
        EXPECT_STREQ(reason_code(shown.report().lights[1].reason), reason_code(frame().report().lights[1].reason));
        EXPECT_NE(shown.picture_texture(), 0u);
        if (i == 0) first = rgba;
    }
    EXPECT_NE(first, rgba) << "something moves";
    EXPECT_FALSE(shown.read_visibility(moving, values)) << "it is no light";
}

TEST_F(PublicFrame, LeavesTheContextsStateAsItWas) {
    const UnusualGlState engine(EngineWork::feedback);
    const GlStateRecord before = record_gl_state();
    const auto unchanged = [&](const char* what) {
        EXPECT_THAT(differences(before, record_gl_state()), ::testing::IsEmpty()) << what;
    };
    {
        auto made = Frame::create(library);
        ASSERT_TRUE(made) << to_line(made.error());
        unchanged("create");
        settings.time_gpu = true;
        for (int i = 0; i < 3; ++i) made.value()->run(world, settings);
        unchanged("run");
        EXPECT_TRUE(made.value()->report().gpu_us);
        std::vector<std::uint8_t> rgba;
        EXPECT_TRUE(made.value()->read_picture(rgba));
        unchanged("read_picture");
    }
    unchanged("destruction");
}

TEST_F(PublicFrame, AnswersQueries) {
    auto made = Frame::create(library);
    ASSERT_TRUE(made);
    EXPECT_EQ(made.value()->visibility(lamp, {0.5, 0.0, 2.0}), 0.0f) << "no frame was run";
    made.value()->run(world, settings);
    const glm::dvec3 behind(-0.7, 0.1, 0.0), beside(0.0, 0.1, 1.0);  // the box stands between the lamp and the first
    EXPECT_EQ(made.value()->visibility(lamp, behind), 0.0f);
    EXPECT_EQ(made.value()->visibility(lamp, beside), 1.0f);
    EXPECT_EQ(made.value()->visibility(moving, beside), 0.0f) << "it is no light";
    world.patch<Transform>(moving, [&](Transform& at) { at.translation_m.z = 2.5; });
    made.value()->run(world, settings);
    EXPECT_EQ(made.value()->visibility(lamp, behind), 1.0f);
}

TEST_F(PublicFrame, MeasuresOnlyWhereThatIsWanted) {
    auto made = Frame::create(library);
    ASSERT_TRUE(made);
    made.value()->run(world, settings);
    EXPECT_FALSE(made.value()->report().gpu_us);
    settings.shadow_budget.gpu_ms = 100.0f;
    settings.repeatable = false;
    for (int i = 0; i < 3 && !made.value()->report().gpu_us; ++i) made.value()->run(world, settings);
    EXPECT_EQ(made.value()->report().gpu_us.has_value(), !device().info().is_software) << "it would slow frames down";
    settings.time_gpu = true;
    for (int i = 0; i < 3 && !made.value()->report().gpu_us; ++i) made.value()->run(world, settings);
    EXPECT_TRUE(made.value()->report().gpu_us);
    settings.time_gpu = false;
    settings.shadow_budget = {};
    made.value()->run(world, settings);
    made.value()->run(world, settings);
    EXPECT_FALSE(made.value()->report().gpu_us);
}

TEST_F(PublicFrame, DrawsDebugViewsByName) {
    auto made = Frame::create(library);
    ASSERT_TRUE(made);
    std::vector<std::uint8_t> plain, viewed;
    made.value()->run(world, settings);
    ASSERT_TRUE(made.value()->read_picture(plain));
    EXPECT_THAT(made.value()->debug_labels(), ::testing::IsEmpty());
    EXPECT_EQ(debug::find_view("no such view"), nullptr);
    settings.debug = {.view = debug::find_view("frusta")};
    ASSERT_NE(settings.debug.view, nullptr);
    made.value()->run(world, settings);
    ASSERT_TRUE(made.value()->read_picture(viewed));
    EXPECT_NE(viewed, plain);
    EXPECT_THAT(made.value()->debug_labels(), ::testing::Not(::testing::IsEmpty()));
}

}  // namespace
}  // namespace gnomon
