#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "gnomon/components.h"
#include "tests/unit/allocation_counter.h"
#include "tests/unit/extract/extracted_world.h"
#include "tests/unit/math/random_seed.h"

/// Instances that come and go: they are taken into the lists and out of them, and no other is made again.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ComeAndGo : public ExtractedWorldTest {
protected:
    static constexpr int kBoxes = 400;

    void SetUp() override {
        stage = world.add_stage();
        for (int i = 0; i < kBoxes; ++i) boxes.push_back(add());
        update();
    }
    ecs::Entity add() {
        ++count;
        return world.add_mesh(kBox, {3.0 * count, 0, 0}, count % 2 == 0);
    }
    const InstanceItem* item_of(ecs::Entity e) const {
        for (const InstanceItem& item : snapshot.instances)
            if (item.entity == e) return &item;
        return nullptr;
    }
    std::uint64_t version_of(ecs::Entity e) const { return item_of(e)->version; }
    void expect_distinct_slots(const std::string& what) const {
        std::set<std::uint32_t> slots;
        for (const InstanceItem& item : snapshot.instances) {
            EXPECT_TRUE(slots.insert(item.gpu_slot).second) << what << ": slot " << item.gpu_slot;
            EXPECT_LT(item.gpu_slot, snapshot.gpu_slot_count) << what;
        }
    }
    TestWorld::Stage stage;
    std::vector<ecs::Entity> boxes;
    int count = 0;
};

TEST_F(ComeAndGo, AreAStepFromTheListBeforeUnlessAnotherChangedWhatItCasts) {
    std::uint64_t before = snapshot.list_version;
    const auto led_there = [&] {
        update();
        return snapshot.list_splice.leads(std::exchange(before, snapshot.list_version), snapshot.list_version);
    };
    add();
    EXPECT_TRUE(led_there());
    world.registry.destroy(boxes[5]);
    EXPECT_TRUE(led_there());
    add();
    world.registry.remove<ShadowCaster>(boxes[1]);
    EXPECT_FALSE(led_there());
    add();
    EXPECT_TRUE(led_there()) << "the next step is one again";
    for (int i = 0; i < kBoxes; ++i) add();
    EXPECT_FALSE(led_there()) << "so many that the list was made again";
}

TEST_F(ComeAndGo, OneThatComesIsTheOnlyOneThatChanged) {
    const std::vector<std::uint64_t> versions = instance_versions();
    const ecs::Entity added = add();
    update();
    EXPECT_EQ(version_of(added), snapshot.version);
    EXPECT_EQ(snapshot.list_version, snapshot.version);
    ASSERT_EQ(snapshot.changed_instances.size(), 1u);
    EXPECT_EQ(snapshot.instances[snapshot.changed_instances[0]].entity, added);
    EXPECT_EQ(version_of(boxes[7]), versions[9]) << "two of the stage are before them";
    expect_as_if_made_anew("one more");
}

TEST_F(ComeAndGo, OneThatGoesChangesNoOther) {
    const std::uint64_t before = version_of(boxes[399]);
    const std::uint32_t slot = item_of(boxes[399])->gpu_slot, freed = item_of(boxes[5])->gpu_slot;
    world.registry.destroy(boxes[5]);
    update();
    EXPECT_THAT(snapshot.changed_instances, IsEmpty());
    EXPECT_EQ(version_of(boxes[399]), before);
    EXPECT_EQ(item_of(boxes[399])->gpu_slot, slot);
    EXPECT_EQ(item_of(boxes[5]), nullptr);
    expect_as_if_made_anew("one less");
    const ecs::Entity next = add();
    update();
    EXPECT_EQ(next.index, boxes[5].index) << "the registry gives the index again";
    EXPECT_EQ(item_of(next)->gpu_slot, freed) << "the lowest free one";
    expect_as_if_made_anew("one in its place");
}

TEST_F(ComeAndGo, ADeadOneAndAnotherOfItsIndexInOneFrameAreTwo) {
    world.registry.patch<MeshRef>(boxes[9], [](MeshRef& ref) { ref.visible = false; });
    world.registry.patch<ShadowCaster>(boxes[9], [](ShadowCaster& caster) { caster.layers = 2; });
    world.move(boxes[9], {1, 2, 3});
    world.registry.destroy(boxes[9]);
    const ecs::Entity next = add();
    ASSERT_EQ(next.index, boxes[9].index);
    update();
    EXPECT_EQ(item_of(boxes[9]), nullptr);
    EXPECT_EQ(version_of(next), snapshot.version);
    expect_as_if_made_anew("another of the index");
}

TEST_F(ComeAndGo, AMeshThatIsExchangedOrAPlaceThatIsLostIsTakenInPlace) {
    ecs::Registry& r = world.registry;
    r.patch<MeshRef>(boxes[3], [](MeshRef& ref) { ref.mesh = kMaskedBox; });
    world.move(boxes[300], {0, 5, 0});
    update();
    EXPECT_EQ(item_of(boxes[3])->mesh, kMaskedBox);
    EXPECT_EQ(snapshot.changed_instances.size(), 2u);
    expect_as_if_made_anew("another mesh, and one that moved");
    r.remove<MeshRef>(boxes[3]);
    update();
    EXPECT_EQ(item_of(boxes[3]), nullptr);
    EXPECT_THAT(snapshot.changed_instances, IsEmpty());
    r.emplace<MeshRef>(boxes[3], {kBox});
    update();
    EXPECT_EQ(item_of(boxes[3])->mesh, kBox);
    expect_as_if_made_anew("a mesh again");
}

