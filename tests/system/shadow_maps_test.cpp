#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// Which maps exist, and since when and until when.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ShadowMaps : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    /// Returns the map of the light of that name, as the device holds it. Fails if there is not exactly one.
    gl::TextureDesc map_of(const std::string& name) const {
        const gl::TextureDesc* found = nullptr;
        for (std::uint32_t id = 1; id < 1000; ++id) {
            const gl::TextureDesc* desc = device.texture({id});
            if (!desc || desc->label != "shadow map " + name) continue;
            EXPECT_EQ(found, nullptr) << "more than one";
            found = desc;
        }
        EXPECT_NE(found, nullptr) << "none of " << name;
        return found ? *found : gl::TextureDesc{};
    }
    /// Expects that nothing of any shadow is left on the device, and that nothing is drawn for one.
    void expect_no_shadow(Reason why) {
        EXPECT_THAT(map_labels(device), IsEmpty());
        EXPECT_THAT(depth_passes(), IsEmpty());
        EXPECT_EQ(light("lamp").state, LightState::skipped);
        EXPECT_STREQ(reason_code(light("lamp").reason), reason_code(why));
        EXPECT_EQ(light("lamp").counts.bytes, 0u);
        EXPECT_EQ(light("lamp").counts.views, 0u);
        EXPECT_EQ(light("lamp").counts.draws, 0u);
        EXPECT_EQ(light("lamp").counts.clears, 0u);
    }
    TestWorld::Stage stage;
};

TEST_F(ShadowMaps, ASpotGetsOneMapOfOneLayer) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    const gl::TextureDesc map = map_of("lamp");
    EXPECT_EQ(map.kind, gl::TextureKind::array);
    EXPECT_EQ(map.layers, 1u);
    EXPECT_EQ(map.format, gl::Format::d32f);
    EXPECT_THAT(map_labels(device), SizeIs(2));  // the texture and its one target
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_EQ(light("lamp").counts.texels, std::uint64_t{map.width} * map.height);
    EXPECT_EQ(light("lamp").counts.bytes, gl::byte_size(map));
    EXPECT_THAT(depth_passes(), SizeIs(1));
}

TEST_F(ShadowMaps, ADepthFormatIsTheLightsOwnAndChangesWithIt) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    std::uint64_t bytes_d32f = 0;
    for (const auto& row :
         {std::pair{DepthFormat::d32f, gl::Format::d32f}, std::pair{DepthFormat::d16, gl::Format::d16},
          std::pair{DepthFormat::d24, gl::Format::d24}}) {
        const DepthFormat wish = row.first;
        edit_light(world.registry, lamp, [&](ShadowTuning& t) { t.maps.depth_format = wish; });
        step();
        EXPECT_EQ(map_of("lamp").format, row.second);
        EXPECT_THAT(map_labels(device), SizeIs(2)) << "the map of another format is left";
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        if (wish == DepthFormat::d32f) bytes_d32f = light("lamp").counts.bytes;
        if (wish == DepthFormat::d16) {
            EXPECT_EQ(light("lamp").counts.bytes * 2, bytes_d32f);
        }
        step();
        EXPECT_EQ(light("lamp").state, LightState::reused);
    }
}

TEST_F(ShadowMaps, APointGetsOneCube) {
    world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    const gl::TextureDesc map = map_of("lamp");
    EXPECT_EQ(map.kind, gl::TextureKind::cube);
    EXPECT_THAT(map_labels(device), SizeIs(1 + 6));
    EXPECT_EQ(light("lamp").counts.texels, 6 * std::uint64_t{map.width} * map.height);
    EXPECT_EQ(light("lamp").counts.views, 4u) << "nothing is seen overhead nor on the camera's side";
}

TEST_F(ShadowMaps, ASunGetsOneArrayOfAsManyLayersAsItsCascades) {
    const ecs::Entity lamp = world.add_light(LightKind::directional, kLightPlace_m, "lamp");
    step();
    const gl::TextureDesc one = map_of("lamp");
    EXPECT_EQ(one.kind, gl::TextureKind::array);
    EXPECT_EQ(one.layers, 1u) << "the stage is small";
    EXPECT_THAT(map_labels(device), SizeIs(1 + 1));
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.cascades = 4; });
    step();
    const gl::TextureDesc four = map_of("lamp");
    EXPECT_EQ(four.layers, 4u);
    EXPECT_EQ(four.width, one.width);
    EXPECT_THAT(map_labels(device), SizeIs(1 + 4));
    EXPECT_LE(light("lamp").counts.views, 4u);
    EXPECT_GE(light("lamp").counts.views, 1u);
}

