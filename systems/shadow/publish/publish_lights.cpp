#include "systems/shadow/publish/publish_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "engine/math/projection.h"
#include "engine/math/rounding.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/culling/lamp_places.h"
#include "systems/shadow/culling/lit_areas.h"
#include "systems/shadow/fitting/choose_proxies.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/depth_rounding.h"
#include "systems/shadow/publish/lookup_accuracy.h"
#include "systems/shadow/publish/noise_cell.h"
#include "systems/shadow/publish/visibility_hash.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Layer of a view without shadows (light_block.glsl).
constexpr float kNoLayer = -1.0f;

glm::vec4 with_w(const glm::dvec3& v, double w) { return {glm::vec3(v), static_cast<float>(w)}; }

/// Returns the distance by which receivers keep off what the view shows. Above 0: how far casters may have moved.
/// Below: the view's proxy bound, which the shader cuts to what a receiver sees (light_block.glsl). A cube has one for
/// all faces. No stale map shows proxies (stale_error.cpp).
float kept_off_m(const DrawnViews& drawn, std::size_t v) {
    const ShadowView& view = drawn.view(v);
    double bound_m = view.error.proxy_m;
    if (view.projection == ViewProjection::cube_face)
        for (const ShadowView& face : drawn.fitted.views_of(view.light))
            bound_m = std::max(bound_m, face.error.proxy_m);
    return bound_m > 0.0 ? -math::at_least(bound_m) : math::at_least(drawn.updates[v].stale.moved_m);
}

ViewRecord view_record(const DrawnViews& drawn, std::size_t v, const ConsumerItem& consumer) {
    const ShadowView& view = drawn.view(v);
    const ShadowRequest& request = drawn.request_of(v);
    // A map that was shrunk has larger texels than the fit planned.
    const double stretch = static_cast<double>(request.map.resolution_px) / static_cast<double>(drawn.maps[v].size_px);
    const bool orthographic = is_parallel(view);
    ViewRecord record;
    record.map_from_anchor = view.map_from_anchor;
    record.axis_u = with_w(view.pose.axis_u, view.plane.texel_u * stretch);
    record.axis_v = with_w(view.pose.axis_v, view.plane.texel_v * stretch);
    record.axis_back =
        with_w(view.pose.axis_back, orthographic ? view.depth.far_m - view.depth.near_m : view.depth.beta);
    // OpenGL 4.5, 2.3.5: a fixed-point value is one of the two nearest, so that it may be off by a whole step.
    const double depth_rounding =
        depth_format_row(request.map.depth_format).step + projection_rounding(view, request.projection.aim.radius_m);
    record.numeric = {static_cast<float>(depth_rounding), kept_off_m(drawn, v),
                      static_cast<float>(orthographic ? view.cascade.fades_from_m : view.depth.alpha),
                      view.lit ? kNoLayer : static_cast<float>(view.layer)};
    record.anchor_from_camera = with_w(consumer.position_ws_m - view.pose.anchor_ws_m, view.cascade.fades_to_m);
    return record;
}

std::string_view kind_file(const ProjectionRequest& projection, const LightKindRow& kind) {
    if (projection.perspective_sun || projection.aim.used) return kPerspectiveFile;
    return projection.warp > 0.0f ? kWarpedSunFile : kind.file;
}

