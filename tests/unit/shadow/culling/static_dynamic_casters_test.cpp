#include "systems/shadow/culling/static_dynamic_casters.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

constexpr std::uint64_t kStill = DynamicCasters::kStaticFrames;

class CasterMotionTest : public ::testing::Test {
protected:
    CasterMotionTest() {
        scene.version = scene.list_version = 1;
        for (std::uint32_t i = 0; i < 200; ++i) add(i);
        motion.update(scene);
    }
    void add(std::uint32_t slot) {
        InstanceItem item;
        item.gpu_slot = slot;
        item.version = scene.version;
        scene.instances.push_back(item);
    }
    /// Runs one frame in which these instances change. Returns whether any instance changed its class.
    bool frame(const std::vector<std::uint32_t>& changed = {}) {
        scene.changed_instances = changed;
        if (!changed.empty()) ++scene.version;
        for (const std::uint32_t i : changed) scene.instances[i].version = scene.version;
        return motion.update(scene);
    }
    bool moving(std::uint32_t i) const { return moves(motion.moving(), scene.instances[i]); }

    SceneSnapshot scene;
    DynamicCasters motion;
};

TEST_F(CasterMotionTest, WhatWasThereFromTheStartStandsStill) {
    EXPECT_FALSE(frame());
    EXPECT_TRUE(motion.moving().empty());
}

TEST_F(CasterMotionTest, WhatChangesMovesForSoManyFramesAndNoLonger) {
    EXPECT_TRUE(frame({70}));
    EXPECT_TRUE(moving(70));
    EXPECT_FALSE(moving(69));
    for (std::uint64_t i = 1; i < kStill; ++i) EXPECT_FALSE(frame()) << i;
    EXPECT_TRUE(moving(70));
    EXPECT_TRUE(frame());
    EXPECT_FALSE(moving(70));
    EXPECT_TRUE(motion.moving().empty());
    EXPECT_FALSE(frame());
}

TEST_F(CasterMotionTest, WhatGoesOnMovingChangesNothing) {
    frame({3});
    for (std::uint64_t i = 0; i < 4 * kStill; ++i) EXPECT_FALSE(frame({3}));
    for (std::uint64_t i = 1; i < kStill; ++i) EXPECT_FALSE(frame());
    EXPECT_TRUE(frame());
}

TEST_F(CasterMotionTest, EachRestsSoManyFramesAfterItsOwnLastChangeWhateverOthersDo) {
    frame({1, 2, 3});
    frame({2});
    frame({3, 1});
    frame({1});
    std::vector<std::uint64_t> rested(4, 0);
    for (std::uint64_t i = 1; i <= 2 * kStill; ++i) {
        frame({100});
        for (std::uint32_t k = 1; k <= 3; ++k)
            if (rested[k] == 0 && !moving(k)) rested[k] = i;
    }
    EXPECT_EQ(rested, (std::vector<std::uint64_t>{0, kStill, kStill - 2, kStill - 1}));
    EXPECT_TRUE(moving(100));
}

TEST_F(CasterMotionTest, WhatAppearsLaterMovesAtFirst) {
    ++scene.version;
    add(200);
    scene.list_version = scene.version;
    scene.changed_instances = {200};
    EXPECT_TRUE(motion.update(scene));
    EXPECT_TRUE(moving(200));
    EXPECT_FALSE(moving(199));
}

TEST_F(CasterMotionTest, WhatAppearsUnnamedIsFoundWhereTheVersionSaysSo) {
    scene.version += 2;
    add(200);
    scene.list_version = scene.version;
    scene.changed_instances = {};
    EXPECT_TRUE(motion.update(scene));
    EXPECT_TRUE(moving(200));
}

TEST_F(CasterMotionTest, AMissedFrameLosesNothing) {
    for (const std::uint32_t i : {5u, 6u}) scene.instances[i].version = ++scene.version;
    scene.changed_instances = {6};
    EXPECT_TRUE(motion.update(scene));
    EXPECT_TRUE(moving(5));
    EXPECT_TRUE(moving(6));
    EXPECT_FALSE(moving(7));
}

TEST_F(CasterMotionTest, AChangeThatMapsDoNotShowIsNone) {
    ++scene.version;
    scene.changed_instances = {9};  // listed for upload; its version is as it was
    EXPECT_FALSE(motion.update(scene));
    EXPECT_FALSE(moving(9));
}

}  // namespace
}  // namespace gnomon::shadow
