#include "systems/extract/extract.h"

#include <gmock/gmock.h>

#include <cmath>

#include "gnomon/components.h"
#include "systems/extract/volumes.h"
#include "tests/unit/extract/extracted_world.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ExtractTest : public ExtractedWorldTest {
protected:
    const InstanceItem& item(ecs::Entity e) const {
        static const InstanceItem kNone{};
        for (const InstanceItem& i : snapshot.instances)
            if (i.entity == e) return i;
        ADD_FAILURE() << "not listed";
        return kNone;
    }
    std::vector<ecs::Entity> changed() const {
        std::vector<ecs::Entity> entities;
        for (const std::uint32_t i : snapshot.changed_instances) entities.push_back(snapshot.instances[i].entity);
        return entities;
    }
};

TEST_F(ExtractTest, AnUnchangedWorldChangesNothing) {
    world.add_stage();
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    update();
    EXPECT_THAT(snapshot.changed_instances, SizeIs(2));
    const SceneSnapshot before = snapshot;
    for (int i = 0; i < 3; ++i) {
        update();
        EXPECT_THAT(snapshot.changed_instances, IsEmpty());
        EXPECT_EQ(snapshot.version, before.version);
        EXPECT_EQ(snapshot.lights.at(0).shape_version, before.lights.at(0).shape_version);
        for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(snapshot.instances[k].version, before.instances[k].version);
    }
    EXPECT_EQ(snapshot.lights.at(0).entity, lamp);
}

TEST_F(ExtractTest, OnlyTheMovedOneIsUploadedAndAged) {
    const auto stage = world.add_stage();
    update();
    const std::uint64_t plane_version = item(stage.plane).version, box_version = item(stage.box).version;
    world.move(stage.box, {1, 2, 3});
    update();
    EXPECT_THAT(changed(), ElementsAre(stage.box));
    EXPECT_EQ(item(stage.plane).version, plane_version);
    EXPECT_GT(item(stage.box).version, box_version);
    EXPECT_EQ(item(stage.box).translation_ws_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(item(stage.box).bounds_ws.min, glm::dvec3(0.5, 1.5, 2.5));
}

TEST_F(ExtractTest, AnAddedOneLeavesTheVersionsOfOthers) {
    const auto stage = world.add_stage();
    update();
    const std::uint64_t version = item(stage.box).version;
    const ecs::Entity added = world.add_mesh(kBox, {3, 0, 0}, true);
    update();
    EXPECT_THAT(changed(), ElementsAre(added));
    EXPECT_EQ(item(stage.box).version, version);
}

TEST_F(ExtractTest, SlotsStayWhenOthersGoAndAreUsedAgain) {
    std::vector<ecs::Entity> boxes;
    for (int i = 0; i < 5; ++i) boxes.push_back(world.add_mesh(kBox, {i, 0, 0}, true));
    update();
    std::vector<std::uint32_t> slots;
    for (const ecs::Entity e : boxes) slots.push_back(item(e).gpu_slot);
    world.registry.destroy(boxes[1]);
    world.registry.destroy(boxes[3]);
    update();
    for (const std::size_t i : {0u, 2u, 4u}) EXPECT_EQ(item(boxes[i]).gpu_slot, slots[i]);
    EXPECT_THAT(changed(), IsEmpty()) << "nobody else moved";
    const ecs::Entity newcomer = world.add_mesh(kBox, {9, 0, 0}, true);
    update();
    EXPECT_THAT(item(newcomer).gpu_slot, ::testing::AnyOf(slots[1], slots[3]));
    EXPECT_EQ(snapshot.gpu_slot_count, 5u);
    EXPECT_THAT(changed(), ElementsAre(newcomer));
    std::set<std::uint32_t> distinct;
    for (const InstanceItem& i : snapshot.instances) distinct.insert(i.gpu_slot);
    EXPECT_EQ(distinct.size(), snapshot.instances.size());
}

TEST_F(ExtractTest, AReusedEntityIndexIsAnotherEntity) {
    const ecs::Entity first = world.add_mesh(kBox, {0, 0, 0}, true);
    update();
    world.registry.destroy(first);
    const ecs::Entity second = world.add_mesh(kBox, {0, 0, 0}, true);
    ASSERT_EQ(first.index, second.index);
    update();
    EXPECT_THAT(changed(), ElementsAre(second));
    EXPECT_EQ(snapshot.instances.at(0).entity, second);
}

TEST_F(ExtractTest, EveryChangeOfAnInstanceIsSeen) {
    const auto stage = world.add_stage();
    update();
    const std::vector<std::function<void()>> edits = {
        [&] { world.registry.remove<ShadowCaster>(stage.box); },
        [&] { world.registry.emplace<ShadowCaster>(stage.box); },
        [&] { world.registry.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.enabled = false; }); },
        [&] { world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.receives_shadow = false; }); },
        [&] { world.registry.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.layers = 0x02; }); },
        [&] { world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_layers = 0x04; }); },
        [&] { world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.visible = false; }); },
        [&] { world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_catcher = true; }); },
        [&] { world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.mesh = kMaskedBox; }); },
        [&] { world.registry.patch<Transform>(stage.box, [](Transform& t) { t.scale.x = -1.0; }); },
    };
    for (std::size_t i = 0; i < edits.size(); ++i) {
        const std::uint64_t version = snapshot.version;
        edits[i]();
        update();
        EXPECT_GT(snapshot.version, version) << i;
    }
    EXPECT_FALSE(item(stage.box).casts || item(stage.box).receives || item(stage.box).visible);
    EXPECT_TRUE(item(stage.box).shadow_catcher);
    EXPECT_EQ(item(stage.box).cast_layers, 0x02);
    EXPECT_EQ(item(stage.box).receive_layers, 0x04);
    EXPECT_EQ(item(stage.box).mesh, kMaskedBox);
    EXPECT_TRUE(item(stage.box).winding.mirrored);
}

