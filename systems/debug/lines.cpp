#include "systems/debug/lines.h"

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "systems/debug/shown_scale.h"

namespace gnomon::debug {

Corners corners_of(const math::Aabb& box) {
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) corners[i][axis] = (i >> axis & 1) != 0 ? box.max[axis] : box.min[axis];
    return corners;
}

Corners corners_of(const shadow::ShadowView& view) {
    const glm::dmat4 anchor_from_clip = glm::inverse(glm::dmat4(view.clip_from_anchor));
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec4 clip((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : 0.0, 1.0);
        const glm::dvec4 corner = anchor_from_clip * clip;
        corners[i] = view.pose.anchor_ws_m + glm::dvec3(corner) / corner.w;
    }
    return corners;
}

void LineDrawing::add(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m, const glm::vec3& srgb) {
    for (const glm::dvec3& end : {from_ws_m, to_ws_m})
        vertices_.push_back({glm::vec4(glm::vec3(end - eye_ws_m_), 1.0f), scale_colour(srgb, 1.0f)});
}

void LineDrawing::add(const Corners& corners, const glm::vec3& srgb) {
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t bit = 1; bit < corners.size(); bit *= 2)
            if ((i & bit) == 0) add(corners[i], corners[i | bit], srgb);
}

}  // namespace gnomon::debug
