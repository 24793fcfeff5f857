#pragma once
#include <algorithm>
#include <span>

#include "bench/glsl_on_cpu/samplers.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/frame/shadow_frame.h"

/// Values of a published light, for a row of shader_structs.inc.
namespace gnomon::bench::glsl {

inline vec3 to_vec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline vec4 to_vec4(const glm::vec4& v) {
    const glm::dvec4 d(v);
    return {d.x, d.y, d.z, d.w};
}
inline ivec4 to_ivec4(const glm::ivec4& v) { return {v.x, v.y, v.z, v.w}; }

template <class Record>
void set_view(const shadow::ViewRecord& from, const shadow::ShadowView& view, const glm::dvec3& camera_ws_m, Record& to,
              DepthScale& scale) {
    for (int c = 0; c < 4; ++c) to.map_from_anchor[c] = to_vec4(from.map_from_anchor[c]);
    to.axis_u = to_vec4(from.axis_u);
    to.axis_v = to_vec4(from.axis_v);
    to.axis_back = to_vec4(from.axis_back);
    to.numeric = to_vec4(from.numeric);
    to.anchor_from_camera =
        vec4(to_vec3(camera_ws_m - view.pose.anchor_ws_m), static_cast<double>(from.anchor_from_camera.w));
    scale.perspective = view.projection != shadow::ViewProjection::orthographic;
    scale.texel_tan = std::max(view.plane.texel_u, view.plane.texel_v);
    scale.alpha = view.depth.alpha;
    scale.texels_per_depth = (view.depth.far_m - view.depth.near_m) / std::max(view.plane.texel_u, view.plane.texel_v);
}

/// Fills the row's light block. `views`: the light's views in the order in which they were published. A cube's samplers
/// take the scale of the first.
template <class Row>
void set_light(const shadow::LightingLight& published, std::span<const shadow::ShadowView* const> views,
               const glm::dvec3& camera_ws_m, Row& row) {
    const shadow::LightRecord& record = published.record;
    row.reach = static_cast<double>(published.row.reach_texel);
    row.light.position = to_vec4(record.position);
    row.light.to_light = to_vec4(record.to_light);
    row.light.radiance = to_vec4(record.radiance);
    row.light.cone = to_vec4(record.cone);
    row.light.options = to_ivec4(record.options);
    row.light.bias = to_vec4(record.bias);
    row.light.filtering = to_ivec4(record.filtering);
    row.light.spread = to_vec4(record.spread);
    row.light.seed_cell = to_ivec4(record.seed_cell);
    row.light.seed_place = to_vec4(record.seed_place);
    row.light.low = to_vec4(record.low);
    DepthScale(&scales)[shadow::kMaxViews] = row.shadow_map.scales;
    for (std::size_t i = 0; i < views.size() && i < shadow::kMaxViews; ++i)
        set_view(record.views[i], *views[i], camera_ws_m, row.light.views[i], scales[views[i]->layer]);
    if (!views.empty() && views.front()->projection == shadow::ViewProjection::cube_face)
        scales[0] = scales[views.front()->layer];
}

/// Row that reads the casters' own corners.
template <class Row>
concept ReadsTriangles = requires(Row row) {
    row.caster_triangles;
};

/// Fills the row's casters with their places in double, not with those of the records' floats: points are as exact.
template <ReadsTriangles Row>
void set_casters(std::span<const InstanceItem> instances, const CasterTriangleList& casters,
                 const glm::dvec3& camera_ws_m, Row& row) {
    using Instance = typename decltype(row.instances)::Element;
    using Triangle = typename decltype(row.caster_triangles)::Element;
    auto records = std::make_shared<std::vector<Instance>>();
    for (const InstanceItem& item : instances) {
        if (item.gpu_slot >= records->size()) records->resize(item.gpu_slot + std::size_t{1});
        const glm::dvec3& t = item.translation_ws_m;
        (*records)[item.gpu_slot] = {vec4(to_vec3(item.basis[0]), t.x), vec4(to_vec3(item.basis[1]), t.y),
                                     vec4(to_vec3(item.basis[2]), t.z), vec4()};
    }
    auto corners = std::make_shared<std::vector<Triangle>>();
    corners->reserve(casters.triangles.size());
    for (const CasterTriangle& t : casters.triangles) {
        const auto& [a, b, c] = t.corners;
        corners->push_back(
            {to_vec3(a.position_ms), a.across, to_vec3(b.position_ms), b.across, to_vec3(c.position_ms), c.across});
    }
    row.instances.elements = std::move(records);
    row.caster_triangles.elements = std::move(corners);
    row.ray_masks.elements = std::make_shared<std::vector<uint>>(casters.masks);
    row.camera.anchor_high = vec4(to_vec3(camera_ws_m), 0.0);
    row.camera.anchor_low = vec4();
}

/// Sets the map that the row's samplers read, and the trace that they write.
template <class Row>
void set_map(const MapTexels& map, Trace& trace, Row& row) {
    row.shadow_map.map = &map;
    row.shadow_map.trace = &trace;
    if constexpr (ReadsTriangles<Row>) {
        row.shadow_triangles.map = &map;
        row.shadow_triangles.trace = &trace;
    }
}

}  // namespace gnomon::bench::glsl
