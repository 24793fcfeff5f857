#include "systems/shadow/projection/light_frusta.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/projection/spot_cube_transition.h"

namespace gnomon::shadow {
namespace {

glm::dmat3 axes_of(const CubeFace& face) { return {face.axis_u, face.axis_v, face.axis_back}; }

/// Faces of a spot in the order of the layers: ahead along -Z, then the sides.
constexpr std::uint32_t kConeFaceOrder[kConeFaces] = {5, 0, 1, 2, 3};

/// Returns the part of a face that the cone can light. A direction at the angle a from the axis, with coordinate 1
/// across it, has cot(a) along it.
LightFrustum cone_in_face(const LightItem& light, std::uint32_t layer) {
    const CubeFace& face = cube_face(kConeFaceOrder[layer]);
    LightFrustum frustum;
    frustum.axes = light.rotation_ws * axes_of(face);
    frustum.layer = frustum.held_as = layer;
    if (layer == 0) return frustum;
    const double least = std::clamp(1.0 / std::tan(light.outer_cone_rad), 0.0, 0.5);
    const glm::dvec3 ahead(0.0, 0.0, -1.0);
    const glm::dvec2 along(glm::dot(face.axis_u, ahead), glm::dot(face.axis_v, ahead));
    for (int axis = 0; axis < 2; ++axis) {
        if (along[axis] > 0.0) frustum.low[axis] = least;
        if (along[axis] < 0.0) frustum.high[axis] = -least;
    }
    return frustum;
}

}  // namespace

void add_spot_frusta(const LightItem& light, const ShadowRequest& request, LightFrusta& frusta) {
    const int cube_blend_eighths = request.projection.cube_blend_eighths;
    if (has_faces(cube_blend_eighths))
        for (std::uint32_t layer = 0; layer < kConeFaces; ++layer)
            frusta.items[frusta.count++] = cone_in_face(light, layer);
    if (!has_single_view(cube_blend_eighths)) return;
    const double tan_half = std::tan(std::min(light.outer_cone_rad, kWidestMap_rad));
    frusta.items[frusta.count++] = {light.rotation_ws, glm::dvec2(-tan_half), glm::dvec2(tan_half),
                                    has_faces(cube_blend_eighths) ? kSingleView : 0, kSingleView};
}

void add_cube_frusta(const LightItem&, const ShadowRequest& request, LightFrusta& frusta) {
    // A receiver in one face may be filtered with texels of the next.
    const auto reach_texel = static_cast<double>(request.map.filtering.border_texel);
    const TangentRectangle wide = with_border({}, request.map.resolution_px, reach_texel);
    const glm::dmat3 turn = glm::mat3_cast(cube_turn());
    for (std::uint32_t face = 0; face < 6; ++face)
        frusta.items[frusta.count++] = {turn * axes_of(cube_face(face)), wide.low, wide.high, face, face};
}

}  // namespace gnomon::shadow
