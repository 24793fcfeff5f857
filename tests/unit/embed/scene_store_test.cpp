#include "systems/embed/scene_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "systems/extract/scene_tree.h"
#include "tests/unit/allocation_counter.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::embed {
namespace {

constexpr std::array<glm::vec3, 4> kCorners{
    glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}};
constexpr std::array<std::uint32_t, 12> kFaces{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};

class SceneStoreTest : public ::testing::Test {
protected:
    SceneStore store;
    std::vector<ConsumerItem> cameras{{.entity = {0, 1}, .name = "view"}};

    MeshId add_mesh() {
        const auto made = store.add_mesh({.name = "tetrahedron", .positions_m = kCorners, .indices = kFaces});
        EXPECT_TRUE(made);
        return made.value();
    }
    CasterId add_at(MeshId mesh, const glm::dvec3& at_m) {
        return store.add_caster({.mesh = mesh, .world_from_mesh = glm::translate(glm::dmat4(1.0), at_m)});
    }
    const SceneSnapshot& updated() {
        store.update(cameras);
        return store.snapshot();
    }
};

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

TEST_F(SceneStoreTest, WhatComesIsAStepFromTheListBeforeUnlessAnotherChangedWhatItCasts) {
    const MeshId mesh = add_mesh();
    std::vector<CasterId> casters;
    for (int i = 0; i < 20; ++i) casters.push_back(add_at(mesh, {3.0 * i, 0.0, 0.0}));
    std::uint64_t before = updated().list_version;
    const auto led_there = [&] {
        const SceneSnapshot& scene = updated();
        return scene.list_splice.leads(std::exchange(before, scene.list_version), scene.list_version);
    };
    add_at(mesh, {0.0, 9.0, 0.0});
    EXPECT_TRUE(led_there());
    add_at(mesh, {3.0, 9.0, 0.0});
    store.set_caster(casters[2], {.mesh = mesh, .casts = false});
    EXPECT_FALSE(led_there());
    store.remove(casters[4]);
    EXPECT_TRUE(led_there()) << "the next step is one again";
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

/// Casters that come and go at random, beside what the store is to say of them.
class StreamedCasters : public SceneStoreTest {
protected:
    struct Known {
        CasterId id;
        double x_m = 0.0;
        MeshId mesh;
        bool touched = true;  // since the last update
        std::uint64_t version = 0;
    };
    void SetUp() override {
        meshes = {add_mesh(), add_mesh()};
        for (int i = 0; i < 300; ++i) add();
        expect_all("at first");
    }
    void add() {
        const MeshId mesh = meshes[known.size() % 2];
        known.push_back({add_at(mesh, {++places, 0.0, 0.0}), places, mesh});
    }
    void remove(std::size_t at) {
        store.remove(known[at].id);
        known.erase(known.begin() + static_cast<std::ptrdiff_t>(at));
    }
    void place(std::size_t at, double x_m, MeshId mesh) {
        Known& k = known[at];
        k.touched = k.touched || k.x_m != x_m || k.mesh != mesh;
        k.x_m = x_m;
        k.mesh = mesh;
        store.set_caster(k.id, {.mesh = mesh, .world_from_mesh = glm::translate(glm::dmat4(1.0), {x_m, 0.0, 0.0})});
    }
    void expect_all(const std::string& when) {
        const SceneSnapshot& scene = updated();
        std::sort(known.begin(), known.end(), [](const Known& a, const Known& b) { return a.id.index < b.id.index; });
        ASSERT_EQ(scene.instances.size(), known.size()) << when;
        ASSERT_TRUE(has_tree(scene)) << when;
        for (std::uint32_t i = 0; i < known.size(); ++i) {
            Known& k = known[i];
            const InstanceItem& item = scene.instances[i];
            const bool changed = std::count(scene.changed_instances.begin(), scene.changed_instances.end(), i) == 1;
            EXPECT_EQ(item.entity, (ecs::Entity{k.id.index, k.id.version})) << when;
            EXPECT_EQ(item.translation_ws_m.x, k.x_m) << when;
            EXPECT_EQ(item.mesh, store.mesh_index(k.mesh)) << when;
            EXPECT_EQ(changed, k.touched) << when << ": instance " << i;
            EXPECT_EQ(item.version, k.touched ? scene.version : k.version) << when;
            k.touched = false;
            k.version = item.version;
            std::vector<std::uint32_t> seen;
            if (i % 50 == 0)
                scene.tree.visit(
                    [&](const math::Aabb& box) {
                        return math::overlaps(box, item.bounds_ws) ? math::Overlap::partial : math::Overlap::outside;
                    },
                    [&](std::uint32_t found) { seen.push_back(found); });
            EXPECT_TRUE(i % 50 != 0 || std::count(seen.begin(), seen.end(), i) == 1) << when;
        }
    }
    std::array<MeshId, 2> meshes;
    std::vector<Known> known;
    double places = 0.0;
};

TEST_F(StreamedCasters, InAnyOrderAreListedAsTheyAreAndNoOtherChanges) {
    std::mt19937_64 random(print_seed());
    const auto below = [&](std::size_t bound) {
        return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
    };
    for (int round = 0; round < 200 && !HasFailure(); ++round) {
        for (std::size_t k = below(10) + 1; k > 0; --k) {
            const std::size_t at = below(known.size());
            const std::size_t what = below(6);
            if (what < 2)
                add();
            else if (what < 4)
                remove(at);
            else if (what == 4)
                place(at, known[at].x_m, meshes[below(2)]);
            else
                place(at, ++places, known[at].mesh);
        }
        expect_all("round " + std::to_string(round));
    }
}

TEST_F(StreamedCasters, AddedAndRemovedBetweenUpdatesWereNever) {
    const std::uint64_t version = store.snapshot().version;
    add();
    remove(known.size() - 1);
    EXPECT_EQ(updated().version, version);
    place(5, known[5].x_m, meshes[1]);
    place(5, known[5].x_m, meshes[0]);
    remove(5);
    expect_all("exchanged twice, then removed");
}

TEST_F(StreamedCasters, OneThatCannotBePlacedIsNamedAndTheOthersStay) {
    const CasterId bad = add_at(meshes[0], {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    add();
    expect_all("one has no place");
    ASSERT_EQ(store.dropped().size(), 1u);
    EXPECT_EQ(store.dropped()[0].caster, bad);
    add();
    expect_all("another came");
    EXPECT_EQ(store.dropped().size(), 1u);
    store.remove(bad);
    expect_all("it went");
    EXPECT_TRUE(store.dropped().empty());
}

TEST_F(StreamedCasters, AMeshThatCameWithItsCasterHasItsShape) {
    const std::size_t shapes = store.snapshot().meshes.shapes.size();
    const MeshId mesh = add_mesh();
    add_at(mesh, {-5.0, 0.0, 0.0});
    EXPECT_EQ(updated().meshes.shapes.size(), shapes + 1);
    EXPECT_EQ(store.snapshot().meshes.shapes.back(), store.library().meshes[store.mesh_index(mesh)].shape);
}

TEST_F(StreamedCasters, AllocateNothingOnceWarm) {
    const auto frame = [&] {
        for (int k = 0; k < 3; ++k) {
            store.remove(known.back().id);
            known.pop_back();
        }
        for (int k = 0; k < 3; ++k) add();
        updated();
    };
    for (int i = 0; i < 300; ++i) frame();
    const std::size_t before = allocation_count();
    for (int i = 0; i < 50; ++i) frame();
    EXPECT_EQ(allocation_count(), before);
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