TEST_F(ExtractTest, OnlyWhatMapsShowAgesAnInstanceAndOnlyWhatItsRecordHoldsIsUploaded) {
    const auto stage = world.add_stage();
    update();
    struct Edit {
        std::function<void()> run;
        bool ages, uploads;
    };
    auto& registry = world.registry;
    const std::vector<Edit> edits = {
        {[&] { registry.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.enabled = false; }); }, false, true},
        {[&] { registry.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.layers = 0x02; }); }, false, true},
        {[&] { registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.visible = false; }); }, false, false},
        {[&] { registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_catcher = true; }); }, false, false},
        {[&] { registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_layers = 0x04; }); }, false, true},
        {[&] { registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.receives_shadow = false; }); }, false, true},
        {[&] { registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.mesh = kMaskedBox; }); }, true, true},
        {[&] { registry.patch<Transform>(stage.box, [](Transform& t) { t.scale.x = -1.0; }); }, true, true},
    };
    for (std::size_t i = 0; i < edits.size(); ++i) {
        const std::uint64_t box = item(stage.box).version, plane = item(stage.plane).version;
        edits[i].run();
        update();
        EXPECT_EQ(item(stage.box).version > box, edits[i].ages) << i;
        EXPECT_EQ(changed(), edits[i].uploads ? std::vector{stage.box} : std::vector<ecs::Entity>{}) << i;
        EXPECT_EQ(item(stage.plane).version, plane) << i;
    }
}

TEST_F(ExtractTest, EveryChangeOfALightIsSeen) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    update();
    const auto version_after = [&](auto edit) {
        edit();
        update();
        return snapshot.version;
    };
    std::uint64_t last = snapshot.version;
    const auto expect_aged = [&](std::uint64_t now) {
        EXPECT_GT(now, last);
        last = now;
    };
    expect_aged(version_after([&] { world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 3.0f; }); }));
    EXPECT_EQ(snapshot.lights[0].intensity, 3.0f);
    expect_aged(
        version_after([&] { world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = 99; }); }));
    EXPECT_EQ(snapshot.lights[0].shadow.resolution_px, 99u);
    expect_aged(version_after([&] { world.move(lamp, {0, 9, 0}); }));
    EXPECT_EQ(snapshot.lights[0].position_ws_m, glm::dvec3(0, 9, 0));
    expect_aged(version_after([&] { world.registry.emplace<Name>(lamp, {"other"}); }));
    EXPECT_EQ(snapshot.lights[0].name, "other");
    expect_aged(version_after([&] { world.registry.remove<LightShadow>(lamp); }));
    EXPECT_FALSE(snapshot.lights[0].has_shadow);
    world.registry.remove<Light>(lamp);
    update();
    EXPECT_THAT(snapshot.lights, IsEmpty());
}

