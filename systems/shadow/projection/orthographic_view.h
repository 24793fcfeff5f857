#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Box of an orthographic map. Coordinates are metres from the anchor along the axes; depth increases along -axes[2].
struct OrthographicBox {
    glm::dvec3 anchor_ws_m{0.0};
    glm::dmat3 axes{1.0};  // columns: the map's u, its v, toward the light; orthonormal
    glm::dvec2 centre_m{0.0}, half_extent_m{0.0};
    double near_m = 0.0, far_m = 0.0;
};

/// Returns the view of the box in a square map of size_px. Half extents must be > 0, near < far, all finite.
ShadowView orthographic_view(const OrthographicBox& box, double size_px);

}  // namespace gnomon::shadow
