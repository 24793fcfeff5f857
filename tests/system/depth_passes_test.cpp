#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// What is drawn into depth maps, when, and in which order.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

class DepthPasses : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    std::vector<std::string> groups() const {
        std::vector<std::string> names;
        for (const Pass& p : passes()) names.push_back(p.group);
        return names;
    }
    /// Groups of the depth passes alone.
    std::vector<std::string> drawn() const {
        std::vector<std::string> names;
        for (const Pass& p : depth_passes()) names.push_back(p.group);
        return names;
    }
    TestWorld::Stage stage;
};

TEST_F(DepthPasses, ComeBeforeSurfacesThenLightsThenExposure) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.add_light(LightKind::spot, {-3, 6, 1}, "lantern");
    step();
    EXPECT_THAT(groups(), ElementsAre("shadow lamp 0", "shadow lantern 0", "surfaces", "lamp", "lantern", "exposure", "exposure"));
}

TEST_F(DepthPasses, EachClearsItsMapToNothingBeforeTheLight) {
    world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(depth_passes(), SizeIs(4));
    for (const Pass& pass : depth_passes()) {
        EXPECT_TRUE(pass.begin.clear_depth);
        EXPECT_EQ(pass.begin.depth, 0.0f);  // reversed: nothing is farther
        for (const gl::PipelineState& state : pass.pipelines) {
            EXPECT_EQ(state.depth_test, gl::DepthTest::greater);
            EXPECT_TRUE(state.depth_write && state.depth_clamp);
        }
    }
}

TEST_F(DepthPasses, EachViewOfEveryLightIsDrawnOnce) {
    world.add_light(LightKind::directional, kLightPlace_m, "sun");
    world.add_light(LightKind::spot, kLightPlace_m, "spot");
    world.add_light(LightKind::point, kLightPlace_m, "point");
    step();
    std::vector<std::uint32_t> targets;
    for (const Pass& pass : depth_passes()) targets.push_back(pass.begin.target.id);
    std::sort(targets.begin(), targets.end());
    EXPECT_EQ(std::adjacent_find(targets.begin(), targets.end()), targets.end());
    std::uint32_t views = 0, views_drawn = 0, clears = 0;
    for (const LightReport& l : frame->report().lights) views += l.counts.views, views_drawn += l.counts.views_drawn, clears += l.counts.clears;
    EXPECT_EQ(views, targets.size());
    EXPECT_EQ(views_drawn, targets.size());
    EXPECT_EQ(clears, targets.size());
}

TEST_F(DepthPasses, OnlyCastersAreDrawn) {
    const ecs::Entity disabled = world.add_mesh(kBox, {1, 1, 0}, true);
    world.registry.patch<ShadowCaster>(disabled, [](ShadowCaster& c) { c.enabled = false; });
    const ecs::Entity second = world.add_mesh(kBox, {-1, 1, 0}, true);
    world.add_mesh(kBox, {0, 1, 1}, false);
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(depth_passes(), SizeIs(1));
    EXPECT_THAT(drawn_slots(depth_passes()[0]), UnorderedElementsAre(slot_of(stage.box), slot_of(second)));
    EXPECT_EQ(light("lamp").counts.triangles, 2u * 12u);
    EXPECT_EQ(light("lamp").counts.draws, 1u) << "equal meshes are one draw";
}

TEST_F(DepthPasses, TakingTheCasterAwayIsNoticed) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(drawn_slots(depth_passes().at(0)), ElementsAre(slot_of(stage.box)));
    world.registry.destroy(stage.box);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("lamp").reason, Reason::no_caster);
}

TEST_F(DepthPasses, AnInvisibleCasterStillCasts) {
    world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.visible = false; });
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(drawn_slots(depth_passes().at(0)), ElementsAre(slot_of(stage.box)));
}

TEST_F(DepthPasses, ACasterThatTheCameraDoesNotSeeStillCasts) {
    const ecs::Entity above = world.add_mesh(kBox, {1.5, 3, 0.5}, true);
    world.registry.patch<Camera>(stage.camera, [](Camera& c) { c.fov_y_rad = 0.3; });
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(drawn_slots(depth_passes().at(0)), Contains(slot_of(above)));
}

TEST_F(DepthPasses, BlendedSurfacesLetLightThrough) {
    const ecs::Entity glass = world.add_mesh(kBlendedBox, {1, 1, 0}, true), untinted = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    edit_light(world.registry, untinted, [](LightShadow& s) { s.translucent_casters = false; });
    world.add_light(LightKind::spot, kLightPlace_m, "tinted");
    step();
    EXPECT_THAT(drawn_slots(depth_passes().at(0)), Not(Contains(slot_of(glass))));
    EXPECT_EQ(light("lamp").counts.triangles, 12u);
    EXPECT_EQ(light("tinted").counts.triangles, 12u + 5u * 12u) << "four layers and their sums";
}

