#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// Casters and receivers of each light, by layers: exact lists, and what a change at run time draws again.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class ShadowLayersTest : public FrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    static constexpr ShadowLayers kFirst = 0x01, kSecond = 0x02;

    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        other = world.add_mesh(kBox, {1.5, 1, 0.5}, true);
        lamp = world.add_light(GetParam(), kLightPlace_m, "lamp");
    }
    void set_light(ShadowLayers layers) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.layers = layers; });
    }
    void set_caster(ecs::Entity e, ShadowLayers layers) {
        world.registry.patch<ShadowCaster>(e, [&](ShadowCaster& c) { c.layers = layers; });
    }
    void set_receiver(ecs::Entity e, ShadowLayers layers) {
        world.registry.patch<MeshRef>(e, [&](MeshRef& m) { m.shadow_layers = layers; });
    }
    /// Slots that any depth pass drew in this frame, each once.
    std::vector<std::uint32_t> drawn() const {
        std::vector<std::uint32_t> slots;
        for (const Pass& pass : depth_passes())
            for (const std::uint32_t slot : drawn_slots(pass)) slots.push_back(slot);
        std::sort(slots.begin(), slots.end());
        slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
        return slots;
    }
    TestWorld::Stage stage;
    ecs::Entity other, lamp;
};

INSTANTIATE_TEST_SUITE_P(Kinds, ShadowLayersTest,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

TEST_P(ShadowLayersTest, EveryCasterIsInTheListsOfALightOfAllLayers) {
    step();
    EXPECT_THAT(drawn(), UnorderedElementsAre(slot_of(stage.box), slot_of(other)));
}

TEST_P(ShadowLayersTest, ACasterOfOtherLayersIsInNoViewsList) {
    set_light(kFirst);
    set_caster(stage.box, kFirst);
    set_caster(other, kSecond);
    step();
    EXPECT_THAT(drawn(), ElementsAre(slot_of(stage.box)));
    EXPECT_EQ(light("lamp").reason, Reason::none);
}

TEST_P(ShadowLayersTest, ALightWithoutAnyCasterOfItsLayersHasNoMap) {
    set_light(kFirst);
    set_caster(stage.box, kSecond);
    set_caster(other, kSecond);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("lamp").reason, Reason::no_caster);
    EXPECT_EQ(light("lamp").counts.bytes, 0u);
}

TEST_P(ShadowLayersTest, ALightWithoutAnyReceiverOfItsLayersHasNoMap) {
    set_light(kFirst);
    for (const ecs::Entity e : {stage.plane, stage.box, other}) set_receiver(e, kSecond);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("lamp").reason, Reason::no_visible_receiver);
}

TEST_P(ShadowLayersTest, EachLightHasItsOwnCasters) {
    world.registry.destroy(lamp);
    lamp = world.add_light(GetParam(), kLightPlace_m, "first");
    set_light(kFirst);
    lamp = world.add_light(GetParam(), kLightPlace_m + glm::dvec3(0.5, 0, 0), "second");
    set_light(kSecond);
    set_caster(stage.box, kFirst);
    set_caster(other, kSecond);
    step();
    ASSERT_FALSE(depth_passes().empty());
    for (const Pass& pass : depth_passes()) {
        const bool first = pass.group.rfind("shadow first", 0) == 0;
        for (const std::uint32_t slot : drawn_slots(pass)) EXPECT_EQ(slot, slot_of(first ? stage.box : other));
    }
}

TEST_P(ShadowLayersTest, ACasterThatKeepsALayerOfTheLightRedrawsNothing) {
    set_light(kFirst);
    step();
    step();
    ASSERT_THAT(depth_passes(), IsEmpty());
    set_caster(stage.box, kFirst);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("lamp").state, LightState::reused);
}

TEST_P(ShadowLayersTest, ACasterThatLeavesTheLightsLayersIsGoneInTheSameFrame) {
    set_light(kFirst);
    step();
    step();
    set_caster(other, kSecond);
    step();
    EXPECT_THAT(drawn(), ElementsAre(slot_of(stage.box)));
    set_caster(other, kFirst);
    step();
    EXPECT_THAT(drawn(), UnorderedElementsAre(slot_of(stage.box), slot_of(other)));
}

TEST_P(ShadowLayersTest, ALightThatLeavesALayerButKeepsItsCastersAndReceiversRedrawsNothing) {
    step();
    step();
    set_light(kFirst);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("lamp").state, LightState::reused);
}

TEST_P(ShadowLayersTest, AnInvisibleCasterCastsOnly) {
    world.registry.patch<MeshRef>(other, [](MeshRef& m) { m.visible = false; });
    step();
    EXPECT_THAT(drawn(), UnorderedElementsAre(slot_of(stage.box), slot_of(other)));
    for (const Pass& pass : passes()) {
        std::uint32_t seen = 0;
        for (const gl::DrawMeshes& draw : pass.draws) seen += draw.item_count;
        if (pass.group == "surfaces") {
            EXPECT_EQ(seen, 2u) << "the plane and one box";
        }
    }
}

}  // namespace
}  // namespace gnomon