/// Sets the program and the textures of a light from one of its views with a map.
void set_lookup(const DrawnViews& drawn, std::size_t v, const LightKindRow& kind, const MapSamplers& samplers,
                LightingLight& out) {
    const ShadowRequest& request = drawn.request_of(v);
    const MapAssignment& map = drawn.maps[v];
    const FilterRow &filter = filter_row(request.map.filter), &one_tap = filter_row(kCheapestFilter);
    out.plain.row = {kind.define, kind_file(request.projection, kind), one_tap.file, one_tap.reach_texel};
    out.plain.map = map.texture;
    out.plain.sampler = samplers.of(one_tap.reading);
    out.row = out.plain.row;
    out.map = out.plain.map;
    out.sampler = out.plain.sampler;
    out.second = map.sheets.second;
    out.bounds = map.sheets.bounds;
    out.ends = map.sheets.ends;
    // A map of a light with rays serves one tap by itself, as does a map without its moments.
    if (map_filter(drawn, v) != request.map.filter) return;
    const bool moments = filter.moments != nullptr;
    out.row.filter_file = filter.file;
    out.row.reach_texel = request.map.filtering.reach_texel;
    out.row.depths = filter.reading == MapReading::depths;
    out.row.triangles = filter.storage.triangle_ids;
    out.row.moments = moments;
    out.row.footprint = request.map.moments.levels > 1 || request.map.moments.anisotropy > 1;
    out.row.fades = !request.projection.perspective_sun &&
                    (request.map.cascade_blend > 0.0f || request.projection.cube_blend_eighths % 8 != 0);
    out.triangles = map.triangles;
    out.map = moments ? map.prefiltered.moments : map.texture;
    out.sampler = moments ? samplers.of(request.map.moments) : samplers.of(filter.reading);
}

/// Returns the direction and offset of the distance by which a sun's cascades are chosen. It is measured along the
/// camera that they are fitted to: the drawing one, unless that is frozen.
glm::vec4 view_distance(const ConsumerItem& fitted, const ConsumerItem& consumer) {
    const glm::dvec3 ahead = -fitted.rotation_ws[2];
    return with_w(ahead, glm::dot(ahead, consumer.position_ws_m - fitted.position_ws_m));
}

/// Writes what an area light's source is like: its axes, and how far it reaches along them, metres. A round source has
/// its radius in each place but a tube's length.
void source_shape_record(const LightItem& light, LightRecord& record) {
    const SourceShape shape = light_facts(light.kind).shape;
    const double radius_m = light.source_radius_m;
    const bool wide = shape == SourceShape::rectangle || shape == SourceShape::tube;
    ViewRecord& source = record.views[kSourceView];
    source.axis_u = with_w(light.rotation_ws[0], wide ? 0.5 * static_cast<double>(light.width_m) : radius_m);
    source.axis_v = with_w(light.rotation_ws[1],
                           shape == SourceShape::rectangle ? 0.5 * static_cast<double>(light.height_m) : radius_m);
}

/// Returns the record of a light, with or without a map.
/// `lamp_ws_m`: position from which shadows of a local light are computed.
LightRecord light_record(const LightItem& light, const glm::dvec3& lamp_ws_m, const ConsumerItem& fitted,
                         const ConsumerItem& consumer) {
    LightRecord record;
    const bool sun = light_facts(light.kind).parallel;
    const glm::dvec3 from_camera_m = light.position_ws_m - consumer.position_ws_m;
    record.position = sun ? view_distance(fitted, consumer) : with_w(from_camera_m, light.range_m);
    record.to_light = with_w(light.rotation_ws[2], light.shadow.layers);
    const glm::dvec3 exact = sun ? light.rotation_ws[2] : lamp_ws_m - consumer.position_ws_m;
    record.low = glm::vec4(glm::vec3(exact - glm::dvec3(glm::vec3(sun ? exact : from_camera_m))),
                           light.shadow.antialias ? 1.0f : 0.0f);
    record.radiance = glm::vec4(light.colour * light.intensity, 0.0f);
    const double cos_outer = std::cos(light.outer_cone_rad), cos_inner = std::cos(light.inner_cone_rad);
    // KHR_lights_punctual's own guard against inner == outer.
    constexpr double kLeastConeWidth = 0.001;
    record.cone = {static_cast<float>(cos_outer),
                   static_cast<float>(1.0 / std::max(kLeastConeWidth, cos_inner - cos_outer)), 0.0f, 0.0f};
    if (light_kind_row(light.kind).texture == gl::TextureKind::cube) {
        const glm::dquat& turn = cube_turn();
        record.cone = with_w({turn.x, turn.y, turn.z}, turn.w);
    }
    if (light_facts(light.kind).area()) source_shape_record(light, record);
    return record;
}