TEST_F(DepthPasses, AStillSceneRedrawsNothing) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        world.add_light(kind, kLightPlace_m, kind == LightKind::spot ? "spot" : kind == LightKind::point ? "point" : "sun");
    step();
    for (int i = 0; i < 3; ++i) {
        step();
        EXPECT_THAT(drawn(), IsEmpty());
        for (const LightReport& l : frame->report().lights) {
            EXPECT_EQ(l.state, LightState::reused) << l.name;
            EXPECT_STREQ(reason_code(l.reason), "content_unchanged");
            EXPECT_GT(l.counts.views, 0u);
            EXPECT_EQ(l.counts.views_drawn + l.counts.draws + l.counts.clears, 0u);
        }
    }
}

TEST_F(DepthPasses, WithoutEconomyEveryViewIsRedrawn) {
    const ecs::Entity lamp = world.add_light(LightKind::point, kLightPlace_m, "lamp");
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    step();
    const gl::CommandList first = frame->commands();
    step();
    ASSERT_THAT(depth_passes(), SizeIs(4));
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_EQ(depth_passes_of(first, device).size(), depth_passes().size());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(depth_passes_of(first, device)[i].draws, depth_passes()[i].draws);
}

TEST_F(DepthPasses, ALayeredCubeIsOnePassOnFacesThatAreClearedOneByOne) {
    const ecs::Entity lamp = world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    const std::uint64_t triangles = light("lamp").counts.triangles;
    const std::uint32_t draws = light("lamp").counts.draws;
    for (const CubeRoute route : {CubeRoute::layered_geometry, CubeRoute::six_passes}) {
        edit_light(world.registry, lamp, [&](ShadowTuning& t) {
            t.maps.cube_route = route;
            t.reuse.economy = false;
        });
        step();
        const bool layered = route == CubeRoute::layered_geometry;
        EXPECT_EQ(light("lamp").counts.views_drawn, 4u);
        EXPECT_EQ(light("lamp").counts.clears, 4u);
        EXPECT_EQ(light("lamp").counts.triangles, triangles);
        EXPECT_LE(light("lamp").counts.draws, draws) << "one draw per mesh serves every face";
        const std::vector<Pass> passes = depth_passes();
        EXPECT_THAT(passes, SizeIs(layered ? 4 + 1 : 4)) << "a layered clear would wipe the other faces";
        EXPECT_EQ(std::count_if(passes.begin(), passes.end(), [](const Pass& p) { return p.begin.clear_depth; }), 4);
    }
    EXPECT_THAT(device.findings(), IsEmpty());
}

TEST_F(DepthPasses, WithoutVertexLayersThatRouteIsSixPasses) {
    ASSERT_FALSE(device.info().vertex_layer);
    const ecs::Entity lamp = world.add_light(LightKind::point, kLightPlace_m, "lamp");
    edit_light(world.registry, lamp, [&](ShadowTuning& t) { t.maps.cube_route = CubeRoute::layered_vertex; });
    step();
    EXPECT_THAT(depth_passes(), SizeIs(4));
}

TEST_F(DepthPasses, ALayeredProgramThatDoesNotCompileCostsNothingButThePasses) {
    device.fail_label("layer by geometry", gl::Failure::compile_failed);
    const ecs::Entity lamp = world.add_light(LightKind::point, kLightPlace_m, "lamp");
    edit_light(world.registry, lamp, [&](ShadowTuning& t) { t.maps.cube_route = CubeRoute::layered_geometry; });
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_THAT(depth_passes(), SizeIs(4));
}

TEST_F(DepthPasses, AMovedCasterRedrawsOnlyItsOwnLights) {
    const ecs::Entity far_box = world.add_mesh(kBox, {-6, 1, -4}, true);
    const ecs::Entity near_lamp = world.add_light(LightKind::spot, {1, 4, 0}, "near");
    const ecs::Entity far_lamp = world.add_light(LightKind::point, {-6, 3, -4}, "far");
    world.registry.patch<Light>(near_lamp, [](Light& l) { l.outer_cone_rad = 0.4f; });
    world.registry.patch<Light>(far_lamp, [](Light& l) { l.range_m = 3.5f; });
    step();
    step();
    ASSERT_THAT(drawn(), IsEmpty());
    world.move(far_box, {-6.1, 1, -4});
    step();
    EXPECT_THAT(drawn(), Not(IsEmpty()));
    EXPECT_THAT(drawn(), Not(Contains("shadow near 0")));
    EXPECT_EQ(light("near").state, LightState::reused);
    world.move(stage.box, {0.05, 1, 0});
    step();
    EXPECT_THAT(drawn(), ElementsAre("shadow near 0"));
    EXPECT_EQ(light("far").state, LightState::reused);
}

