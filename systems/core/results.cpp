#include "systems/core/results.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "engine/core/signature.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/depth_rounding.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::core {
namespace {

using shadow::ShadowView;

// shaders/common/float_rounding.glsl and bias/automatic.glsl have the same.
constexpr double kUnitRoundoff = 0x1p-24, kRasterSnap_texel = 1.0 / 256.0, kRelativeRounding = 7.0 * kUnitRoundoff;

struct StatusRow {
    Reason reason;
    Status status;
};
/// What the stages report of a light without a map, and of one with less than was wanted.
constexpr StatusRow kSkips[] = {{Reason::shadows_off, Status::off},
                                {Reason::no_visible_receiver, Status::no_visible_receiver},
                                {Reason::no_caster, Status::no_caster},
                                {Reason::fit_degenerate, Status::fit_degenerate}};
constexpr StatusRow kNotes[] = {{Reason::resolution_clamped, Status::resolution_clamped},
                                {Reason::cascades_clamped, Status::cascades_clamped},
                                {Reason::splits_invalid, Status::splits_invalid},
                                {Reason::range_invalid, Status::range_invalid},
                                {Reason::filter_cut, Status::filter_cut},
                                {Reason::depth_coarse, Status::depth_coarse}};

template <std::size_t Count>
Status status_of(const StatusRow (&rows)[Count], Reason reason, Status otherwise) {
    for (const StatusRow& row : rows)
        if (row.reason == reason) return row.status;
    return otherwise;
}

Range range_of(shadow::IndexRange range) { return {range.first, range.count}; }

/// Replaces row r of the matrix by `sign` times itself plus `share` of its last row.
void change_row(glm::dmat4& m, int r, double sign, double share) {
    for (int c = 0; c < 4; ++c) m[c][r] = sign * m[c][r] + share * m[c][3];
}

bool is_cube(const ShadowView& view) { return view.projection == shadow::ViewProjection::cube_face; }

/// Turns Gnomon's own clip space (OpenGL's, depth reversed, 0 to w) into the convention's. Maps are drawn upright.
/// Faces of a cube keep the order of rows that lookups of cubes have on every API, which mirrors them where rows go
/// down.
glm::dmat4 clip_in(const Convention& to, const ShadowView& view) {
    glm::dmat4 clip(view.clip_from_anchor);
    const bool flip = to.clip_y_down != (is_cube(view) && to.rows_down);
    if (flip) change_row(clip, 1, -1.0, 0.0);
    if (!to.reversed_depth) change_row(clip, 2, -1.0, 1.0);
    if (!to.zero_to_one) change_row(clip, 2, 2.0, -1.0);
    return clip;
}

glm::dmat4 map_in(const Convention& to, const ShadowView& view) {
    glm::dmat4 map(view.map_from_anchor);
    if (to.rows_down && !is_cube(view)) change_row(map, 1, -1.0, 1.0);
    if (!to.reversed_depth) change_row(map, 2, -1.0, 1.0);
    return map;
}

/// Returns the matrix from world space, of one from a view's anchor: the same rounded numbers, so that both find the
/// same texels.
glm::dmat4 from_world(const glm::mat4& from_anchor, const glm::dvec3& anchor_ws_m) {
    glm::dmat4 m(from_anchor);
    m[3] = m * glm::dvec4(-anchor_ws_m, 1.0);
    return m;
}

/// Returns the least edge of a texel across the light, metres.
double finest_texel_m(const ShadowView& view) {
    const double texel = std::min(view.plane.texel_u, view.plane.texel_v);
    return shadow::is_parallel(view) ? texel : texel * view.depth.near_m;
}

Bias bias_of(const ShadowView& view, const shadow::ShadowRequest& request, bool reversed) {
    const shadow::FilterSettings& filter = request.map.filtering;
    const bool penumbra = shadow::needs_distances(filter);
    Bias bias;
    bias.texel = {view.plane.texel_u, view.plane.texel_v};
    bias.reach_texel = kRasterSnap_texel + (penumbra ? static_cast<double>(filter.reach_texel)
                                                     : shadow::reach_texel_at(filter, finest_texel_m(view)));
    const double step = shadow::depth_format_row(request.map.depth_format).step;
    bias.depth = step + shadow::projection_rounding(view, request.projection.aim.radius_m);
    if (shadow::is_parallel(view)) {
        // Floats near 1 are twice as coarse as half a quantum of reversed ones counts.
        if (!reversed) bias.depth += kUnitRoundoff;
    } else if (reversed) {
        bias.depth_share = kRelativeRounding;
    } else {
        // Depth up to 1, of a constant part up to 1 + |alpha|.
        bias.depth += kRelativeRounding + 2.0 * kUnitRoundoff;
    }
    return bias;
}

/// Returns the hash of what the map shows, apart from where its casters are.
std::uint64_t content_of(const View& view, std::uint32_t map_px, std::span<const std::uint32_t> casters) {
    Signature signature;
    signature.add(std::uint64_t{map_px} << 32 | view.layer);
    for (int i = 0; i < 16; ++i) signature.add(view.clip_from_anchor[i / 4][i % 4]);
    for (int i = 0; i < 3; ++i) signature.add(view.anchor_ws_m[i]);
    for (const std::uint32_t caster : casters) signature.add(std::uint64_t{caster});
    return signature.value();
}

View view_of(const StageResults& stages, const ShadowView& from, const Convention& convention) {
    const shadow::ShadowRequest& request = stages.fitted.lights[from.light].request;
    View view;
    view.light = from.light;
    view.layer = from.layer;
    view.kind = is_cube(from)               ? ViewKind::cube_face
                : shadow::is_parallel(from) ? ViewKind::orthographic
                                            : ViewKind::perspective;
    view.stays = from.stays;
    view.empty = from.lit;
    view.mirrored = is_cube(from) && convention.rows_down;
    view.anchor_ws_m = from.pose.anchor_ws_m;
    view.clip_from_anchor = glm::mat4(clip_in(convention, from));
    view.map_from_anchor = glm::mat4(map_in(convention, from));
    view.clip_from_world = from_world(view.clip_from_anchor, view.anchor_ws_m);
    view.map_from_world = from_world(view.map_from_anchor, view.anchor_ws_m);
    view.axis_u = from.pose.axis_u;
    view.axis_v = from.pose.axis_v;
    view.axis_back = from.pose.axis_back;
    view.eye_ws_m = shadow::apex_ws_m(from);
    view.near_m = from.depth.near_m;
    view.far_m = from.depth.far_m;
    view.from_m = from.cascade.seen_from_m;
    view.to_m = from.cascade.seen_to_m;
    view.fade_from_m = from.cascade.fades_from_m;
    view.fade_to_m = from.cascade.fades_to_m;
    view.texel_m = from.error.texel_m;
    view.edge_error_px = from.error.edge_px;
    view.resolved_px = shadow::accuracy_of(from).resolved_px;
    view.resolved_m = from.error.resolved_m;
    view.bias = bias_of(from, request, convention.reversed_depth);
    view.receivers = from.receivers;
    view.cameras = stages.input.camera_mask(from.consumer_mask);
    view.casters = range_of(from.casters);
    view.content = content_of(view, request.map.resolution_px, stages.fitted.casters_of(from));
    return view;
}

/// Returns true if floats hold the view's numbers: not in astronomic or atomic scenes.
bool fits_floats(const View& view) {
    double sum = view.edge_error_px;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            sum += std::abs(static_cast<double>(view.clip_from_anchor[c][r]));
            sum += std::abs(static_cast<double>(view.map_from_anchor[c][r]));
        }
    return std::isfinite(sum);
}

