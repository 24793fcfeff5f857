#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "systems/shadow/maps/map_cache.h"

namespace gnomon::shadow {
namespace {

struct Input {
    ShadowView view;
    std::uint32_t size_px = 512;
    SceneSnapshot scene;
    std::vector<std::uint32_t> casters{0, 1, 2}, meshes;
    CasterFaces faces = CasterFaces::automatic;
    Input() {
        for (std::uint32_t i = 0; i < 4; ++i) {
            InstanceItem item;
            item.gpu_slot = i;
            item.version = 7;
            scene.instances.push_back(item);
        }
    }
    std::uint64_t signature() const { return content_signature(view, size_px, scene, casters, meshes, faces).all; }
};

TEST(ContentSignature, IsTheSameForTheSameAndNeverZero) {
    EXPECT_EQ(Input().signature(), Input().signature());
    EXPECT_NE(Input().signature(), 0u);
    Input none;
    none.casters.clear();
    EXPECT_NE(none.signature(), 0u);
}

TEST(ContentSignature, EveryThingThatDecidesThePictureChangesIt) {
    std::vector<std::function<void(Input&)>> edits = {
        [](Input& i) { i.size_px = 513; },
        [](Input& i) {
            i.casters = {0, 1};
        },
        [](Input& i) {
            i.meshes = {0, 0, 5};
        },
        [](Input& i) {
            i.meshes = {0, 5, 0};
        },
        [](Input& i) {
            i.casters = {0, 1, 3};
        },
        [](Input& i) {
            i.casters = {0, 1, 2, 3};
        },
        [](Input& i) { i.casters.clear(); },
        [](Input& i) { ++i.scene.instances[1].version; },
        [](Input& i) { i.scene.instances[1].gpu_slot = 9; },
        [](Input& i) { i.faces = CasterFaces::back; },
    };
    for (int k = 0; k < 3; ++k)
        edits.push_back([k](Input& i) { i.view.pose.anchor_ws_m[k] = 1e-12; });
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            edits.push_back([=](Input& i) { i.view.clip_from_anchor[column][row] += 1e-6f; });
    std::set<std::uint64_t> seen{Input().signature()};
    for (std::size_t k = 0; k < edits.size(); ++k) {
        Input input;
        edits[k](input);
        EXPECT_TRUE(seen.insert(input.signature()).second) << "edit " << k;
    }
}

TEST(ContentSignature, WhatDoesNotDecideThePictureLeavesIt) {
    Input input;
    input.scene.instances[3].version = 99;  // no caster of this view
    input.view.error.edge_px = 5.0;
    input.view.consumer_mask = 3;
    input.view.casters = {17, 3};
    EXPECT_EQ(input.signature(), Input().signature());
}

}  // namespace
}  // namespace gnomon::shadow