TEST_F(DepthPasses, AFaceOfACubeWithoutAnyMovedCasterIsKept) {
    world.add_light(LightKind::point, {0, 4, 0}, "lamp");
    step();
    step();
    ASSERT_THAT(drawn(), IsEmpty());
    world.move(stage.box, {0.05, 1, 0});  // only below the lamp, between near and far as before
    step();
    EXPECT_THAT(drawn(), ElementsAre("shadow lamp 3"));
    EXPECT_EQ(light("lamp").counts.views, 5u) << "not overhead";
    EXPECT_EQ(light("lamp").counts.views_drawn, 1u);
}

TEST_F(DepthPasses, AWalkingCameraRedrawsNoLocalLightWhoseReceiversItSeesWhole) {
    world.add_light(LightKind::spot, kLightPlace_m, "spot");
    world.add_light(LightKind::point, kLightPlace_m, "point");
    world.move(stage.camera, {0, 30, 60});
    step();
    world.move(stage.camera, {0.5, 31, 61});
    step();
    EXPECT_THAT(drawn(), IsEmpty());
    EXPECT_EQ(light("spot").state, LightState::reused);
    EXPECT_EQ(light("point").state, LightState::reused);
}

TEST_F(DepthPasses, AWalkAmongReceiversRedrawsLocalLightsOnlyAtTheirFewSteps) {
    world.add_light(LightKind::spot, kLightPlace_m, "spot");
    world.add_light(LightKind::point, kLightPlace_m, "point");
    world.move(stage.camera, {-2, 2, 6});
    step();
    int spot = 0, point = 0;
    constexpr int kSteps = 100;
    for (int i = 1; i <= kSteps; ++i) {
        world.move(stage.camera, {-2 + 0.02 * i, 2, 6 - 0.01 * i});
        step();
        spot += light("spot").counts.views_drawn > 0 ? 1 : 0;
        point += light("point").counts.views_drawn > 0 ? 1 : 0;
    }
    EXPECT_LE(spot, 4);
    EXPECT_LE(point, 4);
}

TEST_F(DepthPasses, AMovedReceiverThatCastsNothingRedrawsNoSpot) {
    const ecs::Entity marker = world.add_mesh(kBox, {0.5, 0.2, 1}, false);
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    world.move(marker, {0.4, 0.2, 1});
    step();
    EXPECT_EQ(light("lamp").state, LightState::reused);
}

TEST_F(DepthPasses, ANewLightLeavesTheMapsOfOthersAlone) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    world.add_light(LightKind::spot, {-3, 6, 1}, "second");
    step();
    EXPECT_THAT(drawn(), ElementsAre("shadow second 0"));
    EXPECT_EQ(light("lamp").state, LightState::reused);
}

TEST_F(DepthPasses, ReusedMapsAreStillBoundForLighting) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    const auto bound_map = [&]() -> gl::TextureHandle {
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* b = std::get_if<gl::BindTexture>(&c); b && b->unit == 4) return b->texture;
        return {};
    };
    step();
    const gl::TextureHandle map = bound_map();
    ASSERT_TRUE(map);
    EXPECT_EQ(device.texture(map)->label, "shadow map lamp");
    step();
    EXPECT_EQ(bound_map(), map);
}

class SolidCasters : public DepthPasses {
protected:
    /// Returns how the depth passes cull, one entry per pipeline that they set.
    std::vector<gl::CullMode> culling() const {
        std::vector<gl::CullMode> modes;
        for (const Pass& pass : depth_passes())
            for (const gl::PipelineState& state : pass.pipelines) modes.push_back(state.cull);
        return modes;
    }
    ecs::Entity add_solid(const glm::dvec3& at_m) { return world.add_mesh(kSolidBox, at_m, true); }
};

TEST_F(SolidCasters, AreDrawnWithoutTheirBackFaces) {
    world.registry.destroy(stage.box);
    add_solid({0, 1, 0});
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        world.add_light(kind, kLightPlace_m, kind == LightKind::spot ? "spot" : kind == LightKind::point ? "point" : "sun");
    step();
    EXPECT_THAT(culling(), Not(IsEmpty()));
    EXPECT_THAT(culling(), Each(gl::CullMode::back));
    for (const Pass& pass : depth_passes())
        for (const gl::PipelineState& state : pass.pipelines) EXPECT_FALSE(state.front_is_clockwise);
}

TEST_F(SolidCasters, AreDrawnFromBothSidesWhereNothingIsKnownOfTheirTopology) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(culling(), ElementsAre(gl::CullMode::none));
}

