#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/lighting/lighting_system.h"
#include "systems/report.h"
#include "systems/shadow/shadow_system.h"

namespace gnomon {

/// Who recorded a frame's commands, and of what scene.
struct FrameParts {
    gl::Device& device;
    const SceneSnapshot& scene;
    GpuScene& gpu;
    shadow::ShadowSystem& shadows;
    lighting::LightingSystem* lighting = nullptr;  // null: somebody else's
};

/// Tells them what became of those, once after each submission: maps and kept visibility hold what was drawn, uploads
/// of a list that failed are made again, and times that were measured go to who learns from them. A failure goes into
/// the report. `learn_costs`: a budget in milliseconds follows what this device takes. Returns the times that came in,
/// of this submission or of earlier ones.
std::vector<gl::Timing> after_submission(const FrameParts& parts, const gl::SubmitResult& result, bool learn_costs,
                                         FrameReport& report);

}  // namespace gnomon
