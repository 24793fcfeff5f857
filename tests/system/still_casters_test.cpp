#include <set>

#include "tests/system/frame_fixture.h"

/// Casters that stand still have maps of their own: moving casters are drawn over a copy of these.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

/// So small that a copy is worth it for a dozen boxes, which a test can have in every view.
constexpr std::uint32_t kMap_px = 64;
constexpr std::uint32_t kSide = 100;  // boxes along a side of the field
constexpr double kSpacing_m = 2.0;

class StillCasters : public FrameTest {
protected:
    void SetUp() override { FrameTest::SetUp(); }
    void make_field(std::uint32_t side) {
        const double half_m = 0.5 * kSpacing_m * side;
        for (std::uint32_t i = 0; i < side * side; ++i)
            world.add_mesh(kBox, {kSpacing_m * (i % side) - half_m, 1, kSpacing_m * (i / side) - half_m}, true);
    }
    ecs::Entity add_lamp(LightKind kind, const glm::dvec3& at_m, const std::string& name) {
        const ecs::Entity e = world.add_light(kind, at_m, name);
        world.registry.patch<LightShadow>(e, [](LightShadow& s) { s.resolution_px = kMap_px; });
        world.registry.patch<Light>(e, [](Light& l) { l.range_m = l.kind == LightKind::directional ? 0.0f : 12.0f; });
        // Straight down: the light's own aim is at the origin.
        world.registry.patch<Transform>(e, [](Transform& t) {
            t.rotation = {0.70710678118654752, -0.70710678118654752, 0, 0};
        });
        return e;
    }
    void nudge() { world.move(mover, {0.3 + 0.001 * ++nudges, 2.6, 0.4}); }
    /// Frames in which the mover alone moves, until they are all alike.
    void warm() {
        for (int i = 0; i < 70; ++i) step();
        for (int i = 0; i < 5; ++i) nudge(), step();
    }
    std::vector<gl::Command> depth_commands() const {
        std::vector<gl::Command> found;
        bool in = false;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* group = std::get_if<gl::BeginGroup>(&c);
            if (group && group->label.text().rfind("shadow ", 0) == 0) in = true;
            if (in) found.push_back(c);
            if (std::get_if<gl::EndGroup>(&c)) in = false;
        }
        return found;
    }
    /// Counts the copies of maps and of what belongs to them.
    std::size_t copies() const {
        std::size_t n = 0;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* copy = std::get_if<gl::CopyTexture>(&c);
            n += copy && device.texture(copy->source)->label.starts_with("shadow map") ? 1 : 0;
        }
        return n;
    }
    gl::TextureHandle texture(const std::string& label) const {
        for (std::uint32_t id = 1; id < 5000; ++id)
            if (const gl::TextureDesc* desc = device.texture({id}); desc && desc->label == label) return {id};
        return {};
    }
    ecs::Entity mover;
    int nudges = 0;
};

TEST_F(StillCasters, OneMoverAmongTenThousandAndSixtyFourLightsIsDrawnOverACopyInTheViewsThatItTouchesAndNowhereElse) {
    make_field(kSide);
    mover = world.add_mesh(kBox, {0.3, 2.6, 0.4}, true);
    world.add_camera({0, 60, 60}, {0, 0, 0});
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 at_m(30.0 * (i % 8) - 105.0, 8.0, 30.0 * (i / 8) - 105.0);
        add_lamp(i % 2 == 0 ? LightKind::spot : LightKind::point, at_m, "lamp" + std::to_string(i));
    }
    add_lamp(LightKind::spot, {1, 8, 0}, "above");
    add_lamp(LightKind::point, {-1, 8, 1}, "beside");
    warm();
    nudge();
    step();
    std::set<std::string> groups;
    for (const Pass& pass : depth_passes()) groups.insert(pass.group);
    const std::vector<gl::Command> commands = depth_commands();
    constexpr std::size_t kPerView = 12;
    ASSERT_EQ(commands.size(), groups.size() * kPerView) << "one copy, one draw";
    EXPECT_GE(groups.size(), 2u);
    std::uint32_t drawn = 0;
    for (const LightReport& l : frame->report().lights) {
        const bool touched = l.name == "above" || l.name == "beside";
        EXPECT_EQ(l.counts.views_drawn > 0, touched)
            << l.name << ": the corners of the cubes around others end before the mover";
        EXPECT_EQ(l.counts.clears, 0u) << l.name;
        EXPECT_EQ(l.counts.draws, l.counts.views_drawn) << l.name;
        EXPECT_EQ(l.counts.triangles, 12u * l.counts.views_drawn) << l.name;
        drawn += l.counts.views_drawn;
    }
    EXPECT_EQ(drawn, groups.size());
    for (std::size_t at = 0; at < commands.size(); at += kPerView) {
        const std::string group(std::get<gl::BeginGroup>(commands[at]).label.text());
        const std::string name = group.substr(7, group.rfind(' ') - 7);
        const auto layer = static_cast<std::uint32_t>(std::stoul(group.substr(group.rfind(' ') + 1)));
        const gl::TextureHandle map = texture("shadow map " + name);
        EXPECT_EQ(commands[at + 2],
                  gl::Command(gl::CopyTexture{texture("shadow map " + name + ", still"), map, layer}));
        const auto& pass = std::get<gl::BeginPass>(commands[at + 3]);
        EXPECT_EQ(device.target(pass.target)->depth, (gl::Attachment{map, static_cast<std::int32_t>(layer)}));
        EXPECT_FALSE(pass.clear_depth);
        EXPECT_TRUE(std::holds_alternative<gl::SetPipeline>(commands[at + 7]));
        const auto& draw = std::get<gl::DrawMeshes>(commands[at + 8]);
        EXPECT_EQ(draw.item_count, 1u);
    }
    for (const Pass& pass : depth_passes()) EXPECT_THAT(drawn_slots(pass), ElementsAre(slot_of(mover)));
}

