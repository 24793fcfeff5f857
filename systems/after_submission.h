#pragma once
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/lighting/lighting_system.h"
#include "systems/shadow/shadow_system.h"

namespace gnomon {

/// Systems that recorded a frame's commands, and their scene.
struct FrameParts {
    gl::Device& device;
    const SceneSnapshot& scene;
    GpuScene& gpu;
    shadow::ShadowSystem& shadows;
    lighting::LightingSystem* lighting = nullptr;  // null: another renderer lights the scene
};

/// Reports the submission's result to these systems. Maps and kept visibility become valid, and failed uploads are
/// repeated. A failure is added to the report. `learn_costs`: a budget in milliseconds adapts to this device.
void commit_submission(const FrameParts& parts, const gl::SubmitResult& result, bool learn_costs, FrameReport& report);
/// Gives measured times to these systems, which learn from them.
void learn_times(const FrameParts& parts, std::span<const gl::Timing> timings, bool learn_costs);

/// Does both; call it once after each submission. Returns the times that arrived, from this or earlier submissions.
std::vector<gl::Timing> after_submission(const FrameParts& parts, const gl::SubmitResult& result, bool learn_costs,
                                         FrameReport& report);

}  // namespace gnomon