/// Sets the filter's part of the record.
void filter_record(const ShadowTuning::Kernel& kernel, const MapSettings& map, const ConsumerItem& consumer,
                   LightRecord& record) {
    const FilterSettings& filter = map.filtering;
    record.filtering = {static_cast<int>(filter.size), static_cast<int>(filter.taps), kernel.early_bail ? 1 : 0,
                        kernel.seed == FilterSeed::world ? 1 : 0};
    record.spread = {filter.spread_texel, filter.spread_m, filter.doubles_m > 0.0f ? 1.0f / filter.doubles_m : 0.0f,
                     filter.most_spread_texel};
    const NoiseCell cell = seed_cell(consumer.position_ws_m, static_cast<double>(filter.cell_m));
    record.seed_cell = glm::ivec4(cell.cell, filter_row(map.filter).random ? 0 : -1);
    record.seed_place = with_w(cell.place, 1.0 / static_cast<double>(filter.cell_m));
}

/// Returns the size of the source for shaders: metres, or the tangent of a sun's angular radius.
float source_size(LightKind kind, const FilterSettings& filter) {
    return light_facts(kind).parallel ? filter.sun_radius_tan : filter.source_radius_m;
}

/// Returns the size of the source for one view. A sun seen from an eye gets a disk there, metres, as wide as the sky's
/// from the middle of the view's depth.
float source_size(LightKind kind, const FilterSettings& filter, const ShadowView& view) {
    if (!light_facts(kind).parallel || is_parallel(view)) return source_size(kind, filter);
    return filter.sun_radius_tan * static_cast<float>(0.5 * (view.depth.near_m + view.depth.far_m));
}

/// Returns the source's part of the record. x: 1 if the maps contain all casters at their true distances. y: distance
/// to the nearest caster around a lamp that no map shows whole, metres.
glm::vec4 source_record(const ProjectionRequest& projection, double clearance_m) {
    const bool fitted = projection.near_m == 0.0 && projection.far_m == 0.0;
    return {fitted ? 1.0f : 0.0f, static_cast<float>(clearance_m), 0.0f, 0.0f};
}

void bias_record(const ShadowTuning::Bias& bias, LightingLight& out) {
    using Bias = ShadowTuning::Bias;
    const Bias usual;
    const auto valid = [&](float Bias::*field) {
        return std::isfinite(bias.*field) && bias.*field >= 0.0f ? bias.*field : usual.*field;
    };
    out.row.manual_bias = bias.mode != BiasMode::automatic && bias.mode < BiasMode::count;
    if (!out.row.manual_bias) return;
    out.record.options.y = static_cast<std::int32_t>(bias.mode);
    out.record.bias.x = valid(&Bias::offset_m);
    out.record.bias.z = valid(&Bias::offset_texel);
}

}  // namespace

CameraRecord camera_record(const ConsumerItem& c) {
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const glm::dvec2 half = half_extent(c);
    const glm::dmat4 projection = orthographic
                                      ? math::reversed_orthographic(-half.x, half.x, -half.y, half.y, c.near_m, c.far_m)
                                      : math::reversed_perspective(-half.x, half.x, -half.y, half.y, c.near_m, c.far_m);
    const math::TwoFloat3 anchor = math::split(c.position_ws_m);
    CameraRecord record;
    record.clip_from_anchor = glm::mat4(projection * glm::dmat4(glm::transpose(c.rotation_ws)));
    record.anchor_high = glm::vec4(anchor.high, 0.0f);
    record.anchor_low = glm::vec4(anchor.low, 0.0f);
    record.right = with_w(c.rotation_ws[0], half.x);
    record.up = with_w(c.rotation_ws[1], half.y);
    record.back = with_w(c.rotation_ws[2], orthographic ? 1.0 : 0.0);
    const double range_m = c.far_m - c.near_m;
    const glm::dvec2 unproject =
        orthographic ? glm::dvec2(c.far_m, range_m)
                     : (std::isinf(c.far_m) ? glm::dvec2(0.0, c.near_m)
                                            : glm::dvec2(c.near_m / range_m, c.near_m * c.far_m / range_m));
    record.unproject = glm::vec4(glm::vec2(unproject), glm::vec2(c.viewport_px));
    return record;
}