class OneSpot : public StillCasters, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    void SetUp() override {
        StillCasters::SetUp();
        make_field(8);
        mover = world.add_mesh(kBox, {0.3, 2.6, 0.4}, true);
        world.add_mesh(kPlane, {0, 0, 0}, false);
        world.add_camera({0, 12, 12}, {0, 0, 0});
        lamp = add_lamp(LightKind::spot, {1, 8, 0}, "lamp");
        world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = GetParam(); });
        world.look_lights_up();
    }
    ecs::Entity lamp;
};

INSTANTIATE_TEST_SUITE_P(Filters, OneSpot,
                         ::testing::Values(ShadowFilter::hardware_2x2, ShadowFilter::triangles, ShadowFilter::vsm),
                         [](const auto& test) {
                             return test.param == ShadowFilter::vsm         ? "moments"
                                    : test.param == ShadowFilter::triangles ? "triangles"
                                                                            : "depth";
                         });

TEST_P(OneSpot, GetsASecondStoreWhenItsMoverMovesAgainAndLosesItASecondAfterItRests) {
    for (int i = 0; i < 70; ++i) step();
    const std::uint64_t alone = light("lamp").counts.bytes;
    EXPECT_FALSE(texture("shadow map lamp, still"));
    nudge(), step();
    EXPECT_EQ(copies(), 0u) << "it may move but once";
    EXPECT_EQ(light("lamp").counts.bytes, alone);
    nudge(), step();
    const std::size_t textures = GetParam() == ShadowFilter::triangles ? 2 : 1;
    EXPECT_EQ(copies(), textures) << "what was drawn is kept";
    EXPECT_EQ(light("lamp").counts.clears, 1u);
    EXPECT_EQ(light("lamp").counts.views_drawn, 1u);
    const std::uint64_t texel = GetParam() == ShadowFilter::triangles ? 8 : 4;
    EXPECT_EQ(light("lamp").counts.bytes, alone + texel * kMap_px * kMap_px);
    nudge(), step();
    EXPECT_EQ(copies(), textures);
    EXPECT_EQ(light("lamp").counts.clears, 0u);
    EXPECT_EQ(light("lamp").counts.triangles, 12u);
    std::uint32_t drawn = 0;
    for (std::uint64_t i = 0; i <= shadow::MapCache::kHoldFrames; ++i)
        step(), drawn += light("lamp").counts.views_drawn;
    EXPECT_EQ(drawn, 1u) << "once more, when it counts as still";
    EXPECT_FALSE(texture("shadow map lamp, still"));
    EXPECT_EQ(light("lamp").counts.bytes, alone);
}

TEST_P(OneSpot, DrawsAllWhereTheDeviceHasNoRoomAndSaysNothingOfIt) {
    for (int i = 0; i < 70; ++i) step();
    const std::size_t textures = GetParam() == ShadowFilter::triangles ? 2 : 1;
    nudge(), step();
    for (std::size_t failing = 0; failing < textures; ++failing) {
        device.fail_label(failing == 0 ? ", still" : "still triangles", gl::Failure::out_of_memory);
        nudge(), step();
        EXPECT_EQ(copies(), 0u);
        EXPECT_EQ(light("lamp").counts.clears, 1u);
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        EXPECT_STREQ(reason_code(light("lamp").reason), "none");
        EXPECT_FALSE(texture("shadow map lamp, still"));
        for (std::uint64_t i = 0; i < shadow::MapCache::kRetryFrames - 1; ++i) {
            nudge(), step();
            EXPECT_EQ(copies(), 0u);
        }
    }
    device.stop_failing();
    nudge(), step();
    EXPECT_EQ(copies(), textures) << "and it is tried again";
}

TEST_P(OneSpot, KeepsNothingApartWhereAllIsDrawnAnyway) {
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    for (int i = 0; i < 40; ++i) {
        nudge(), step();
        ASSERT_EQ(copies(), 0u);
    }
    EXPECT_EQ(light("lamp").counts.clears, 1u);
    EXPECT_FALSE(texture("shadow map lamp, still"));
}

TEST_P(OneSpot, KeepsNothingApartWhereDrawingIsLessThanCopying) {
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = 2048; });
    for (int i = 0; i < 70; ++i) step();
    for (int i = 0; i < 10; ++i) {
        nudge(), step();
        ASSERT_EQ(copies(), 0u);
    }
}

TEST_P(OneSpot, DrawsThoseThatMoveAfterTheOthersWithAndWithoutEconomy) {
    for (int i = 0; i < 70; ++i) step();
    for (const bool economy : {true, false}) {
        edit_light(world.registry, lamp, [economy](ShadowTuning& t) { t.reuse.economy = economy; });
        step();
        nudge(), step();
        ASSERT_THAT(depth_passes(), SizeIs(1));
        EXPECT_EQ(drawn_slots(depth_passes()[0]).back(), slot_of(mover));
        EXPECT_GT(drawn_slots(depth_passes()[0]).size(), 10u);
        EXPECT_EQ(depth_passes()[0].draws.back().item_count, 1u) << "never in one draw with what stands still";
        for (int i = 0; i < 100; ++i) step();
    }
}

}  // namespace
}  // namespace gnomon