TEST_F(SolidCasters, AreDrawnFromBothSidesByALightInside) {
    world.registry.destroy(stage.box);
    add_solid({0.2, 3, 0});
    add_solid({2, 1, 0});
    world.add_light(LightKind::spot, {0, 3.3, 0.1}, "lamp");
    step();
    EXPECT_THAT(culling(), ElementsAre(gl::CullMode::none, gl::CullMode::back)) << "the other one is culled";
}

TEST_F(SolidCasters, WindTheOtherWayWhenMirrored) {
    world.registry.destroy(stage.box);
    const ecs::Entity mirrored = add_solid({0, 1, 0});
    world.registry.patch<Transform>(mirrored, [](Transform& t) { t.scale.x = -1.0; });
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_THAT(depth_passes().at(0).pipelines, SizeIs(1));
    EXPECT_EQ(depth_passes().at(0).pipelines[0].cull, gl::CullMode::back);
    EXPECT_TRUE(depth_passes().at(0).pipelines[0].front_is_clockwise);
    add_solid({2, 1, 0});
    const ecs::Entity third = add_solid({-2, 1, 0});
    start();  // what was there from the first frame stands still; others would be drawn apart
    step();
    ASSERT_THAT(depth_passes().at(0).draws, SizeIs(2)) << "one draw per winding";
    EXPECT_THAT(culling(), ElementsAre(gl::CullMode::back, gl::CullMode::back));
    EXPECT_FALSE(depth_passes().at(0).pipelines[0].front_is_clockwise);
    EXPECT_TRUE(depth_passes().at(0).pipelines[1].front_is_clockwise);
    EXPECT_EQ(drawn_slots(depth_passes().at(0)).back(), slot_of(mirrored)) << "those that wind alike are one draw";
    EXPECT_EQ(depth_passes().at(0).draws[0].item_count, 2u) << slot_of(third);
}

TEST_F(SolidCasters, AreDrawnByTheFacesThatTheLightAsksFor) {
    world.registry.destroy(stage.box);
    add_solid({0, 1, 0});
    const ecs::Entity mirrored = add_solid({1.5, 1, 0});
    world.registry.patch<Transform>(mirrored, [](Transform& t) { t.scale.z = -1.0; });
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        const ecs::Entity lamp = world.add_light(kind, kLightPlace_m, "lamp");
        using enum gl::CullMode;
        for (const auto& [faces, culled] : {std::pair{CasterFaces::automatic, back}, std::pair{CasterFaces::front, back},
                                            std::pair{CasterFaces::back, front}, std::pair{CasterFaces::both, none}}) {
            world.registry.patch<LightShadow>(lamp, [&, asked = faces](LightShadow& s) { s.caster_faces = asked; });
            step();
            if (faces != CasterFaces::front) {
                ASSERT_THAT(depth_passes(), Not(IsEmpty())) << "other faces are another picture";
            }
            bool plain_seen = false, mirrored_seen = false;
            for (const Pass& pass : depth_passes()) {
                if (pass.draws.empty()) continue;
                // A face of a cube may hold one of the two alone. Mirrored come last.
                const auto drawn = drawn_slots(pass);
                const bool mirrored_drawn = std::count(drawn.begin(), drawn.end(), slot_of(mirrored)) > 0;
                const bool plain_drawn = drawn.size() > (mirrored_drawn ? 1u : 0u);
                EXPECT_TRUE(kind == LightKind::point || (plain_drawn && mirrored_drawn)) << "one map holds both";
                plain_seen = plain_seen || plain_drawn;
                mirrored_seen = mirrored_seen || mirrored_drawn;
                std::vector<std::pair<gl::CullMode, bool>> modes, wanted;
                for (const auto& state : pass.pipelines) modes.emplace_back(state.cull, state.front_is_clockwise);
                if (culled == none || plain_drawn) wanted.emplace_back(culled, false);
                if (culled != none && mirrored_drawn) wanted.emplace_back(culled, true);
                EXPECT_EQ(modes, wanted);
            }
            EXPECT_TRUE(depth_passes().empty() || (plain_seen && mirrored_seen));
        }
        world.registry.destroy(lamp);
    }
}

TEST_F(SolidCasters, AreTheOnlyOnesThatFacesAreAskedOf) {
    world.add_mesh(kMaskedBox, {-1, 1, 0}, true);
    world.add_mesh(kMixedBox, {1, 1, 0}, true);
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    for (const CasterFaces faces : {CasterFaces::front, CasterFaces::back}) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.caster_faces = faces; });
        step();
        EXPECT_THAT(culling(), Each(gl::CullMode::none));
    }
}

TEST_F(SolidCasters, ShareThePipelineWithTheirLike) {
    add_solid({1, 1, 0});
    world.add_mesh(kMaskedBox, {-1, 1, 0}, true);
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(culling(), ElementsAre(gl::CullMode::none, gl::CullMode::back, gl::CullMode::none));
}

}  // namespace
}  // namespace gnomon
