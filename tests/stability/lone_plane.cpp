#include "tests/stability/lone_plane.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "bench/glsl_on_cpu/light_block_values.h"
#include "engine/math/projection.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench::glsl {
namespace {

#include "bench/glsl_on_cpu/shader_structs.inc"

/// One row of the shaders' table, whatever its struct.
class Lookup {
public:
    virtual ~Lookup() = default;
    virtual void set(const shadow::LightingLight& light, std::span<const shadow::ShadowView* const> views,
                     const glm::dvec3& camera_ws_m) = 0;
    /// Sets the caster that triangles belong to: kQuad, placed relative to the camera.
    virtual void set_caster(const InstanceItem& caster) = 0;
    struct Question {
        glm::dvec3 position_ca_m, normal;
        double error_m, bias_share;
    };
    virtual double visibility(const MapTexels& map, const Question& question, Trace& trace) = 0;
};

/// From -1 to 1 along x and y.
const CasterTriangleList kQuad{{
                                   {{{{-1.0f, -1.0f, 0.0f}}, {{1.0f, -1.0f, 0.0f}}, {{1.0f, 1.0f, 0.0f}, 1}}},
                                   {{{{-1.0f, -1.0f, 0.0f}, 0}, {{1.0f, 1.0f, 0.0f}}, {{-1.0f, 1.0f, 0.0f}}}},
                               },
                               {}};

template <class Row>
class RowLookup final : public Lookup {
public:
    explicit RowLookup(bool linear) { row_.shadow_map.linear = linear; }
    void set(const shadow::LightingLight& light, std::span<const shadow::ShadowView* const> views,
             const glm::dvec3& camera_ws_m) override {
        set_light(light, views, camera_ws_m, row_);
    }
    void set_caster(const InstanceItem& caster) override {
        if constexpr (ReadsTriangles<Row>) set_casters({&caster, 1}, kQuad, glm::dvec3(0.0), row_);
    }
    double visibility(const MapTexels& map, const Question& q, Trace& trace) override {
        set_map(map, trace, row_);
        row_.bias_share = q.bias_share;
        return row_.shadow_visibility(to_vec3(q.position_ca_m), to_vec3(q.normal), q.error_m);
    }

private:
    Row row_;
};

template <class Row>
std::unique_ptr<Lookup> make_lookup(bool linear) {
    return std::make_unique<RowLookup<Row>>(linear);
}

struct CompiledRow {
    std::string_view filter_file;
    std::array<std::unique_ptr<Lookup> (*)(bool), static_cast<std::size_t>(PlaneKind::count)> make;
};
#define ROWS_OF_FILTER(name, reading, file)                                                                 \
    {file,                                                                      \
     {make_lookup<reading::directional::row_##name>, make_lookup<reading::directional_warped::row_##name>, \
      make_lookup<reading::spot::row_##name>, make_lookup<reading::point::row_##name>}},
constexpr CompiledRow kRows[] = {GNOMON_FILTERS(ROWS_OF_FILTER)};
#undef ROWS_OF_FILTER

}  // namespace
}  // namespace gnomon::bench::glsl

namespace gnomon {
namespace {

using bench::glsl::CompiledRow;
using bench::glsl::Lookup;
using shadow::ShadowView;

constexpr double kLit = 1.0 - 1e-6;  // a filter's weights sum up to 1 within rounding

/// The plane normal . p = offset_m, p relative to the light's anchor, as one view draws it: depth is linear in texels.
struct DrawnPlane {
    double start = 0.0, per_u = 0.0, per_v = 0.0;
    double at(double u, double v) const { return start + per_u * u + per_v * v; }
};

/// Takes planes from around a light's anchor into one view's map, as texture coordinates and depth.
using PlaneIntoMap = glm::mat<4, 4, long double>;
PlaneIntoMap plane_into_map(const ShadowView& view) {
    return glm::inverseTranspose(PlaneIntoMap(math::texture_from_clip() * glm::dmat4(view.clip_from_anchor)));
}

DrawnPlane drawn_plane(const PlaneIntoMap& into_map, double size_px, const glm::dvec3& normal, double offset_m) {
    const glm::vec<4, long double> plane = into_map * glm::vec<4, long double>(glm::dvec4(normal, -offset_m));
    return {static_cast<double>(-plane.w / plane.z), static_cast<double>(-plane.x / plane.z) / size_px,
            static_cast<double>(-plane.y / plane.z) / size_px};
}

/// What the rasteriser makes of it.
class PlaneTexels final : public bench::glsl::MapTexels {
public:
    std::array<DrawnPlane, 6> faces;
    LonePlane plane;
    DepthFormat format = DepthFormat::d32f;
    double absolute = 0.0, relative = 0.0;  // most rounding