TEST_F(ExtractTest, ACameraComesMovesAndGoes) {
    update();
    EXPECT_THAT(snapshot.consumers, IsEmpty());
    const ecs::Entity camera = world.add_camera({0, 0, 5}, {0, 0, 0});
    update();
    ASSERT_THAT(snapshot.consumers, SizeIs(1));
    EXPECT_EQ(snapshot.consumers[0].viewport_px, viewport_px);
    const std::uint64_t version = snapshot.version;
    world.move(camera, {0, 0, 6});
    update();
    EXPECT_EQ(snapshot.consumers[0].position_ws_m, glm::dvec3(0, 0, 6));
    EXPECT_GT(snapshot.version, version);
    viewport_px = {100, 50};
    update();
    EXPECT_EQ(snapshot.consumers[0].viewport_px, viewport_px);
    world.registry.patch<Camera>(camera, [](Camera& c) { c.active = false; });
    update();
    EXPECT_THAT(snapshot.consumers, IsEmpty());
}

TEST_F(ExtractTest, TheFrameThatACameraWasGivenIsSeenWhole) {
    const ecs::Entity e = world.registry.create();
    world.registry.emplace<Transform>(e);
    const Camera camera{.fov_y_rad = 0.5, .half_height_m = 2.0, .frame_aspect = 4.0};
    world.registry.emplace<Camera>(e, camera);
    const auto half_width = [&] {
        return std::tan(0.5 * snapshot.consumers.at(0).fov_y_rad) * aspect(snapshot.consumers[0]);
    };
    const double framed = std::tan(0.25) * 4.0;
    for (const glm::uvec2 size_px : {glm::uvec2(640, 360), glm::uvec2(300, 600), glm::uvec2(100, 100)}) {
        viewport_px = size_px;
        update();
        EXPECT_NEAR(half_width(), framed, 1e-12) << "the width decides: " << size_px.x;
        EXPECT_NEAR(snapshot.consumers[0].half_height_m * aspect(snapshot.consumers[0]), 8.0, 1e-12);
    }
    viewport_px = {1000, 200};
    update();
    EXPECT_EQ(snapshot.consumers[0].fov_y_rad, 0.5) << "the height decides";
    EXPECT_EQ(snapshot.consumers[0].half_height_m, 2.0);
    viewport_px = {640, 360};
    for (const double same : {0.0, 640.0 / 360.0, static_cast<double>(640.0f / 360.0f), 1.0, -4.0, std::nan("")}) {
        world.registry.patch<Camera>(e, [&](Camera& c) { c.frame_aspect = same; });
        update();
        EXPECT_EQ(snapshot.consumers[0].fov_y_rad, 0.5) << same;
        EXPECT_EQ(snapshot.consumers[0].half_height_m, 2.0) << same;
    }
}

TEST_F(ExtractTest, AFlatViewThatBeginsBehindItsCameraIsTheSameFromThere) {
    world.add_stage();
    const ecs::Entity e = world.registry.create();
    world.registry.emplace<Transform>(e, {.translation_m = {1.0, 2.0, 3.0}});
    world.registry.emplace<Camera>(
        e, {.projection = CameraProjection::orthographic, .half_height_m = 4.0, .near_m = -5.0, .far_m = 100.0});
    const auto seen = [&] {
        for (const ConsumerItem& consumer : snapshot.consumers)
            if (consumer.entity == e) return consumer;
        return ConsumerItem{};
    };
    update();
    EXPECT_EQ(seen().position_ws_m, glm::dvec3(1.0, 2.0, 8.0)) << "it looks along -z";
    EXPECT_GE(seen().near_m, 0.0);
    EXPECT_LE(seen().far_m, 105.0);
    world.move(e, {1.0, 2.0, 4.0});
    update();
    EXPECT_EQ(seen().position_ws_m, glm::dvec3(1.0, 2.0, 9.0));
    world.registry.patch<Camera>(e, [](Camera& c) { c.near_m = 0.0; });
    update();
    EXPECT_EQ(seen().position_ws_m, glm::dvec3(1.0, 2.0, 4.0));
}