TEST_F(ShadowMaps, ALightWithoutShadowCostsNothing) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp", false);
    step();
    expect_no_shadow(Reason::no_light_shadow);
    for (const std::string& label : device.live_labels()) EXPECT_EQ(label.find("shadow"), std::string::npos) << label;
    for (const std::string& label : device.live_labels())
        EXPECT_EQ(label.find("depth opaque"), std::string::npos) << label;
}

TEST_F(ShadowMaps, RemovingTheShadowFreesTheMapAndItsTargets) {
    const ecs::Entity lamp = world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(map_labels(device), SizeIs(7));
    world.registry.remove<LightShadow>(lamp);
    step();
    expect_no_shadow(Reason::no_light_shadow);
    world.registry.emplace<LightShadow>(lamp, {.filter = ShadowFilter::hardware_2x2});
    step();
    EXPECT_THAT(map_labels(device), SizeIs(7)) << "and adding it again brings it back";
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

TEST_F(ShadowMaps, DestroyingTheLightFreesTheMap) {
    const ecs::Entity lamp = world.add_light(LightKind::directional, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(map_labels(device), SizeIs(1 + 1));
    world.registry.destroy(lamp);
    step();
    EXPECT_THAT(map_labels(device), IsEmpty());
    EXPECT_THAT(frame->report().lights, IsEmpty());
}

TEST_F(ShadowMaps, DisablingTheShadowFreesTheMap) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(map_labels(device), SizeIs(2));
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.enabled = false; });
    step();
    expect_no_shadow(Reason::shadows_off);
}

TEST_F(ShadowMaps, SwitchingAllShadowsOffFreesEveryMap) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(map_labels(device), SizeIs(2));
    settings.shadows = false;
    step();
    expect_no_shadow(Reason::shadows_off);
}

TEST_F(ShadowMaps, ADarkLightGetsNone) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 0.0f; });
    step();
    expect_no_shadow(Reason::light_off);
    world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 1.0f, l.colour = glm::vec3(0.0f); });
    step();
    expect_no_shadow(Reason::light_off);
}

TEST_F(ShadowMaps, WithoutCastersThereIsNone) {
    world.registry.remove<ShadowCaster>(stage.box);
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    expect_no_shadow(Reason::no_caster);
}

TEST_F(ShadowMaps, WithoutAVisibleReceiverThereIsNone) {
    world.registry.remove<Camera>(stage.camera);
    world.add_camera({0, 4, 8}, {0, 8, 16});  // looks away
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    expect_no_shadow(Reason::no_visible_receiver);
}

TEST_F(ShadowMaps, WhatReceivesNoShadowIsNoReceiver) {
    for (const ecs::Entity e : {stage.plane, stage.box})
        world.registry.patch<MeshRef>(e, [](MeshRef& m) { m.receives_shadow = false; });
    world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    expect_no_shadow(Reason::no_visible_receiver);
}

TEST_F(ShadowMaps, OutOfTheLightsRangeThereIsNone) {
    const ecs::Entity lamp = world.add_light(LightKind::point, {0, 50, 0}, "lamp");
    step();
    expect_no_shadow(Reason::no_visible_receiver);
    world.registry.patch<Light>(lamp, [](Light& l) { l.range_m = 100.0f; });
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

TEST_F(ShadowMaps, AMapThatNobodySeesIsHeldForAWhileThenFreed) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    world.registry.patch<Transform>(stage.camera, [](Transform& t) { t.translation_m.z = -1000.0; });
    for (std::uint64_t i = 0; i < shadow::MapCache::kHoldFrames; ++i) step();
    EXPECT_THAT(map_labels(device), SizeIs(2)) << "one second on";
    step();
    expect_no_shadow(Reason::no_visible_receiver);
    world.move(stage.camera, {0, 4, 8});
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

TEST_F(ShadowMaps, ALightThatBecomesOfAnotherKindGetsAMapOfThatKind) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    const auto become = [&](LightKind kind) {
        world.registry.patch<Light>(lamp, [kind](Light& l) { l.kind = kind; });
        step();
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        return map_of("lamp");
    };
    step();
    EXPECT_EQ(become(LightKind::directional).kind, gl::TextureKind::array);
    EXPECT_EQ(become(LightKind::point).kind, gl::TextureKind::cube);
    EXPECT_EQ(become(LightKind::spot).layers, 1u);
    EXPECT_EQ(become(LightKind::directional).kind, gl::TextureKind::array);
}

