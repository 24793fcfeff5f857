#include <array>
#include <limits>
#include <string>
#include <vector>

#include "systems/extract/scene_tree.h"
#include "tests/unit/embed/scene_store_fixture.h"

namespace gnomon::embed {
namespace {

TEST_F(SceneStoreTest, ListsCastersWithTheirPlaces) {
    const MeshId mesh = add_mesh();
    add_at(mesh, {1.0, 0.0, 0.0});
    add_at(mesh, {5.0, 0.0, 0.0});
    const SceneSnapshot& scene = updated();
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.changed_instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].translation_ws_m.x, 5.0);
    EXPECT_EQ(scene.instances[1].bounds_ws.max.x, 6.0);
    EXPECT_TRUE(has_tree(scene));
}

TEST_F(SceneStoreTest, AChangedBoxChangesItsCastersAlone) {
    const MeshId box = store.add_box("box", {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
    add_at(add_mesh(), {0.0, 0.0, 0.0});
    add_at(box, {4.0, 0.0, 0.0});
    add_at(box, {8.0, 0.0, 0.0});
    const SceneSnapshot& scene = updated();
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_TRUE(scene.drawables.any_by_depth);
    EXPECT_FALSE(scene.instances[0].drawable.by_depth);
    EXPECT_TRUE(scene.instances[1].drawable.by_depth && scene.instances[2].drawable.by_depth);
    const std::uint64_t stays = scene.instances[0].version, mesh_version = scene.instances[1].mesh_version;
    store.change_box(box, {{0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}});
    EXPECT_EQ(updated().changed_instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].version, stays);
    EXPECT_EQ(scene.instances[2].version, scene.version);
    EXPECT_NE(scene.instances[2].mesh_version, mesh_version) << "how far it moved is unknown";
    EXPECT_EQ(scene.instances[2].bounds_ws.max.x, 10.0);
    store.change_box(box, {{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}});
    updated();
    ASSERT_EQ(store.dropped().size(), 2u);
    EXPECT_EQ(store.dropped()[0].reason, "non_finite_transform") << "no box";
    const std::uint32_t lost[] = {store.mesh_index(box)};
    store.change_box(box, {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
    store.update(cameras, {}, lost);
    ASSERT_EQ(store.dropped().size(), 2u);
    EXPECT_EQ(store.dropped()[0].reason, "buffer_lost");
    updated();
    EXPECT_TRUE(store.dropped().empty());
    EXPECT_EQ(scene.instances.size(), 3u);
}

TEST_F(SceneStoreTest, WithoutAChangeTheVersionStays) {
    const CasterId caster = add_at(add_mesh(), {0.0, 0.0, 0.0});
    const LightId light = store.add_light({});
    const std::uint64_t version = updated().version;
    EXPECT_EQ(updated().version, version);
    store.set_transform(caster, glm::dmat4(1.0));  // equal
    store.set_light(light, {});
    store.tune(light, {});
    EXPECT_EQ(updated().version, version);
    EXPECT_TRUE(store.snapshot().changed_instances.empty());
    cameras.front().position_ws_m.x = 1.0;
    EXPECT_GT(updated().version, version) << "control: a camera moved";
}

TEST_F(SceneStoreTest, AMoveIsAppliedInPlace) {
    const MeshId mesh = add_mesh();
    const CasterId still = add_at(mesh, {0.0, 0.0, 0.0}), moving = add_at(mesh, {3.0, 0.0, 0.0});
    static_cast<void>(still);
    const std::uint64_t list = updated().list_version;
    const std::uint64_t first = store.snapshot().instances[0].version, second = store.snapshot().instances[1].version;
    store.set_transform(moving, glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 0.0, 0.0)));
    const SceneSnapshot& scene = updated();
    EXPECT_EQ(scene.list_version, list);
    EXPECT_EQ(scene.changed_instances, std::vector<std::uint32_t>{1});
    EXPECT_EQ(scene.instances[0].version, first);
    EXPECT_GT(scene.instances[1].version, second);
    EXPECT_EQ(scene.instances[1].bounds_ws.min.x, 4.0);
    EXPECT_TRUE(has_tree(scene));
}

TEST_F(SceneStoreTest, WhatIsRemovedLeavesTheOthersAlone) {
    const MeshId mesh = add_mesh();
    const CasterId first = add_at(mesh, {0.0, 0.0, 0.0});
    add_at(mesh, {3.0, 0.0, 0.0});
    const std::uint64_t version = updated().instances[1].version;
    const std::uint32_t slot = store.snapshot().instances[1].gpu_slot;
    store.remove(first);
    const SceneSnapshot& scene = updated();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].version, version) << "maps that show it stay valid";
    EXPECT_EQ(scene.instances[0].gpu_slot, slot);
    EXPECT_TRUE(scene.changed_instances.empty());
    store.remove(first);  // a handle of nothing
    store.set_transform(first, glm::dmat4(2.0));
    EXPECT_EQ(updated().instances.size(), 1u);
}

