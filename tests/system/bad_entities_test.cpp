#include <cmath>
#include <limits>

#include "gnomon/components.h"
#include "shaders/bindings.h"
#include "tests/system/frame_fixture.h"

/// What cannot be used is left out, reported, and comes back when mended. Nothing else changes.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class BadEntities : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        victim = world.add_mesh(kBox, {1.5, 1, 0}, true);
    }
    /// Returns entity and reason of what was dropped, as text.
    std::vector<std::string> dropped() const {
        std::vector<std::string> all;
        for (const DroppedEntity& d : frame->report().dropped)
            all.push_back(std::to_string(d.entity.index) + " " + reason_code(d.reason));
        return all;
    }
    std::string drop(ecs::Entity e, const char* reason) const { return std::to_string(e.index) + " " + reason; }
    std::vector<std::uint32_t> shadow_slots() const {
        const auto depth = depth_passes();
        return depth.empty() ? std::vector<std::uint32_t>{} : drawn_slots(depth[0]);
    }
    const InstanceItem* item(ecs::Entity e) const {
        for (const InstanceItem& i : frame->snapshot().instances)
            if (i.entity == e) return &i;
        return nullptr;
    }
    TestWorld::Stage stage;
    ecs::Entity lamp, victim;
};

TEST_F(BadEntities, ANanInOneTransformDropsThatEntityOnly) {
    step();
    const std::uint32_t slot = slot_of(stage.box);
    ASSERT_THAT(shadow_slots(), ElementsAre(slot, slot_of(victim)));
    world.move(victim, {kNan, 1, 0});
    step();
    EXPECT_THAT(dropped(), ElementsAre(drop(victim, "non_finite_transform")));
    EXPECT_EQ(item(victim), nullptr);
    EXPECT_EQ(slot_of(stage.box), slot) << "the others stay where they are";
    EXPECT_THAT(shadow_slots(), ElementsAre(slot));
    for (const gl::Command& c : frame->commands().commands)
        if (const auto* update = std::get_if<gl::UpdateBuffer>(&c);
            update && device.buffer(update->buffer)->label == "instances")
            ADD_FAILURE() << "nobody else's record changed";
    step();
    EXPECT_THAT(dropped(), ElementsAre(drop(victim, "non_finite_transform"))) << "as long as it lasts";
    world.move(victim, {1.5, 1, 0});
    step();
    EXPECT_THAT(dropped(), IsEmpty());
    EXPECT_THAT(shadow_slots(), ElementsAre(slot, slot_of(victim)));
}

TEST_F(BadEntities, OtherDrawsAreTheSameAsIfTheFaultyOneHadNeverBeen) {
    step();
    world.move(victim, {1, kNan, 0});
    const auto without = [&] {
        step();
        std::vector<gl::DrawMeshes> draws;
        for (const Pass& p : passes()) draws.insert(draws.end(), p.draws.begin(), p.draws.end());
        return draws;
    };
    const auto faulty = without();
    world.registry.destroy(victim);
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    EXPECT_EQ(faulty, without());
    EXPECT_THAT(dropped(), IsEmpty()) << "a destroyed entity is no fault any more";
}

TEST_F(BadEntities, AnInfiniteOrHugePlaceIsDroppedOrDrawnButNeverSpreads) {
    for (const double x :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 1e308, 1e30, 1e8}) {
        world.move(victim, {x, 1, 0});
        step();
        EXPECT_GT(light("lamp").counts.views, 0u) << x;
        EXPECT_TRUE(std::isfinite(light("lamp").predicted_error_px)) << x;
    }
}

TEST_F(BadEntities, AZeroScaleHidesTheMeshAndSaysSo) {
    step();
    for (const glm::dvec3& scale : {glm::dvec3(0.0), glm::dvec3(1, 0, 0)}) {
        world.registry.patch<Transform>(victim, [&](Transform& t) { t.scale = scale; });
        step();
        EXPECT_THAT(dropped(), ElementsAre(drop(victim, "zero_scale")));
        EXPECT_THAT(shadow_slots(), ElementsAre(slot_of(stage.box)));
        world.registry.patch<Transform>(victim, [](Transform& t) { t.scale = glm::dvec3(1.0); });
        step();
        EXPECT_THAT(dropped(), IsEmpty());
        EXPECT_THAT(shadow_slots(), SizeIs(2));
    }
}

