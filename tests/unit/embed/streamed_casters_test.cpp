#include <algorithm>
#include <random>
#include <string>
#include <utility>

#include "systems/extract/scene_tree.h"
#include "tests/unit/allocation_counter.h"
#include "tests/unit/embed/scene_store_fixture.h"
#include "tests/unit/math/random_seed.h"

/// Casters that come and go: they are taken into the lists and out of them, and no other is made again.
namespace gnomon::embed {
namespace {

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

}  // namespace
}  // namespace gnomon::embed