TEST_F(SceneStoreTest, ASlotIsUsedAgainByAnotherEntity) {
    const MeshId mesh = add_mesh();
    const CasterId first = add_at(mesh, {0.0, 0.0, 0.0});
    const ecs::Entity was = updated().instances[0].entity;
    const std::uint64_t version = store.snapshot().instances[0].version;
    store.remove(first);
    add_at(mesh, {0.0, 0.0, 0.0});
    const SceneSnapshot& scene = updated();
    EXPECT_EQ(scene.instances[0].gpu_slot, 0u);
    EXPECT_NE(scene.instances[0].entity, was);
    EXPECT_GT(scene.instances[0].version, version);
    EXPECT_EQ(scene.changed_instances.size(), 1u);
}

TEST_F(SceneStoreTest, WhatCannotBePlacedIsNamedAndComesBack) {
    const MeshId mesh = add_mesh();
    add_at(mesh, {0.0, 0.0, 0.0});
    const CasterId bad = add_at(mesh, {1.0, 0.0, 0.0});
    updated();
    const auto reason = [&]() -> std::string_view {
        return store.dropped().empty() ? "" : store.dropped().front().reason;
    };
    EXPECT_EQ(reason(), "");
    store.set_transform(bad, glm::dmat4(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(updated().instances.size(), 1u);
    EXPECT_EQ(reason(), "non_finite_transform");
    EXPECT_EQ(store.dropped().front().caster, bad);
    store.set_transform(bad, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)));
    EXPECT_EQ(updated().instances.size(), 1u);
    EXPECT_EQ(reason(), "zero_scale");
    store.set_transform(bad, glm::dmat4(1.0));
    EXPECT_EQ(updated().instances.size(), 2u);
    EXPECT_EQ(reason(), "");
    EXPECT_EQ(store.snapshot().changed_instances.size(), 1u) << "it is uploaded again";
    store.remove(mesh);
    EXPECT_TRUE(updated().instances.empty());
    EXPECT_EQ(reason(), "unknown_mesh");
}

TEST_F(SceneStoreTest, ADrawableIsACasterWithoutTriangles) {
    const auto draw = [](const DrawableView&) {};
    const CasterId grass = store.add_drawable({.draw = draw, .bounds = {{0.0, 0.0, 0.0}, {2.0, 1.0, 2.0}}});
    const SceneSnapshot& scene = updated();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.drawables.any_drawn);
    EXPECT_TRUE(scene.instances[0].drawable.drawn);
    EXPECT_TRUE(store.library().meshes[scene.instances[0].mesh].indices.empty());
    EXPECT_NE(store.draw_of(0), nullptr);
    const std::uint64_t version = scene.instances[0].version;
    updated();
    EXPECT_EQ(store.snapshot().instances[0].version, version) << "it stands still";
    store.redraw(grass, {{0.0, 0.0, 0.0}, {3.0, 1.0, 2.0}}, 0.25);
    EXPECT_GT(updated().instances[0].version, version);
    EXPECT_EQ(store.snapshot().instances[0].bounds_ws.max.x, 3.0);
    EXPECT_EQ(store.snapshot().instances[0].drawable.moved_m, 0.25);
    const std::uint64_t since = store.snapshot().instances[0].drawable.since;
    for (const double unknown :
         {std::numeric_limits<double>::infinity(), -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        store.redraw(grass, {{0.0, 0.0, 0.0}, {3.0, 1.0, 2.0}}, unknown);
        updated();
    }
    EXPECT_EQ(store.snapshot().instances[0].drawable.since, since + 3);
    store.redraw(grass, {{0.0, 0.0, 0.0}, {-1.0, 1.0, 2.0}}, 0.25);
    EXPECT_TRUE(updated().instances.empty()) << "no box";
    EXPECT_FALSE(store.snapshot().drawables.any_drawn);
    EXPECT_EQ(store.dropped().size(), 1u);
    store.remove(grass);
    updated();
    EXPECT_TRUE(store.dropped().empty());
}