TEST_F(BadEntities, AnotherThatMovesInTheFrameOfAFaultIsStillUploaded) {
    step();
    world.move(stage.box, {0.25, 1, 0});
    world.registry.patch<Transform>(victim, [](Transform& t) {  // finite itself, its bounds are not
        t.translation_m.x = 1.7e308;
        t.scale = glm::dvec3(1e308, 1e-300, 1.0);
    });
    step();
    EXPECT_EQ(item(victim), nullptr);
    gl::BufferHandle instances{};
    for (const gl::Command& c : frame->commands().commands)
        if (const auto* b = std::get_if<gl::BindTexels>(&c); b && b->unit == bindings::kInstanceUnit)
            instances = b->buffer;
    InstanceRecord record;
    std::memcpy(&record, device.buffer_bytes(instances).data() + slot_of(stage.box) * sizeof record, sizeof record);
    EXPECT_EQ(record.basis_x_high_x[3], 0.25f);
}

TEST_F(BadEntities, OfMoreThanTheDeviceReadsAsTexelsAsManyAreDrawnAsItDoes) {
    for (int i = 0; i < 1000; ++i) world.add_mesh(kBox, {0.001 * i, 1, 0}, i >= 600);
    gl::DeviceInfo info = gl::RecordingDevice::default_info();
    for (const std::uint32_t slots : {600u, 1024u}) {
        info.max_texel_bytes = slots * sizeof(InstanceRecord);
        gl::RecordingDevice few(info);
        auto made = FrameSystem::create(few, library);
        ASSERT_TRUE(made);
        const std::unique_ptr<FrameSystem> own = std::move(made).value();
        for (int i = 0; i < 2; ++i) own->run(world.registry, settings);
        std::uint32_t drawn = 0, buffers = 0;
        for (const Pass& p : passes_of(own->commands(), few))
            if (p.group == "surfaces")
                for (const gl::DrawMeshes& d : p.draws) drawn += d.item_count;
        for (const gl::ResourceCall& call : few.resource_calls()) buffers += call.label == "instances" ? 1 : 0;
        const bool all = slots == 1024u;
        EXPECT_EQ(drawn, all ? 1003u : 600u);
        EXPECT_EQ(buffers, 1u) << "it is not tried again in vain";
        ASSERT_THAT(own->report().lights, SizeIs(1));
        EXPECT_EQ(own->report().lights[0].reason, all ? Reason::content_unchanged : Reason::buffer_failed);
        ASSERT_THAT(own->report().dropped, SizeIs(all ? 0 : 403));
        for (const DroppedEntity& d : own->report().dropped) {
            EXPECT_EQ(d.reason, DropReason::instances_full);
            EXPECT_TRUE(world.registry.alive(d.entity));
        }
        EXPECT_THAT(few.findings(), IsEmpty());
    }
}

TEST_F(BadEntities, AnUnknownMeshIsDropped) {
    world.registry.patch<MeshRef>(victim, [](MeshRef& m) { m.mesh = 4711; });
    step();
    EXPECT_THAT(dropped(), ElementsAre(drop(victim, "unknown_mesh")));
    world.registry.patch<MeshRef>(victim, [](MeshRef& m) { m.mesh = kBox; });
    step();
    EXPECT_THAT(dropped(), IsEmpty());
    EXPECT_THAT(shadow_slots(), SizeIs(2));
}

TEST_F(BadEntities, ACycleOfParentsIsDroppedWhole) {
    world.registry.patch<Transform>(victim, [&](Transform& t) { t.parent = victim; });
    step();
    EXPECT_THAT(dropped(), ElementsAre(drop(victim, "parent_cycle")));
    EXPECT_THAT(shadow_slots(), ElementsAre(slot_of(stage.box)));
}