    double texel(int layer, std::uint32_t column, std::uint32_t row) const override {
        const DrawnPlane& face = faces[static_cast<std::size_t>(layer)];
        const double exact = face.at(column + 0.5, row + 0.5) + std::abs(face.per_u) * plane.aside_texel.x +
                             std::abs(face.per_v) * plane.aside_texel.y;
        const double share = plane.worst ? 1.0 : 2.0 * noise(static_cast<std::uint64_t>(layer) + 1, column, row) - 1.0;
        return stored(exact + share * (absolute + relative * std::abs(exact)),
                      noise(static_cast<std::uint64_t>(layer) + 7, column, row));
    }
    bench::glsl::uvec2 triangle(int layer, std::uint32_t column, std::uint32_t row) const override {
        if (plane.half_u_m == glm::dvec3(0.0)) return bench::glsl::kShowsNone;
        return {0, noise(static_cast<std::uint64_t>(layer) + 13, column, row) < 0.5 ? 0u : 1u};
    }

private:
    double stored(double depth, double chance) const {
        const double clamped = std::min(std::max(depth, 0.0), 1.0);
        const double step = shadow::depth_format_row(format).step;
        if (step == 0.0) return static_cast<double>(static_cast<float>(clamped));
        const double steps = clamped / step;
        return std::min(step * (plane.worst || chance < 0.5 ? std::ceil(steps) : std::floor(steps)), 1.0);
    }
    double noise(std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
        std::uint64_t x =
            plane.salt ^ (a * 0x9e3779b97f4a7c15u) ^ (b * 0xbf58476d1ce4e5b9u) ^ (c * 0x94d049bb133111ebu);
        x = (x ^ (x >> 31)) * 0xbf58476d1ce4e5b9u;
        return static_cast<double>((x ^ (x >> 29)) >> 11) * 0x1p-53;
    }
};

/// What a frame would hand to the lighting.
class Published {
public:
    Published(PlaneKind kind, ShadowFilter filter, DepthFormat format) {
        scene_.consumers.resize(1);
        LightItem light;
        light.kind = kind == PlaneKind::spot    ? LightKind::spot
                     : kind == PlaneKind::point ? LightKind::point
                                                : LightKind::directional;
        light.has_shadow = true;
        light.shadow.filter = filter;
        light.tuning.maps.depth_format = format;
        scene_.lights = {light};
    }
    const shadow::LightingLight& of(const std::vector<ShadowView>& views, std::uint32_t size_px,
                                    const glm::dvec3& camera_ws_m) {
        scene_.consumers[0].position_ws_m = camera_ws_m;
        LightItem& light = scene_.lights[0];
        light.position_ws_m = views[0].pose.anchor_ws_m;
        light.rotation_ws = {views[0].pose.axis_u, views[0].pose.axis_v, views[0].pose.axis_back};
        frame_.decisions.resize(1);
        shadow::MapSettings& map = frame_.decisions[0].request.map;
        map.filter = light.shadow.filter;
        map.depth_format = light.tuning.maps.depth_format;
        map.resolution_px = size_px;
        map.filtering = shadow::filter_settings(light, size_px);
        frame_.statuses.assign(1, {});
        frame_.fitted.views = views;
        frame_.fitted.lights.resize(1);
        frame_.fitted.lights[0].views.count = static_cast<std::uint32_t>(views.size());
        frame_.maps.resize(views.size());
        for (shadow::MapAssignment& assigned : frame_.maps) {
            assigned.texture = {1};
            assigned.size_px = size_px;
        }
        frame_.updates.assign(views.size(), {});
        const shadow::DrawnViews drawn = shadow::drawn_views(frame_);
        shadow::publish_lights(scene_, {drawn, {}, {}, samplers_, no_rays_}, frame_.inputs, {});
        return frame_.inputs[0].lights[0];
    }

private:
    SceneSnapshot scene_;
    shadow::MapSamplers samplers_;
    visibility::RayBuffers no_rays_;
    shadow::ShadowFrame frame_;
};

const CompiledRow* compiled(ShadowFilter filter) {
    for (const CompiledRow& row : bench::glsl::kRows)
        if (row.filter_file == shadow::filter_row(filter).file) return &row;
    return nullptr;
}

}  // namespace

const char* plane_kind_name(PlaneKind kind) {
    constexpr const char* kNames[] = {"sun", "warped_sun", "spot", "point"};
    return kNames[static_cast<std::size_t>(kind)];
}

bool can_judge(ShadowFilter filter) { return compiled(filter) != nullptr; }

PlaneBounds plane_bounds() {
    using Kind = bench::glsl::compare::directional::Kind;
    return {Kind::kRasterSnap_texel, Kind::kUnitRoundoff, Kind::kNormalError_rad, Kind::kRebuiltRelative,
            Kind::kSteepTangent};
}

std::vector<ShadowView> cube_views(const glm::dvec3& anchor_ws_m, const shadow::PerspectiveRange& range,
                                   std::uint32_t size_px) {
    std::vector<ShadowView> views;
    for (std::uint32_t i = 0; i < 6; ++i) {
        const shadow::CubeFace& face = shadow::cube_face(i);
        const glm::dmat3 axes = glm::dmat3(shadow::cube_turn()) * glm::dmat3(face.axis_u, face.axis_v, face.axis_back);
        views.push_back(shadow::perspective_view(anchor_ws_m, axes, shadow::TangentRectangle{}, range, size_px));
        views.back().projection = shadow::ViewProjection::cube_face;
        views.back().layer = i;
    }
    return views;
}

struct LonePlaneLookup::Parts {
    Published published;
    std::unique_ptr<Lookup> lookup;
    PlaneTexels texels;
    std::vector<ShadowView> views;
    std::vector<PlaneIntoMap> into_maps;  // view by view
    glm::dvec3 camera_ws_m{0.0};
};

LonePlaneLookup::LonePlaneLookup(PlaneKind kind, ShadowFilter filter, DepthFormat format) {
    const bool linear = shadow::filter_row(filter).reading == shadow::MapReading::compare_linear;
    parts_.reset(new Parts{Published(kind, filter, format),
                           compiled(filter)->make[static_cast<std::size_t>(kind)](linear),
                           {},
                           {},
                           {},
                           {}});
    parts_->texels.format = format;
}

LonePlaneLookup::~LonePlaneLookup() = default;

void LonePlaneLookup::set_maps(std::vector<ShadowView> views, std::uint32_t size_px, const glm::dvec3& camera_ws_m) {
    const double roundoff = plane_bounds().unit_roundoff;
    const bool orthographic = views[0].projection == shadow::ViewProjection::orthographic;
    parts_->texels.size_px = size_px;
    parts_->texels.absolute = roundoff * (orthographic ? 2.0 : std::abs(views[0].depth.alpha));
    parts_->texels.relative = orthographic ? 0.0 : 3.0 * roundoff;
    parts_->camera_ws_m = camera_ws_m;
    parts_->views = std::move(views);
    parts_->into_maps.clear();
    std::vector<const ShadowView*> published;
    for (const ShadowView& view : parts_->views) {
        parts_->into_maps.push_back(plane_into_map(view));
        published.push_back(&view);
    }
    parts_->lookup->set(parts_->published.of(parts_->views, size_px, camera_ws_m), published, camera_ws_m);
}

LonePlaneLookup::Answer LonePlaneLookup::look_up(const LonePlane& plane, double bias_share) const {
    parts_->texels.plane = plane;
    for (std::size_t i = 0; i < parts_->views.size(); ++i)
        parts_->texels.faces[parts_->views[i].layer] =
            drawn_plane(parts_->into_maps[i], parts_->texels.size_px, plane.normal, glm::dot(plane.normal, plane.at_m));
    const glm::dvec3 anchor_from_camera_m = parts_->views[0].pose.anchor_ws_m - parts_->camera_ws_m;
    InstanceItem caster;
    caster.basis = {plane.half_u_m, plane.half_v_m, plane.normal};
    caster.translation_ws_m = plane.quad_at_m + anchor_from_camera_m;
    parts_->lookup->set_caster(caster);
    bench::glsl::Trace trace;
    const double visibility = parts_->lookup->visibility(
        parts_->texels, {plane.receiver_m + anchor_from_camera_m, plane.receiver_normal, plane.error_m, bias_share},
        trace);
    return {visibility >= kLit, trace.taps > 0};
}

}  // namespace gnomon
