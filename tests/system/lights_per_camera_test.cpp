#include <gtest/gtest.h>

#include <algorithm>

#include "engine/gl/device_recording.h"
#include "tests/economy/both_ways.h"
#include "tests/system/passes.h"
#include "tests/system/test_world.h"

/// Which camera's picture a light takes part in, and which of its views are looked up for it.
namespace gnomon {
namespace {

class LightsPerCamera : public ::testing::Test {
protected:
    void TearDown() override {
        both.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    /// Runs a frame. Records the inputs of each camera's lighting, and the groups of its passes.
    void step() {
        inputs.clear();
        groups.clear();
        if (!both) both = std::make_unique<BothWays>(device, library);
        both->run(world.registry, {96, 64}, [&](const BothWays::Picture& picture) {
            if (picture.way != BothWays::kThrifty) return;
            inputs.push_back(picture.inputs);
            std::vector<std::string>& names = groups.emplace_back();
            for (const Pass& pass : passes_of(picture.commands, device))
                if (!pass.is_depth) names.push_back(pass.group);
        });
    }
    bool has_pass(std::size_t camera, const std::string& light) const {
        return std::count(groups[camera].begin(), groups[camera].end(), light) > 0;
    }
    int faces(std::size_t camera, std::size_t light) const { return inputs[camera].lights[light].record.options.w; }
    ecs::Entity add_lamp(const glm::dvec3& at_m, float range_m) {
        const ecs::Entity lamp = world.add_light(LightKind::point, at_m, "lamp");
        world.registry.patch<Light>(lamp, [range_m](Light& l) { l.range_m = range_m; });
        return lamp;
    }

    gl::RecordingDevice device;
    const assets::MeshLibrary library = test_library();
    TestWorld world;
    std::unique_ptr<BothWays> both;
    std::vector<shadow::LightingInputs> inputs;
    std::vector<std::vector<std::string>> groups;
};

TEST_F(LightsPerCamera, ALampWhoseSurroundingsAreEmptyHasNoPass) {
    world.add_stage();
    const ecs::Entity lamp = add_lamp({0, 5, 0}, 1.0f);
    step();
    EXPECT_FALSE(has_pass(0, "lamp"));
    world.move(lamp, {0, 1.8, 0});
    step();
    EXPECT_TRUE(has_pass(0, "lamp")) << "the box is in its range";
}

TEST_F(LightsPerCamera, WhatIsLitButNotSeenGivesNoPass) {
    world.add_mesh(kPlane, {0, 0, 0}, false);
    world.add_mesh(kBox, {0, 1, 0}, true);
    world.add_camera({0, 4, 8}, {0, 4, 100});  // looks away
    world.add_camera({0, 4, 8}, {0, 0, 0});
    add_lamp({0, 2, 0}, 4.0f);
    step();
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_FALSE(has_pass(0, "lamp"));
    EXPECT_TRUE(has_pass(1, "lamp"));
    EXPECT_TRUE(inputs[0].lights[0].row.filter_file.empty()) << "no lookups, no program with them";
    EXPECT_FALSE(inputs[1].lights[0].row.filter_file.empty());
}

TEST_F(LightsPerCamera, EachLooksUpTheViewsThatItsOwnReceiversLieIn) {
    // Two boxes to either side of a lamp, ground below each, a camera to each side.
    for (const double x : {-1.0, 1.0}) {
        world.add_mesh(kBox, {2.0 * x, 2.0, 0}, true);
        world.add_mesh(kBox, {5.0 * x, 2.0, 0}, false);
        world.add_camera({5.0 * x, 2.0, 4.0}, {5.0 * x, 2.0, 0});
    }
    add_lamp({0, 2, 0}, 20.0f);
    step();
    ASSERT_EQ(inputs.size(), 2u);
    int drawn = 0;
    for (const shadow::ShadowView& view : both->frame(BothWays::kThrifty).fitted.views) drawn |= 1 << view.layer;
    EXPECT_EQ(faces(0, 0) | faces(1, 0), drawn) << "what is drawn, somebody looks up";
    EXPECT_NE(faces(0, 0), 0);
    EXPECT_NE(faces(1, 0), 0);
    EXPECT_NE(faces(0, 0), faces(1, 0));
    EXPECT_LT(inputs[0].lights[0].record.options.x, static_cast<int>(both->frame(BothWays::kThrifty).fitted.views.size()));
}

}  // namespace
}  // namespace gnomon
