#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// Shadow catchers: the passes that lighting takes for them, and what these own.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ShadowCatchers : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        spot = world.add_light(LightKind::spot, kLightPlace_m, "spot");
    }
    void catches(bool on) {
        world.registry.patch<MeshRef>(stage.plane, [on](MeshRef& m) { m.shadow_catcher = on; });
    }
    std::vector<Pass> catcher_passes() const {
        std::vector<Pass> of_catchers = passes();
        std::erase_if(of_catchers, [](const Pass& pass) { return pass.group != "catchers"; });
        return of_catchers;
    }
    std::string target_of(const Pass& pass) const { return device.target(pass.begin.target)->label; }
    /// Returns labels of textures and targets; programs stay until the end.
    std::vector<std::string> owned() const {
        std::vector<std::string> labels = map_labels(device, "caught light");
        std::erase_if(labels, [](const std::string& label) { return label.find(".glsl") != std::string::npos; });
        return labels;
    }
    std::size_t drawn_surfaces() const {
        for (const Pass& pass : passes())
            if (pass.group == "surfaces") return pass.draws.size();
        return 0;
    }

    TestWorld::Stage stage;
    ecs::Entity sun, spot;
};

TEST_F(ShadowCatchers, AreNoSurfacesButFallIntoDepthsSumsAndTheirShares) {
    step();
    const std::size_t surfaces = drawn_surfaces();
    catches(true);
    step();
    EXPECT_EQ(drawn_surfaces(), surfaces - 1);
    const std::vector<Pass> all = catcher_passes();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(target_of(all[0]), "caught light");
    EXPECT_FALSE(all[0].begin.clear_depth) << "behind surfaces there are none";
    ASSERT_EQ(all[0].draws.size(), 1u);
    EXPECT_TRUE(all[0].pipelines[0].depth_write);
    EXPECT_EQ(target_of(all[1]), "caught light");
    EXPECT_TRUE(all[1].begin.clear_colour);
    EXPECT_EQ(all[1].draws.size(), 3u) << "ambient light, sun and spot";
    for (const gl::PipelineState& state : all[1].pipelines) {
        EXPECT_EQ(state.depth_test, gl::DepthTest::equal);
        EXPECT_FALSE(state.depth_write);
        EXPECT_EQ(state.blend, gl::Blend::add);
    }
    EXPECT_EQ(target_of(all[2]), "light sum");
    EXPECT_EQ(all[2].pipelines.back().blend, gl::Blend::alpha);
}

TEST_F(ShadowCatchers, ReceiveAsTheSurfaceWould) {
    step();
    const std::size_t maps = depth_passes().size();
    ASSERT_GT(maps, 0u);
    const LightReport before = light("spot");
    catches(true);
    step();
    EXPECT_EQ(light("spot").why.receivers, before.why.receivers);
    EXPECT_EQ(light("spot").why.casters, before.why.casters);
    EXPECT_TRUE(depth_passes().empty()) << "the maps stay: their content does not depend on it";
}

TEST_F(ShadowCatchers, CostAWorldWithoutThemNothing) {
    settings.transparent = false;
    for (int frame = 0; frame < 3; ++frame) step();
    const std::vector<gl::Command> never = frame->commands().commands;
    const std::vector<std::string> labels = device.live_labels();
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("cat"))));
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("caught"))));
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("transparent"))));
    EXPECT_THAT(owned(), IsEmpty());
    EXPECT_THAT(catcher_passes(), IsEmpty());
    catches(true);
    step();
    EXPECT_THAT(owned(), Not(IsEmpty())) << "control";
    EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("caught"))) << "control";
    catches(false);
    for (int i = 0; i < 3; ++i) step();
    EXPECT_THAT(owned(), IsEmpty()) << "nor one that had them";
    EXPECT_THAT(catcher_passes(), IsEmpty());
    EXPECT_EQ(frame->commands().commands.size(), never.size());
}

TEST_F(ShadowCatchers, OutOfSightCostNothing) {
    catches(true);
    world.move(stage.plane, {0.0, 0.0, 500.0});  // behind the camera
    step();
    EXPECT_THAT(catcher_passes(), IsEmpty());
    EXPECT_THAT(owned(), IsEmpty());
    world.move(stage.plane, {0.0, 0.0, 0.0});
    step();
    EXPECT_EQ(catcher_passes().size(), 3u) << "control";
}

TEST_F(ShadowCatchers, OwnTexturesOfThePicturesSize) {
    catches(true);
    step();
    EXPECT_THAT(owned(), ElementsAre("caught light", "caught light", "caught light, depth"));
    settings.viewport_px = {320, 200};
    step();
    EXPECT_THAT(owned(), ElementsAre("caught light", "caught light", "caught light, depth"));
    const gl::TextureDesc* sums = device.texture(device.target(catcher_passes()[0].begin.target)->colours[0].texture);
    EXPECT_EQ(glm::uvec2(sums->width, sums->height), settings.viewport_px);
}

TEST_F(ShadowCatchers, KeepEveryLightHoweverDim) {
    world.registry.patch<Light>(spot, [](Light& l) { l.intensity = 1e-9f; });
    settings.exposure_ev = 14.0f;
    step();
    EXPECT_EQ(light("spot").reason, Reason::below_display_step) << "control";
    catches(true);
    step();
    EXPECT_NE(light("spot").reason, Reason::below_display_step) << "a share shows at any brightness";
}

TEST_F(ShadowCatchers, CompileOneTransparentProgramWhereOneIsAskedFor) {
    step();
    settings.transparent = true;
    step();
    EXPECT_THAT(compiled_labels(device), Contains("transparent tonemap"));
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("caught"))));
}

}  // namespace
}  // namespace gnomon
