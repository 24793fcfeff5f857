#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "systems/transform/transform_system.h"
#include "tests/unit/allocation_counter.h"

namespace gnomon {
namespace {

constexpr int kEntities = 1000;

class TransformCost : public ::testing::Test {
protected:
    TransformCost() {
        for (int i = 0; i < kEntities; ++i) {
            const ecs::Entity e = registry_.create();
            Transform t;
            t.translation_m.x = i;
            if (i % 10 != 0) t.parent = entities_.back();
            registry_.emplace<Transform>(e, t);
            entities_.push_back(e);
        }
        system_.update(registry_);
        registry_.discard_changes();
    }
    void move(int i) {
        registry_.patch<Transform>(entities_[static_cast<std::size_t>(i)],
                                   [](Transform& t) { t.translation_m.y += 1.0; });
    }

    ecs::Registry registry_;
    TransformSystem system_;
    std::vector<ecs::Entity> entities_;
};

TEST_F(TransformCost, AnUnchangedSceneIsNotLookedAtNotWrittenAndAllocatesNothing) {
    ecs::ChangeCursor cursor;
    registry_.changes<WorldTransform>(cursor);
    const std::size_t before = allocation_count();
    for (int frame = 0; frame < 10; ++frame) {
        const TransformReport& report = system_.update(registry_);
        EXPECT_EQ(report.evaluated, 0u);
        EXPECT_EQ(report.changed, 0u);
        registry_.discard_changes();
    }
    EXPECT_EQ(allocation_count(), before);
    EXPECT_TRUE(registry_.changes<WorldTransform>(cursor).entries.empty());
}

TEST_F(TransformCost, TheCounterNoticesAnAllocation) {
    const std::size_t before = allocation_count();
    const auto owned = std::make_unique<int>(7);
    EXPECT_GT(allocation_count(), before) << *owned;
}

TEST_F(TransformCost, WorkFollowsTheChangedBranches) {
    move(25);  // the sixth of its chain of ten: four below it
    EXPECT_EQ(system_.update(registry_).evaluated, 5u);
    registry_.discard_changes();
    move(30);
    move(31);  // within the branch of 30: counted once
    move(49);  // the end of a chain
    EXPECT_EQ(system_.update(registry_).evaluated, 11u);
}

TEST_F(TransformCost, WritingTheSameValueAgainChangesNothing) {
    ecs::ChangeCursor cursor;
    registry_.changes<WorldTransform>(cursor);
    registry_.patch<Transform>(entities_[0], [](Transform&) {});
    const TransformReport& report = system_.update(registry_);
    EXPECT_EQ(report.evaluated, 10u);
    EXPECT_EQ(report.changed, 0u);
    EXPECT_TRUE(registry_.changes<WorldTransform>(cursor).entries.empty());
}

TEST_F(TransformCost, ANegativeZeroIsAnotherValueThanZero) {
    registry_.patch<Transform>(entities_[999], [](Transform& t) { t.parent = ecs::kNull; });
    system_.update(registry_);
    registry_.patch<Transform>(entities_[999], [](Transform& t) { t.translation_m.z = -0.0; });
    EXPECT_EQ(system_.update(registry_).changed, 1u);
}

TEST_F(TransformCost, AMovingSceneAllocatesNothingOnceWarm) {
    const auto frame = [&] {
        for (int i = 0; i < kEntities; i += 10) move(i);
        const std::uint32_t changed = system_.update(registry_).changed;
        registry_.discard_changes();
        return changed;
    };
    frame();
    const std::size_t before = allocation_count();
    for (int i = 0; i < 5; ++i) EXPECT_EQ(frame(), static_cast<std::uint32_t>(kEntities));
    EXPECT_EQ(allocation_count(), before);
}

TEST(TransformDepth, AChainOfAHundredThousandIsEvaluatedOnceEachWithoutRecursion) {
    constexpr std::size_t kDepth = 100000;
    ecs::Registry registry;
    TransformSystem system;
    std::vector<ecs::Entity> chain;
    for (std::size_t i = 0; i < kDepth; ++i) chain.push_back(registry.create());
    for (std::size_t i = 0; i < kDepth; ++i) {  // deepest first: the worst order
        Transform t;
        t.translation_m.x = 1.0;
        if (i + 1 < kDepth) t.parent = chain[i + 1];
        registry.emplace<Transform>(chain[i], t);
    }
    const TransformReport& report = system.update(registry);
    EXPECT_EQ(report.evaluated, kDepth);
    EXPECT_EQ(registry.get<WorldTransform>(chain[0])->translation_ws_m.x, static_cast<double>(kDepth));
}

}  // namespace
}  // namespace gnomon