TEST_F(BadEntities, TheReasonFollowsTheFault) {
    world.move(victim, {kNan, 0, 0});
    step();
    ASSERT_THAT(dropped(), ElementsAre(drop(victim, "non_finite_transform")));
    world.registry.patch<Transform>(victim, [](Transform& t) {
        t.translation_m = glm::dvec3(0.0);
        t.rotation = glm::dquat(0, 0, 0, 0);
    });
    step();
    EXPECT_THAT(dropped(), ElementsAre(drop(victim, "zero_rotation")));
}

TEST_F(BadEntities, AnAbsurdLightIsDroppedAndTheOthersShine) {
    const std::vector<void (*)(Light&)> faults = {
        [](Light& l) { l.intensity = std::numeric_limits<float>::quiet_NaN(); },
        [](Light& l) { l.intensity = -1.0f; },
        [](Light& l) { l.intensity = std::numeric_limits<float>::infinity(); },
        [](Light& l) { l.intensity = 1.0e30f, l.colour.g = 1.0e10f; },  // each of them finite
        [](Light& l) { l.range_m = -2.0f; },
        [](Light& l) { l.colour.g = std::numeric_limits<float>::quiet_NaN(); },
        [](Light& l) { l.inner_cone_rad = 0.9f, l.outer_cone_rad = 0.4f; },
        [](Light& l) { l.outer_cone_rad = 3.0f; },
        [](Light& l) { l.outer_cone_rad = 0.0f; },
    };
    const ecs::Entity other = world.add_light(LightKind::spot, {-3, 6, 1}, "other");
    const Light sane = *world.registry.get<Light>(other);
    for (std::size_t i = 0; i < faults.size(); ++i) {
        world.registry.patch<Light>(other, faults[i]);
        step();
        EXPECT_THAT(dropped(), ElementsAre(drop(other, "absurd_light"))) << i;
        ASSERT_THAT(frame->report().lights, SizeIs(1)) << i;
        EXPECT_EQ(frame->report().lights[0].name, "lamp");
        EXPECT_THAT(map_labels(device, "shadow map other"), IsEmpty());
        world.registry.emplace<Light>(other, sane);
        step();
        EXPECT_THAT(dropped(), IsEmpty()) << i;
        EXPECT_THAT(frame->report().lights, SizeIs(2)) << i;
    }
}

TEST_F(BadEntities, AnAbsurdCameraIsDroppedAndTheNextTakesOver) {
    const ecs::Entity second = world.add_camera({0, 5, 9}, {0, 0, 0});
    const std::vector<void (*)(Camera&)> faults = {
        [](Camera& c) { c.fov_y_rad = kNan; },
        [](Camera& c) { c.fov_y_rad = 0.0; },
        [](Camera& c) { c.fov_y_rad = 4.0; },
        [](Camera& c) { c.near_m = 0.0; },
        [](Camera& c) { c.near_m = kNan; },
        [](Camera& c) { c.far_m = 0.01; },
        [](Camera& c) { c.projection = CameraProjection::orthographic, c.half_height_m = 0.0; },
        [](Camera& c) {
            c.projection = CameraProjection::orthographic, c.far_m = std::numeric_limits<double>::infinity();
        },
    };
    for (std::size_t i = 0; i < faults.size(); ++i) {
        world.registry.patch<Camera>(stage.camera, faults[i]);
        step();
        EXPECT_THAT(dropped(), ElementsAre(drop(stage.camera, "absurd_camera"))) << i;
        ASSERT_THAT(frame->snapshot().consumers, SizeIs(1));
        EXPECT_EQ(frame->snapshot().consumers[0].entity, second);
        world.registry.emplace<Camera>(stage.camera, {});
    }
}

