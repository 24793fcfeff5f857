#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Returns a place's texture coordinates and reversed depth in a view's map, in the floats of a shader.
inline glm::dvec3 in_map(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p_ws - view.pose.anchor_ws_m), 1.0f);
    return glm::dvec3(q) / static_cast<double>(q.w);
}

}  // namespace gnomon::shadow