namespace {

/// Returns how a light finds the lit shares of pixels' areas.
AreaShares area_shares(const LightItem& light, ShadowFilter filter) {
    return light.shadow.antialias ? filter_row(filter).area_shares : AreaShares::none;
}

/// Returns whether a filter sees all of an area light's source.
bool sees_whole_source(const LightItem& light, ShadowFilter filter) {
    return light_facts(light.kind).area() && filter_row(filter).width == FilterWidth::source;
}

/// Publishes lights that use rays. Their maps, if any, classify pixels first. The maps are left out for cameras that
/// they are not fitted to: these may see what is not in them.
void publish_rays(const SceneSnapshot& scene, const PublishInputs& in, const ConsumerItem& consumer,
                  LightingInputs& inputs) {
    if (!in.rays.nodes) return;
    for (std::uint32_t i = 0; i < in.drawn.lights.size(); ++i) {
        const ShadowRequest& request = in.drawn.lights[i].request;
        if (!request.rays.used || in.drawn.statuses[i].is_skipped()) continue;
        LightingLight& out = inputs.lights[i];
        const LightItem& light = scene.lights[i];
        const LightKindRow& kind = light_kind_row(light.kind);
        out.row = {.kind_define = kind.define,
                   .kind_file = kind_file(request.projection, kind),
                   .filter_file = filter_row(request.map.filter).file,
                   .rays = true,
                   .ray_masks = static_cast<bool>(in.rays.masks)};
        out.row.area_shares = area_shares(light, request.map.filter);
        out.row.whole_source = sees_whole_source(light, request.map.filter);
        out.rays = in.rays;
        out.row.sheets = out.row.depths = out.bounds && scene.pictures.empty();
        if (!in.ray_tints.empty() && in.ray_tints[i] && !in.drawn.statuses[i].has_lost_tint()) {
            out.row.tint = out.plain.row.tint = TintLookup::rays;
            out.tint = {{}, {}, in.tint_tree};
        }
        if (!out.row.sheets) out.map = out.second = out.bounds = {}, out.ends = {};
        // also without a map
        filter_record(light.tuning.kernel, request.map, consumer, out.record);
        out.record.radiance.w = source_size(light.kind, request.map.filtering);
        out.sampler = in.samplers.of(MapReading::depths);
    }
}

/// Publishes the layers of translucent casters of a light without rays. All of its views have the same textures.
void publish_tint(const PublishInputs& in, std::size_t v, LightingLight& out) {
    if (in.tints.empty() || !in.tints[v].textures.depths || in.drawn.statuses[in.drawn.view(v).light].has_lost_tint())
        return;
    out.tint = in.tints[v].textures;
    out.row.tint = out.plain.row.tint = TintLookup::layers;
}

/// Publishes what every light has, with or without a map.
void publish_unshadowed(const SceneSnapshot& scene, const PublishInputs& in, std::uint32_t i,
                        const ConsumerItem& fitted, const ConsumerItem& consumer, LightingLight& out) {
    const LightItem& light = scene.lights[i];
    out.light = i;
    out.row.kind_define = light_kind_row(light.kind).define;
    out.record = light_record(light, lamp_ws_m(in.lamps_ws_m, scene, i), fitted, consumer);
}

/// Adds one view with a map to its light's published inputs.
void publish_view(const SceneSnapshot& scene, const PublishInputs& in, std::size_t v, const ConsumerItem& consumer,
                  LightingLight& out) {
    const ShadowView& view = in.drawn.view(v);
    const ShadowRequest& request = in.drawn.request_of(v);
    const LightItem& light = scene.lights[view.light];
    set_lookup(in.drawn, v, light_kind_row(light.kind), in.samplers, out);
    out.plain.accuracy.filter = kCheapestFilter;
    add_view(light, in.drawn, v, out.plain.accuracy);
    out.row.ray_masks = out.row.triangles && in.masked;
    // A map that serves one tap has none.
    if (out.row.filter_file == filter_row(request.map.filter).file) {
        out.row.area_shares = area_shares(light, request.map.filter);
        out.row.whole_source = sees_whole_source(light, request.map.filter);
    }
    const auto most_views = static_cast<std::int32_t>(light_facts(light.kind).area() ? kSourceView : kMaxViews);
    if (out.record.options.x < most_views)
        out.record.views[out.record.options.x++] = view_record(in.drawn, v, consumer);
    out.record.options.w |= 1 << view.layer;
    if (map_texture(light, request) != gl::TextureKind::cube)
        out.record.cone.z = static_cast<float>(request.projection.cube_blend_eighths) / 8.0f;
    bias_record(light.tuning.bias, out);
    // A lamp's bounds follow from its receivers alone.
    const bool by_distance = is_parallel(view) && consumer.projection == CameraProjection::perspective;
    if (light.tuning.maps.proxies)
        out.record.bias.w = by_distance ? math::at_least(proxy_bound_of(consumer, allowed_proxy_px(light.shadow)))
                                        : std::numeric_limits<float>::max();
    const MapSettings& map = request.map;
    filter_record(light.tuning.kernel, map, consumer, out.record);
    out.record.moments = map.moments.settings;
    out.record.moment_sampling = {map.moments.bleeding, map.moments.footprint_texel,
                                  static_cast<float>(map.moments.anisotropy),
                                  static_cast<float>(in.drawn.maps[v].triangle_bits)};
    out.record.radiance.w = source_size(light.kind, map.filtering, view);
    if (in.drawn.maps[v].sheets.ends)
        out.record.moments = source_record(request.projection, in.clearances_m[view.light]);
    out.record.bias.y = map.cascade_blend;
    out.record.options.z = view.cascade.seen_to_m > 0.0 ? 1 : 0;
    publish_tint(in, v, out);
}

}  // namespace

