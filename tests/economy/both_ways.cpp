#include "tests/economy/both_ways.h"

#include <gtest/gtest.h>

namespace gnomon {

BothWays::BothWays(gl::Device& device, const assets::MeshLibrary& library)
    : device_(device), library_(library), sides_{std::make_unique<Side>(device), std::make_unique<Side>(device)} {
    auto gpu = GpuScene::create(device, library);
    EXPECT_TRUE(gpu);
    if (gpu) gpu_ = std::make_unique<GpuScene>(std::move(gpu).value());
}

void BothWays::run(ecs::Registry& world, glm::uvec2 viewport_px, const std::function<void(const Picture&)>& look) {
    const TransformReport& transforms = transforms_.update(world);
    extractor_.update(world, library_, transforms, viewport_px, snapshot_);
    for (const DepthVariant way : {kThrifty, kLavish}) sides_[way]->scene = snapshot_;
    for (LightItem& light : sides_[kLavish]->scene.lights) light.tuning.reuse.economy = false;
    if (mislead) mislead(sides_[kThrifty]->scene);
    for (const DepthVariant way : {kThrifty, kLavish}) run_side(way, look);
}

void BothWays::run_side(DepthVariant way, const std::function<void(const Picture&)>& look) {
    Side& side = *sides_[way];
    side.commands.clear();
    side.report.clear();
    if (way == kThrifty) gpu_->update(snapshot_, side.commands);
    const shadow::ShadowFrame& frame = side.shadows.update(side.scene, *gpu_, {}, side.commands, side.report);
    if (frame.inputs.empty()) {
        EXPECT_EQ(device_.submit(side.commands).failure, gl::Failure::none);
    }
    shadow::LightingOutcome outcome;
    for (const shadow::LightingInputs& inputs : frame.inputs) {
        EXPECT_TRUE(side.lighting.record(inputs, side.scene, *gpu_, {}, side.commands, outcome));
        const gl::SubmitResult result = device_.submit(side.commands);
        EXPECT_EQ(result.failure, gl::Failure::none);
        look({way, inputs, side.commands});  // while all that the list names stands
        side.lighting.submitted(result.submission, true);
        side.commands.clear();
    }
    side.shadows.report(side.scene, outcome, side.report);
    side.shadows.commit(side.scene, true);
}

}  // namespace gnomon