TEST_F(ShadowMaps, TheRequestedResolutionIsTheMaps) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    for (const std::uint32_t size : {512u, 300u}) {
        world.registry.patch<LightShadow>(lamp, [size](LightShadow& s) { s.resolution_px = size; });
        step();
        EXPECT_EQ(map_of("lamp").width, size);
        EXPECT_EQ(map_of("lamp").height, size);
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        EXPECT_EQ(light("lamp").reason, Reason::none);
    }
}

TEST_F(ShadowMaps, AResolutionBeyondTheDeviceIsClampedAndReported) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    const ecs::Entity bulb = world.add_light(LightKind::point, kLightPlace_m, "bulb");
    for (const ecs::Entity e : {lamp, bulb})
        world.registry.patch<LightShadow>(e, [](LightShadow& s) { s.resolution_px = 1u << 20; });
    step();
    EXPECT_EQ(map_of("lamp").width, device.info().max_texture_px);
    EXPECT_EQ(map_of("bulb").width, device.info().max_cube_px);
    for (const char* name : {"lamp", "bulb"}) {
        EXPECT_EQ(light(name).state, LightState::degraded);
        EXPECT_STREQ(reason_code(light(name).reason), "resolution_clamped");
    }
}

TEST_F(ShadowMaps, AWideConeIsServedByFacesAroundIt) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.registry.patch<Light>(lamp, [](Light& l) { l.outer_cone_rad = 1.55f; });
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_EQ(map_of("lamp").layers, 5u);
    EXPECT_GE(light("lamp").counts.views, 1u);
    EXPECT_THAT(depth_passes(), SizeIs(light("lamp").counts.views));
}

TEST_F(ShadowMaps, AConeThatOpensFadesFromOneMapToFacesAndKeepsNoneTooMany) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_EQ(map_of("lamp").layers, 1u);
    world.registry.patch<Light>(lamp, [](Light& l) { l.outer_cone_rad = 1.2f; });
    for (int i = 0; i < 7; ++i) {
        step();
        EXPECT_EQ(map_of("lamp").layers, 6u);
    }
    step();
    EXPECT_EQ(map_of("lamp").layers, 5u);
}

TEST_F(ShadowMaps, SeveralLightsOfMixedKindsEachHaveTheirOwn) {
    world.add_light(LightKind::directional, kLightPlace_m, "sun");
    world.add_light(LightKind::spot, {2, 5, 2}, "spot");
    world.add_light(LightKind::point, {-2, 3, 0}, "point");
    world.add_light(LightKind::spot, {-2, 5, 2}, "other spot");
    world.add_light(LightKind::point, {1, 3, 0}, "plain point", false);
    step();
    EXPECT_EQ(map_of("sun").layers, 1u);
    EXPECT_EQ(map_of("spot").kind, gl::TextureKind::array);
    EXPECT_EQ(map_of("point").kind, gl::TextureKind::cube);
    EXPECT_EQ(map_of("other spot").kind, gl::TextureKind::array);
    EXPECT_THAT(map_labels(device), SizeIs((1 + 1) + (1 + 1) + (1 + 6) + (1 + 1)));
    EXPECT_EQ(light("plain point").reason, Reason::no_light_shadow);
    std::uint64_t bytes = 0;
    for (const LightReport& l : frame->report().lights) bytes += l.counts.bytes;
    std::uint64_t held = 0;
    for (const char* name : {"sun", "spot", "point", "other spot"}) held += gl::byte_size(map_of(name));
    EXPECT_EQ(bytes, held);
}

TEST_F(ShadowMaps, RepeatedNamesAreMadeUnique) {
    for (int i = 0; i < 3; ++i) world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.add_light(LightKind::spot, kLightPlace_m, "lamp.1");
    step();
    std::vector<std::string> names;
    for (const LightReport& l : frame->report().lights) names.push_back(l.name);
    EXPECT_THAT(names, ElementsAre("lamp", "lamp.1", "lamp.2", "lamp.1.1"));
}

}  // namespace
}  // namespace gnomon
