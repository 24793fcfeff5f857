#pragma once
#include <utility>

#include "systems/after_submission.h"

using namespace gnomon;

// [frame]
/// One frame: what systems/frame.cpp does, without a registry.
class OwnFrame {
public:
    OwnFrame(gl::Device& device, GpuScene scene)
        : device_(device), gpu_scene_(std::move(scene)), shadows_(device), lighting_(device) {
        feedback_.spare = &lighting_.spare();  // what only saves time makes room for maps
    }

    bool run(SceneSnapshot& scene) {
        constexpr float kExposure_ev = 14.0f;
        commands_.clear();
        report.clear();
        outcome_.clear();
        lighting_.collect_depths(feedback_.sampled_depths);
        gpu_scene_.update(scene, commands_);
        feedback_.exposure = lighting::exposure_scale(kExposure_ev);  // so that lights too dim to be seen cast nothing
        const shadow::ShadowFrame& frame = shadows_.update(scene, gpu_scene_, {.feedback = feedback_}, commands_, report);
        const bool sample_depths = shadows_.wants_sampled_depths(scene);
        if (!sample_depths) feedback_.sampled_depths = {};
        const bool lit = lighting_.record(
            frame.inputs.front(), scene, gpu_scene_,
            {.exposure_ev = kExposure_ev, .sample_depths = sample_depths, .most_kept_bytes = shadows_.maps().room()},
            commands_, outcome_);
        shadows_.report(scene, outcome_, report);
        const gl::SubmitResult result = device_.submit(commands_);
        after_submission({device_, scene, gpu_scene_, shadows_, &lighting_}, result, false, report);
        return lit && result.failure == gl::Failure::none;
    }
    FrameReport report;
    gl::TextureHandle picture() const { return lighting_.picture_texture(); }
    const gl::CommandList& commands() const { return commands_; }  // of the last frame

private:
    gl::Device& device_;
    GpuScene gpu_scene_;
    shadow::ShadowSystem shadows_;
    lighting::LightingSystem lighting_;
    shadow::LightingFeedback feedback_;  // from one frame's lighting to the next one's shadows
    shadow::LightingOutcome outcome_;    // what became of lights in the frame's picture
    gl::CommandList commands_;
};
// [frame]
