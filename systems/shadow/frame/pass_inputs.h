#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/gl/commands.h"
#include "gnomon/frame.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"

namespace gnomon::shadow {

/// Matches DepthViewBlock in shaders/shadow/passes/depth/depth_view_block.glsl (std140).
struct DepthViewRecord {
    glm::mat4 clip_from_anchor{1.0f};
    glm::vec4 anchor_high{0.0f}, anchor_low{0.0f};
};
static_assert(sizeof(DepthViewRecord) == 96);

/// Read by the passes.
struct PassInputs {
    const SceneSnapshot& scene;
    const GpuScene& gpu;
    const DrawnViews& drawn;
};

/// Written by the passes: commands, counts, and CPU time per light.
struct PassOutputs {
    gl::CommandList& list;
    FrameReport& report;
    std::span<double> cpu_us;  // one per light, microseconds; empty: lights are not timed
};

}  // namespace gnomon::shadow
