#include <gtest/gtest.h>

#include "systems/shadow/request/ray_limit.h"
#include "tests/system/frame_fixture.h"

// Suns of filter=exact with casters that stay while the camera walks. A map that is drawn once and read for ever may be
// larger.
namespace gnomon {
namespace {

class QuietSuns : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        set([](LightShadow&) {});
        step();
        moving_texels = light("sun").counts.texels;
        ASSERT_GT(moving_texels, 0u);
    }
    template <class Change>
    void set(Change change) {
        edit_light(world.registry, sun, [](LightShadow& s) { s.filter = ShadowFilter::exact; });
        edit_light(world.registry, sun, change);
    }
    /// Moves the camera for `frames` frames. Returns how many maps were drawn meanwhile.
    std::uint32_t walk(std::uint32_t frames) {
        std::uint32_t drawn = 0;
        for (std::uint32_t i = 0; i < frames; ++i) {
            x_m += 1e-4;
            world.move(stage.camera, {x_m, 4, 8});
            step();
            drawn += light("sun").counts.views_drawn;
        }
        return drawn;
    }
    TestWorld::Stage stage;
    ecs::Entity sun;
    double x_m = 0.0;
    std::uint64_t moving_texels = 0;
    static constexpr std::uint64_t kLarger = 4;  // twice the edge
};

TEST_F(QuietSuns, GetALargerMapOnceWhileTheCameraWalks) {
    EXPECT_EQ(walk(shadow::kStaticSunFrames), 0u) << "not before";
    EXPECT_EQ(walk(1), 1u);
    EXPECT_EQ(light("sun").counts.texels, kLarger * moving_texels);
    EXPECT_EQ(walk(3 * shadow::kStaticSunFrames), 0u) << "and it stays";
    EXPECT_EQ(light("sun").counts.texels, kLarger * moving_texels);
}

TEST_F(QuietSuns, ThatAreDimmedInEveryFrameAreQuiet) {
    for (std::uint32_t i = 0; i < shadow::kStaticSunFrames; ++i) {
        world.registry.patch<Light>(sun, [](Light& l) { l.intensity *= 0.999f; });
        walk(1);
    }
    walk(1);
    EXPECT_EQ(light("sun").counts.texels, kLarger * moving_texels);
}

TEST_F(QuietSuns, StayQuietWhenSomethingElseComes) {
    walk(shadow::kStaticSunFrames / 2);
    world.add_light(LightKind::point, {0, 4, 0}, "another", false);
    world.add_mesh(kBox, {0, -50, 0}, false);
    walk(shadow::kStaticSunFrames / 2 + 1);
    EXPECT_EQ(light("sun").counts.texels, kLarger * moving_texels);
}

TEST_F(QuietSuns, AreNoneWhileTheyTurn) {
    for (std::uint32_t i = 0; i < 2 * shadow::kStaticSunFrames; ++i) {
        world.registry.patch<Transform>(sun, [](Transform& t) { t.rotation.x += 1e-6; });
        walk(1);
    }
    EXPECT_EQ(light("sun").counts.texels, moving_texels);
}

TEST_F(QuietSuns, GetTheSmallerOneAgainWithWhatHasToBeDrawnAnyway) {
    walk(shadow::kStaticSunFrames + 1);
    for (int i = 1; i <= 3; ++i) {
        world.move(stage.box, {0.01 * i, 1, 0});
        step();
        EXPECT_LE(light("sun").counts.views_drawn, 1u);
        step();
    }
    EXPECT_EQ(light("sun").counts.texels, moving_texels);
    EXPECT_LE(walk(shadow::kStaticSunFrames - 1), 1u);
    EXPECT_EQ(light("sun").counts.texels, moving_texels);
}

TEST_F(QuietSuns, OfAStillPictureHaveNothingDrawn) {
    for (std::uint32_t i = 0; i < 3 * shadow::kStaticSunFrames; ++i) {
        step();
        ASSERT_EQ(light("sun").counts.views_drawn, 0u) << i;
    }
    EXPECT_EQ(light("sun").counts.texels, moving_texels) << "nobody asks";
    EXPECT_TRUE(frame->report().still);
}

TEST_F(QuietSuns, KeepTheSizeThatIsAskedFor) {
    set([](LightShadow& s) { s.resolution_px = 256; });
    step();
    EXPECT_EQ(walk(2 * shadow::kStaticSunFrames), 0u);
    EXPECT_EQ(light("sun").counts.texels, 256u * 256u);
}

TEST_F(QuietSuns, AreNoneWhereAllIsDrawnInEveryFrame) {
    set([](ShadowTuning& t) { t.reuse.economy = false; });
    step();
    EXPECT_EQ(walk(2 * shadow::kStaticSunFrames), 2 * shadow::kStaticSunFrames);
    EXPECT_EQ(light("sun").counts.texels, moving_texels);
}

TEST_F(QuietSuns, DoNotGrowWithinABudget) {
    settings.shadow_budget.bytes = 2 * light("sun").counts.bytes;  // there would be no room, and then room again
    walk(1);
    EXPECT_EQ(walk(4 * shadow::kStaticSunFrames), 0u);
    EXPECT_EQ(light("sun").counts.texels, moving_texels);
}

TEST_F(QuietSuns, AreOnlyThoseThatAskByRays) {
    set([](LightShadow& s) { s.filter = ShadowFilter::triangles; });
    step();
    const std::uint64_t texels = light("sun").counts.texels;
    EXPECT_EQ(walk(2 * shadow::kStaticSunFrames), 0u);
    EXPECT_EQ(light("sun").counts.texels, texels);
}

}  // namespace
}  // namespace gnomon