Status status_of(const StageResults& stages, std::uint32_t light) {
    const shadow::LightStatus& status = stages.statuses[light];
    const LightItem& item = stages.input.snapshot().lights[light];
    if (stages.input.is_unusable(light)) return Status::invalid_light;
    if (!item.shadow.enabled) return Status::off;
    if (stages.input.snapshot().consumers.empty()) return Status::no_camera;
    if (status.is_skipped()) return status_of(kSkips, status.skipped(), Status::fit_degenerate);
    return status_of(kNotes, status.degraded(), Status::fitted);
}

LightFit light_of(const StageResults& stages, std::uint32_t light) {
    const shadow::FitChoice& choice = stages.fitted.lights[light];
    const shadow::ShadowRequest& request = choice.request;
    const LightItem& item = stages.input.snapshot().lights[light];
    LightFit fit;
    fit.status = status_of(stages, light);
    if (!has_maps(fit.status)) return fit;
    fit.receivers = range_of(choice.sets.receivers);
    fit.casters = range_of(choice.sets.casters);
    fit.map_px = request.map.resolution_px;
    fit.layers = request.map.view_count;
    fit.cube = shadow::map_texture(item, request) == gl::TextureKind::cube;
    if (fit.cube) fit.cube_from_world = glm::transpose(glm::mat3_cast(shadow::cube_turn()));
    for (const ShadowView& view : stages.fitted.views_of(light)) {
        if (view.lit) continue;
        const shadow::MapAccuracy maps = shadow::accuracy_of(view);
        fit.edge_error_px = std::max(fit.edge_error_px, maps.edge_px);
        fit.resolved_px = std::max(fit.resolved_px, maps.resolved_px);
        fit.resolved_m = std::max(fit.resolved_m, view.error.resolved_m);
    }
    fit.meets_target =
        shadow::meets_target(fit.edge_error_px, shadow::texel_target_px(item.shadow, request.map.filter));
    const bool has_target = shadow::targets_of(item.shadow) != shadow::AccuracyTargets{};
    if (fit.status == Status::fitted && !fit.meets_target && has_target) fit.status = Status::error_above_target;
    fit.blend = static_cast<double>(request.map.cascade_blend);
    fit.faces_share = request.projection.cube_blend_eighths / 8.0;
    return fit;
}

}  // namespace

void write_results(const StageResults& stages, const Convention& convention, std::vector<LightFit>& lights,
                   std::vector<View>& views) {
    lights.clear();
    views.clear();
    for (std::uint32_t i = 0; i < stages.fitted.lights.size(); ++i) {
        LightFit& fit = lights.emplace_back(light_of(stages, i));
        const auto first = static_cast<std::uint32_t>(views.size());
        for (const ShadowView& view : stages.fitted.views_of(i)) views.push_back(view_of(stages, view, convention));
        const auto made = std::span(views).subspan(first);
        if (!std::all_of(made.begin(), made.end(), fits_floats)) {
            views.resize(first);
            fit = {};
            fit.status = Status::fit_degenerate;
        }
        fit.views = {first, static_cast<std::uint32_t>(views.size()) - first};
    }
}

}  // namespace gnomon::core