TEST_F(SceneStoreTest, MeshesThatAreNoneAreRefusedByRule) {
    const auto rule = [&](const MeshDesc& desc) {
        const auto made = store.add_mesh(desc);
        return made ? std::string() : made.error().rule;
    };
    const std::array<std::uint32_t, 3> beyond{0, 1, 4};
    std::array<glm::vec3, 4> broken = kCorners;
    broken[2].y = std::numeric_limits<float>::infinity();
    const std::array<std::uint8_t, 4> alpha{};
    const std::array<glm::vec2, 4> uvs{};
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = kFaces}), "");
    EXPECT_EQ(rule({}), "mesh.empty");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = std::span(kFaces).first(4)}), "mesh.empty");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = beyond}), "mesh.index");
    EXPECT_EQ(rule({.positions_m = broken, .indices = kFaces}), "mesh.position");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = kFaces, .mask = {{2, 2}, alpha}, .uvs = uvs}), "");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = kFaces, .mask = {{2, 2}, alpha}}), "mesh.mask");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = kFaces, .mask = {{3, 2}, alpha}, .uvs = uvs}), "mesh.mask");
    EXPECT_EQ(rule({.positions_m = kCorners, .indices = kFaces, .mask = {{2, 2}, alpha, 0.0f}, .uvs = uvs}),
              "mesh.mask");
}

TEST_F(SceneStoreTest, LightsKeepTheirHistoryWhenOthersComeAndGo) {
    const LightId first = store.add_light({.name = "lamp"}), second = store.add_light({.name = "lamp"});
    updated();
    const std::uint64_t version = store.snapshot().lights[store.light_index(second)].shape_version;
    EXPECT_NE(store.snapshot().lights[0].name, store.snapshot().lights[1].name);
    store.remove(first);
    updated();
    ASSERT_EQ(store.snapshot().lights.size(), 1u);
    EXPECT_EQ(store.light_index(first), SceneStore::kNone);
    EXPECT_EQ(store.light_index(second), 0u);
    EXPECT_EQ(store.snapshot().lights[0].shape_version, version);
}

TEST_F(SceneStoreTest, ALightWithoutDirectionIsNamedAndComesBack) {
    const LightId sun = store.add_light({.light = {.kind = LightKind::directional}, .direction = glm::dvec3(0.0)});
    EXPECT_TRUE(updated().lights.empty());
    ASSERT_EQ(store.dropped().size(), 1u);
    EXPECT_EQ(store.dropped().front().light, sun);
    store.set_light(sun, {.light = {.kind = LightKind::directional}, .direction = {0.0, -1.0e-200, 0.0}});
    ASSERT_EQ(updated().lights.size(), 1u);
    EXPECT_TRUE(store.dropped().empty());
    EXPECT_EQ(store.snapshot().lights[0].rotation_ws[2], glm::dvec3(0.0, 1.0, 0.0));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 broken(0.0, -1.0, 0.0);
        broken[axis] = std::numeric_limits<double>::quiet_NaN();
        store.set_light(sun, {.light = {.kind = LightKind::directional}, .direction = broken});
        EXPECT_TRUE(updated().lights.empty()) << axis;
    }
    store.set_light(sun, {.light = {.kind = LightKind::directional, .intensity = -1.0f}});
    EXPECT_TRUE(updated().lights.empty());
}

}  // namespace
}  // namespace gnomon::embed