TEST_F(BadEntities, AFaultyTransformOfCameraOrLightIsDroppedAndReturns) {
    for (const ecs::Entity e : {stage.camera, lamp}) {
        const Transform sane = *world.registry.get<Transform>(e);
        step();
        world.move(e, {0, kNan, 0});
        step();
        EXPECT_THAT(dropped(), ElementsAre(drop(e, "non_finite_transform")));
        world.registry.emplace<Transform>(e, sane);
        step();
        EXPECT_THAT(dropped(), IsEmpty());
        EXPECT_GT(light("lamp").counts.views, 0u);
    }
}

class OddWorlds : public FrameTest {};

TEST_F(OddWorlds, AnEmptyWorldIsAFrame) {
    for (int i = 0; i < 2; ++i) {
        EXPECT_THAT(step().lights, IsEmpty());
        EXPECT_THAT(frame->commands().commands, IsEmpty());
    }
}

TEST_F(OddWorlds, AWorldWithoutCameraDrawsNothingAndSaysWhy) {
    world.add_mesh(kPlane, {0, 0, 0}, false);
    world.add_mesh(kBox, {0, 1, 0}, true);
    world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    EXPECT_EQ(light("lamp").reason, Reason::no_visible_receiver);
    EXPECT_THAT(passes(), IsEmpty());
    std::vector<std::uint8_t> pixels;
    EXPECT_FALSE(frame->read_picture(pixels));
    std::vector<float> values;
    EXPECT_FALSE(frame->read_visibility(0, values));
}

TEST_F(OddWorlds, OneLightAndNothingElse) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        world.add_light(kind, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(passes(), IsEmpty());
    world.add_camera({0, 0, 5}, {0, 0, 0});
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    for (const LightReport& l : frame->report().lights) EXPECT_EQ(l.reason, Reason::no_visible_receiver);
    std::vector<std::uint8_t> pixels;
    EXPECT_TRUE(frame->read_picture(pixels));
}

TEST_F(OddWorlds, AnEmptyLibraryIsNoReasonToFail) {
    gl::RecordingDevice bare;
    {
        const assets::MeshLibrary nothing;
        auto made = FrameSystem::create(bare, nothing);
        ASSERT_TRUE(made);
        world.add_stage();
        made.value()->run(world.registry, settings);
        EXPECT_THAT(made.value()->report().dropped, SizeIs(2));
    }
    EXPECT_THAT(bare.findings(), IsEmpty());
    EXPECT_EQ(bare.live_count(), 0u);
}

TEST_F(OddWorlds, TwoHundredLightsEachHaveTheirMapAndTheirReport) {
    world.add_stage();
    constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};
    for (int i = 0; i < 200; ++i) {
        const ecs::Entity e = world.add_light(kKinds[i % 3], {3.0 + 0.01 * i, 6.0, 1.0}, "lamp");
        world.registry.patch<LightShadow>(e, [](LightShadow& s) { s.resolution_px = 64; });
    }
    step();
    ASSERT_THAT(frame->report().lights, SizeIs(200));
    std::uint32_t views = 0;
    for (const LightReport& l : frame->report().lights) {
        EXPECT_EQ(l.state, LightState::rendered) << l.name;
        views += l.counts.views_drawn;
    }
    EXPECT_THAT(depth_passes(), SizeIs(views));
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
}

TEST_F(OddWorlds, ACasterAroundTheLightAndAReceiverThroughItAreDrawn) {
    world.add_stage();
    world.add_mesh(kBox, kLightPlace_m, true);
    for (const LightKind kind : {LightKind::spot, LightKind::point}) world.add_light(kind, kLightPlace_m, "lamp");
    step();
    for (const LightReport& l : frame->report().lights) EXPECT_EQ(l.state, LightState::rendered);
}

TEST_F(OddWorlds, TwoCamerasShareTheMaps) {
    world.add_stage();
    world.add_camera({8, 4, 0}, {0, 0, 0});
    world.add_light(LightKind::directional, kLightPlace_m, "sun");
    step();
    EXPECT_EQ(light("sun").state, LightState::rendered);
    EXPECT_THAT(map_labels(device), SizeIs(1 + 1));
}

}  // namespace
}  // namespace gnomon
