#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/gl/commands.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/frame/drawn_views.h"

namespace gnomon::shadow {

/// Matches DepthViewBlock in shaders/shadow/passes/depth/depth_view_block.glsl (std140).
struct DepthViewRecord {
    glm::mat4 clip_from_anchor{1.0f};
    glm::vec4 anchor_high{0.0f}, anchor_low{0.0f};
};
static_assert(sizeof(DepthViewRecord) == 96);

/// What passes draw.
struct PassInputs {
    const SceneSnapshot& scene;
    const GpuScene& gpu;
    const DrawnViews& drawn;
};

/// What passes write: commands, counts, and the time that they take for each light.
struct PassOutputs {
    gl::CommandList& list;
    FrameReport& report;
    std::span<double> cpu_us;  // one per light, microseconds; empty: nobody counts
};

}  // namespace gnomon::shadow
