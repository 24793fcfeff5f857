#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/projection.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/range_override.h"

/// Point light: six 90-degree views of a cube map with common near and far.
namespace gnomon::shadow {

const CubeFace& cube_face(std::uint32_t face) {
    static const std::array<CubeFace, 6> kFaces = {{
        {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}},  // +X
        {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},    // -X
        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},    // +Y
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},    // -Y
        {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},   // +Z
        {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},   // -Z
    }};
    return kFaces[face % 6];
}

bool fit_point(const FitInput& input, std::vector<ShadowView>& views) {
    const LightItem& light = input.light;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    const auto include = [&](const math::Aabb& box) {
        nearest = std::min(nearest, math::distance(box, light.position_ws_m));
    };
    for (const std::uint32_t i : input.casters) include(input.scene.instances[i].bounds_ws);
    for (const std::uint32_t i : input.receivers) include(input.scene.instances[i].bounds_ws);
    for (const glm::dvec3& p_ws : input.receiver_points_ws)
        farthest = std::max(farthest, glm::distance(p_ws, light.position_ws_m));
    if (light.range_m > 0.0) farthest = std::min(farthest, light.range_m);
    // A face measures along its own axis: a point at distance r lies between r / sqrt(3) and r.
    const PerspectiveRange range = overridden(input.demand, perspective_range(nearest / std::sqrt(3.0), farthest));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;

    const glm::dmat4 projection = math::reversed_perspective(-1.0, 1.0, -1.0, 1.0, range.near_m, range.far_m);
    for (std::uint32_t face = 0; face < 6; ++face) {
        ShadowView view;
        view.projection = ViewProjection::cube_face;
        view.layer = face;
        view.anchor_ws_m = light.position_ws_m;
        view.axis_u = cube_face(face).axis_u;
        view.axis_v = cube_face(face).axis_v;
        view.axis_back = cube_face(face).axis_back;
        view.near_m = range.near_m;
        view.far_m = range.far_m;
        view.texel_u = view.texel_v = 2.0 / static_cast<double>(input.demand.resolution_px);
        view.depth_alpha = -range.near_m / (range.far_m - range.near_m);
        view.depth_beta = range.near_m * range.far_m / (range.far_m - range.near_m);
        const glm::dmat4 view_from_anchor(glm::transpose(glm::dmat3(view.axis_u, view.axis_v, view.axis_back)));
        view.clip_from_anchor = glm::mat4(projection * view_from_anchor);
        view.map_from_anchor = glm::mat4(math::texture_from_clip() * projection * view_from_anchor);
        views.push_back(view);
    }
    return true;
}

}  // namespace gnomon::shadow
