#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// LightShadow::antialias: the passes that lighting takes for it, and what these own.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class AntialiasedEdges : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        spot = world.add_light(LightKind::spot, kLightPlace_m, "spot");
        for (const ecs::Entity light : {sun, spot})
            world.registry.patch<LightShadow>(light, [](LightShadow& s) { s.filter = ShadowFilter::triangles; });
        antialias(sun, true);
    }
    void antialias(ecs::Entity light, bool on) {
        world.registry.patch<LightShadow>(light, [on](LightShadow& s) { s.antialias = on; });
    }
    std::string target_of(const Pass& pass) const { return device.target(pass.begin.target)->label; }
    std::vector<Pass> passes_of_light(const std::string& name) const {
        std::vector<Pass> of_light = passes();
        std::erase_if(of_light, [&](const Pass& pass) {
            return pass.group != name || target_of(pass).rfind("shadow map", 0) == 0;
        });
        return of_light;
    }
    std::vector<std::string> targets_of_light(const std::string& name) const {
        std::vector<std::string> targets;
        for (const Pass& pass : passes_of_light(name)) targets.push_back(target_of(pass));
        return targets;
    }
    std::vector<std::string> owned() const { return map_labels(device, "lit shares"); }

    TestWorld::Stage stage;
    ecs::Entity sun, spot;
};

TEST_F(AntialiasedEdges, TakeMiddlesThenMarksThenAreasBeforeTheLightIsRead) {
    step();
    const std::vector<Pass> all = passes_of_light("sun");
    ASSERT_THAT(targets_of_light("sun"), ElementsAre("lit shares", "lit shares, marks", "lit shares", "light sum"));
    EXPECT_TRUE(all[0].begin.clear_colour);
    EXPECT_LT(all[0].begin.colour[0], 0.0f) << "no surface yet";
    EXPECT_FALSE(all[2].begin.clear_colour) << "what is not marked keeps its middle";
    // Middles take two draws: the first ends the pixels that it decides. Marks leave the others.
    ASSERT_EQ(all[0].pipelines.size(), 2u);
    EXPECT_TRUE(all[0].pipelines[0].depth_write);
    EXPECT_FALSE(all[0].pipelines[1].depth_write);
    ASSERT_EQ(all[1].pipelines.size(), 1u);
    EXPECT_TRUE(all[1].pipelines[0].depth_write);
    ASSERT_EQ(all[2].pipelines.size(), 1u);
    EXPECT_NE(all[2].pipelines[0].program, all[0].pipelines[1].program) << "areas, no middles";
}

TEST_F(AntialiasedEdges, OfRaysTakeAllMiddlesByOneDrawOnceRaysHaveFoundThem) {
    world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.filter = ShadowFilter::exact; });
    step();
    ASSERT_THAT(targets_of_light("sun"), ElementsAre("verdicts of maps", "answers of rays", "lit shares",
                                                     "lit shares, marks", "lit shares", "light sum"));
    const std::vector<Pass> all = passes_of_light("sun");
    EXPECT_EQ(all[2].pipelines.size(), 1u);
    antialias(sun, false);
    step();
    EXPECT_THAT(targets_of_light("sun"), ElementsAre("verdicts of maps", "answers of rays", "light sum"));
}

TEST_F(AntialiasedEdges, CostLightsThatDoNotAskNoPass) {
    step();
    const std::vector<std::string> with = targets_of_light("spot");
    antialias(sun, false);
    step();
    EXPECT_EQ(targets_of_light("spot"), with);
    EXPECT_EQ(targets_of_light("sun"), with);
}

TEST_F(AntialiasedEdges, OwnTexturesOfThePicturesSizeWhileALightAsks) {
    step();
    EXPECT_THAT(owned(), ElementsAre("lit shares", "lit shares", "lit shares, depth", "lit shares, marks"));
    settings.viewport_px = {320, 200};
    step();
    EXPECT_THAT(owned(), ElementsAre("lit shares", "lit shares", "lit shares, depth", "lit shares, marks"));
    const Pass marks = passes_of_light("sun")[1];
    const gl::TextureDesc* depth = device.texture(device.target(marks.begin.target)->depth.texture);
    EXPECT_EQ(glm::uvec2(depth->width, depth->height), settings.viewport_px);
    antialias(sun, false);
    step();
    EXPECT_THAT(owned(), IsEmpty());
}

TEST_F(AntialiasedEdges, OwnNothingWhereNoLightAsks) {
    antialias(sun, false);
    for (int i = 0; i < 3; ++i) {
        world.move(stage.box, {0.1 * i, 1, 0});
        step();
        EXPECT_THAT(owned(), IsEmpty());
    }
}

/// Checks that each light starts from an empty picture: the one before left its own shares there.
TEST_F(AntialiasedEdges, OfSeveralLightsShareTheTextures) {
    antialias(spot, true);
    step();
    EXPECT_EQ(targets_of_light("spot"), targets_of_light("sun"));
    EXPECT_TRUE(passes_of_light("spot")[0].begin.clear_colour);
    EXPECT_EQ(owned().size(), 4u);
}

}  // namespace
}  // namespace gnomon
