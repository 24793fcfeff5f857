#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/gl/handles.h"

namespace gnomon::shadow {

/// Draw of one caster into one view by the engine's own code (InstanceItem::drawable). It runs before the frame's list,
/// which draws the other casters over it.
struct EngineDraw {
    std::uint32_t instance = 0;  // index into SceneSnapshot::instances
    std::uint32_t light = 0;     // index into SceneSnapshot::lights
    gl::TargetHandle target{};
    std::uint32_t size_px = 0;
    bool clears = false;              // first draw into the target: it is cleared before
    std::uint32_t triangle_bits = 0;  // format of the map's triangles (TriangleReferences)
    glm::mat4 clip_from_anchor{1.0f};
    glm::dvec3 anchor_ws_m{0.0};
};

}  // namespace gnomon::shadow