TEST_F(ExtractTest, ChildrenMoveWithTheirParents) {
    const ecs::Entity parent = world.registry.create();
    world.registry.emplace<Transform>(parent);
    const ecs::Entity child = world.add_mesh(kBox, {1, 0, 0}, true);
    world.registry.patch<Transform>(child, [&](Transform& t) { t.parent = parent; });
    update();
    world.move(parent, {0, 5, 0});
    update();
    EXPECT_THAT(changed(), ElementsAre(child));
    EXPECT_EQ(item(child).translation_ws_m, glm::dvec3(1, 5, 0));
}

TEST_F(ExtractTest, AMissedLogMeansLookingAfresh) {
    const auto stage = world.add_stage();
    update();
    world.move(stage.box, {2, 1, 0});
    const TransformReport& report = transforms.update(world.registry);
    world.registry.discard_changes();  // before extraction has read them
    extractor.update(world.registry, library, report, viewport_px, snapshot);
    EXPECT_EQ(item(stage.box).translation_ws_m, glm::dvec3(2, 1, 0));
}

std::vector<std::uint32_t> found_at(const SceneSnapshot& scene, const glm::dvec3& place_m) {
    const math::Aabb around{place_m - 0.1, place_m + 0.1};
    std::vector<std::uint32_t> found;
    visit_instances(
        scene,
        [&](const math::Aabb& box) {
            return math::overlaps(box, around) ? math::Overlap::partial : math::Overlap::outside;
        },
        [&](std::uint32_t i) { found.push_back(i); });
    return found;
}

TEST_F(ExtractTest, TheTreeFollowsWhoeverComesMovesOrGoes) {
    std::vector<ecs::Entity> boxes;
    for (int i = 0; i < 40; ++i) boxes.push_back(world.add_mesh(kBox, {3.0 * i, 0, 0}, true));
    const ecs::Entity camera = world.add_camera({0, 4, 8}, {0, 0, 0});
    update();
    ASSERT_TRUE(has_tree(snapshot));
    EXPECT_THAT(found_at(snapshot, {30, 0, 0}), ElementsAre(10u));
    world.move(boxes[10], {0, 50, 0});
    update();
    ASSERT_TRUE(has_tree(snapshot));
    EXPECT_THAT(found_at(snapshot, {30, 0, 0}), IsEmpty());
    EXPECT_THAT(found_at(snapshot, {0, 50, 0}), ElementsAre(10u));
    world.registry.destroy(boxes[0]);
    update();
    ASSERT_TRUE(has_tree(snapshot));
    EXPECT_THAT(found_at(snapshot, {0, 50, 0}), ElementsAre(9u));
    world.move(camera, {0, 4, 9});
    update();
    EXPECT_TRUE(has_tree(snapshot)) << "a camera's move leaves it valid";
    viewport_px = {100, 50};
    update();
    EXPECT_TRUE(has_tree(snapshot));
}

TEST_F(ExtractTest, LightsLookAlongMinusZWhateverTheirScale) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, {0, 7, 0}, "lamp");
    world.registry.patch<Transform>(lamp, [](Transform& t) { t.scale = {1e-9, 5.0, 1e9}; });
    update();
    const glm::dmat3& r = snapshot.lights.at(0).rotation_ws;
    EXPECT_NEAR(r[2].y, 1.0, 1e-12);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(glm::dot(r[i], r[k]), i == k ? 1.0 : 0.0, 1e-12);
}

}  // namespace
}  // namespace gnomon