TEST_F(ComeAndGo, OneWithoutAPlaceIsNamedAndComesBack) {
    world.registry.patch<MeshRef>(boxes[3], [](MeshRef& ref) { ref.mesh = 999; });
    update();
    ASSERT_EQ(snapshot.dropped.size(), 1u);
    EXPECT_EQ(snapshot.dropped[0].entity, boxes[3]);
    const ecs::Entity other = add();
    update();
    EXPECT_EQ(snapshot.dropped.size(), 1u) << "another's coming does not mend it";
    EXPECT_NE(item_of(other), nullptr);
    expect_as_if_made_anew("one is dropped");
    world.registry.destroy(boxes[3]);
    update();
    EXPECT_THAT(snapshot.dropped, IsEmpty());
    expect_as_if_made_anew("it is gone");
}

TEST_F(ComeAndGo, AnEntityWithoutAMeshComesAndGoesUnnoticed) {
    const std::uint64_t version = snapshot.version;
    const ecs::Entity node = world.registry.create();
    world.registry.emplace<Transform>(node);
    update();
    world.registry.destroy(node);
    update();
    EXPECT_EQ(snapshot.version, version);
    add();
    update();
    EXPECT_GT(snapshot.version, version) << "the control";
}

TEST_F(ComeAndGo, ALightGetsItsPlaceLaterAndIsListed) {
    const ecs::Entity lamp = world.registry.create();
    world.registry.emplace<Light>(lamp);
    update();
    EXPECT_THAT(snapshot.lights, IsEmpty());
    world.registry.emplace<Transform>(lamp);
    update();
    EXPECT_EQ(snapshot.lights.size(), 1u);
    expect_as_if_made_anew("a lamp with a place");
}

TEST_F(ComeAndGo, AnythingInAnyOrderGivesTheSnapshotOfTheSameWorld) {
    std::mt19937_64 random(print_seed());
    const auto below = [&](std::size_t bound) {
        return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
    };
    ecs::Registry& r = world.registry;
    for (int round = 0; round < 150; ++round) {
        std::vector<std::pair<ecs::Entity, std::uint64_t>> untouched;
        for (const ecs::Entity e : boxes)
            if (item_of(e)) untouched.emplace_back(e, version_of(e));
        std::set<std::uint32_t> touched;
        const auto any = [&] {
            const ecs::Entity e = boxes[below(boxes.size())];
            touched.insert(e.index);
            return e;
        };
        for (std::size_t k = below(12) + 1; k > 0; --k) {
            const ecs::Entity e = any();
            switch (below(7)) {
                case 0:
                case 1:
                    r.destroy(e);
                    std::erase(boxes, e);
                    break;
                case 2:
                case 3:
                    touched.insert(boxes.emplace_back(add()).index);
                    break;
                case 4:
                    world.move(e, {static_cast<double>(below(100)), 1, 2});
                    break;
                case 5:
                    if (r.has<MeshRef>(e))
                        r.remove<MeshRef>(e);
                    else
                        r.emplace<MeshRef>(e, {kBox});
                    break;
                case 6:
                    if (r.has<MeshRef>(e))
                        r.patch<MeshRef>(e, [&](MeshRef& ref) { ref.mesh = below(2) ? kBox : kMaskedBox; });
                    break;
            }
        }
        update();
        const std::string what = "round " + std::to_string(round);
        expect_as_if_made_anew(what);
        expect_distinct_slots(what);
        for (const auto& [e, version] : untouched)
            EXPECT_TRUE(touched.contains(e.index) || version_of(e) == version) << what;
        for (const std::uint32_t i : snapshot.changed_instances)
            EXPECT_TRUE(touched.contains(snapshot.instances[i].entity.index)) << what;
        if (HasFailure()) return;
    }
}

TEST_F(ComeAndGo, FewAllocateNothingOnceWarmWhereListsAnewDo) {
    const auto frame = [&](int changes) {
        for (int k = 0; k < changes; ++k) {
            world.registry.destroy(boxes.back());
            boxes.pop_back();
        }
        for (int k = 0; k < changes; ++k) boxes.push_back(add());
        update();
    };
    const auto allocations_of = [&](int changes) {
        for (int i = 0; i < 300; ++i) frame(changes);
        const std::size_t before = allocation_count();
        for (int i = 0; i < 50; ++i) frame(changes);
        return allocation_count() - before;
    };
    EXPECT_EQ(allocations_of(2), 0u);
    EXPECT_GT(allocations_of(kBoxes / 2), 50u) << "the control: half of them make the list anew";
}

}  // namespace
}  // namespace gnomon