void publish_lights(const SceneSnapshot& scene, const PublishInputs& in, std::vector<LightingInputs>& out,
                    std::span<double> cpu_us) {
    const std::vector<ConsumerItem>& pictures = scene.pictures.empty() ? scene.consumers : scene.pictures;
    out.resize(pictures.size());
    for (std::uint32_t c = 0; c < pictures.size(); ++c) {
        const ConsumerItem& consumer = pictures[c];
        const ConsumerItem& fitted = c < scene.consumers.size() ? scene.consumers[c] : consumer;
        LightingInputs& inputs = out[c];
        inputs.consumer = c;
        inputs.camera = camera_record(consumer);
        inputs.lights.resize(scene.lights.size());
        for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
            const LightTimer time(cpu_us, i);
            LightingLight& light = inputs.lights[i];
            light = {};
            light.area = in.lit_areas.empty() ? area_in_range(scene.lights[i], consumer)
                                              : in.lit_areas[c * scene.lights.size() + i];
            publish_unshadowed(scene, in, i, fitted, consumer, light);
            const IndexRange views = in.drawn.fitted.lights[i].views;
            for (std::size_t v = views.first; v < views.end(); ++v) {
                // Cameras that the view is not fitted to may see anything.
                const bool sees = !scene.pictures.empty() || (in.drawn.view(v).consumer_mask & consumer_bit(c)) != 0;
                if (sees && in.drawn.has_map(v)) publish_view(scene, in, v, consumer, light);
            }
        }
        publish_rays(scene, in, consumer, inputs);
        sign_lookups(scene, in.drawn, inputs);
    }
}

}  // namespace gnomon::shadow
