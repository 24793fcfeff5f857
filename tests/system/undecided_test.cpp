#include "gnomon/light.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"

/// A light with a filter that takes long at edges is drawn twice: what the first draw decides, and the rest.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class Undecided : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        world.add_stage();
        lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        choose(ShadowFilter::triangles);
        // A still light reads what its pixels saw, and is not looked up.
        edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.keep_visibility = false; });
    }
    void choose(ShadowFilter filter) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = filter; });
    }
    /// Returns the lamp's passes over the picture.
    std::vector<Pass> lamp_passes() const {
        std::vector<Pass> found = passes();
        std::erase_if(found, [](const Pass& p) { return p.group != "lamp"; });
        return found;
    }
    std::string target_of(const Pass& pass) const { return device.target(pass.begin.target)->label; }
    /// Returns the areas in which the surfaces' depth is copied.
    std::vector<gl::Rect> copied_areas() const {
        std::vector<gl::Rect> areas;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* copy = std::get_if<gl::CopyTexture>(&c);
            if (!copy || device.texture(copy->destination)->label != "undecided depth") continue;
            EXPECT_EQ(device.texture(copy->source)->label, "surface depth");
            areas.push_back(copy->area);
        }
        return areas;
    }
    void expect_one_draw() {
        ASSERT_THAT(lamp_passes(), SizeIs(1));
        EXPECT_EQ(target_of(lamp_passes()[0]), "light sum");
        EXPECT_THAT(lamp_passes()[0].pipelines, SizeIs(1));
        EXPECT_THAT(copied_areas(), IsEmpty());
    }
    ecs::Entity lamp;
};

TEST_F(Undecided, PixelsAreThoseWhoseDepthTheFirstDrawDoesNotTake) {
    step();
    ASSERT_THAT(lamp_passes(), SizeIs(1));
    const Pass pass = lamp_passes()[0];
    EXPECT_EQ(target_of(pass), "undecided light");
    const gl::TargetDesc& target = *device.target(pass.begin.target);
    EXPECT_EQ(device.texture(target.colours.at(0).texture)->label, "light sum");
    EXPECT_EQ(device.texture(target.depth.texture)->label, "undecided depth");
    EXPECT_FALSE(pass.begin.clear_depth);
    ASSERT_THAT(pass.pipelines, SizeIs(2));
    const gl::PipelineState &first = pass.pipelines[0], &second = pass.pipelines[1];
    EXPECT_NE(first.program, second.program);
    // Surfaces lie above the draws' depth. Where the first one has put its own, the second one is not above it.
    for (const gl::PipelineState& draw : {first, second}) EXPECT_EQ(draw.depth_test, gl::DepthTest::less);
    EXPECT_TRUE(first.depth_write);
    EXPECT_FALSE(second.depth_write);
    EXPECT_THAT(copied_areas(), SizeIs(1));
    std::vector<std::optional<float>> depths;
    std::vector<gl::Rect> scissors;
    bool inside = false;
    for (const gl::Command& c : frame->commands().commands) {
        if (const auto* group = std::get_if<gl::BeginGroup>(&c)) inside = group->label == "lamp";
        if (std::get_if<gl::EndGroup>(&c)) inside = false;
        if (const auto* draw = std::get_if<gl::DrawTriangle>(&c); draw && inside) depths.push_back(draw->depth);
        if (const auto* scissor = std::get_if<gl::SetScissor>(&c); scissor && inside) scissors.push_back(scissor->rect);
    }
    EXPECT_EQ(copied_areas(), scissors) << "of as much of the picture as is drawn";
    ASSERT_THAT(depths, SizeIs(2));
    EXPECT_EQ(depths[0], depths[1]);
}

TEST_F(Undecided, LightsEachBeginWithAllSurfaces) {
    for (const ecs::Entity light : {world.add_light(LightKind::point, kLightPlace_m, "bulb"),
                                    world.add_light(LightKind::directional, kLightPlace_m, "sun")}) {
        edit_light(world.registry, light, [](LightShadow& s) { s.filter = ShadowFilter::triangles; });
        edit_light(world.registry, light, [](ShadowTuning& t) { t.reuse.keep_visibility = false; });
    }
    constexpr int kPrograms = 6;  // frames may make but one each
    for (int i = 0; i < kPrograms; ++i) step();
    std::size_t two = 0;
    for (const Pass& p : passes()) two += p.pipelines.size() == 2 && target_of(p) == "undecided light" ? 1 : 0;
    EXPECT_EQ(two, 3u);
    EXPECT_THAT(copied_areas(), SizeIs(two));
}

TEST_F(Undecided, AreLeftOutByEveryFilterOfTriangles) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        if (!row.storage.triangle_ids) continue;
        choose(row.id);
        for (int i = 0; i < 3; ++i) step();  // frames may make but one program each
        ASSERT_THAT(lamp_passes(), SizeIs(1)) << row.name;
        EXPECT_THAT(lamp_passes()[0].pipelines, SizeIs(2)) << row.name;
    }
}

TEST_F(Undecided, NoOtherFilterPaysForThem) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        if (row.storage.triangle_ids) continue;
        choose(row.id);
        step();
        EXPECT_THAT(map_labels(device, "undecided"), IsEmpty()) << row.name;
        EXPECT_THAT(copied_areas(), IsEmpty()) << row.name;
    }
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("decided"))));
}

TEST_F(Undecided, TheirDepthGoesWithTheLastLightThatLeavesAny) {
    step();
    EXPECT_THAT(map_labels(device, "undecided"), SizeIs(2)) << "a texture and a target";
    choose(ShadowFilter::hard);
    step();
    EXPECT_THAT(map_labels(device, "undecided"), IsEmpty());
    expect_one_draw();
}

TEST_F(Undecided, WithoutRoomForThemOneDrawDoesAllAndNothingIsLost) {
    device.fail_label("undecided depth", gl::Failure::out_of_memory);
    step();
    expect_one_draw();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    device.stop_failing();
    world.move(lamp, kLightPlace_m + glm::dvec3(0.1, 0.0, 0.0));
    step();
    EXPECT_THAT(copied_areas(), SizeIs(1));
}

TEST_F(Undecided, WithoutTheProgramOfTheFirstDrawOneDoesAll) {
    device.fail_label("decided light LIGHT", gl::Failure::compile_failed);
    step();
    expect_one_draw();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

}  // namespace
}  // namespace gnomon
