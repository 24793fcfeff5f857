#include "tests/stability/random_planes.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <random>
#include <vector>

#include "bench/exact_record.h"
#include "engine/math/projection.h"
#include "systems/shadow/depth_format.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/kinds/directional_warped.h"
#include "systems/shadow/kinds/orthographic_view.h"
#include "systems/shadow/kinds/perspective_view.h"
#include "systems/shadow/publish.h"

namespace gnomon::bench::glsl {
namespace {

#include "bench/exact_shaders.inc"

/// One row of the shaders' table, whatever its struct.
class Lookup {
public:
    virtual ~Lookup() = default;
    virtual void set(const shadow::LightingLight& light, std::span<const shadow::ShadowView* const> views,
                     const glm::dvec3& camera_ws_m) = 0;
    struct Question {
        glm::dvec3 position_ca_m, normal;
        double error_m, bias_share;
    };
    virtual double visibility(const DepthTexels& map, const Question& question, Trace& trace) = 0;
};

template <class Row>
class RowLookup final : public Lookup {
public:
    explicit RowLookup(bool linear) { row_.shadow_map.linear = linear; }
    void set(const shadow::LightingLight& light, std::span<const shadow::ShadowView* const> views,
             const glm::dvec3& camera_ws_m) override {
        set_light(light, views, camera_ws_m, row_);
    }
    double visibility(const DepthTexels& map, const Question& q, Trace& trace) override {
        row_.shadow_map.map = &map;
        row_.shadow_map.trace = &trace;
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
#define ROWS_OF_FILTER(name, reading)                                                                      \
    {"shadow/filters/" #name ".glsl",                                                                      \
     {make_lookup<reading::directional::row_##name>, make_lookup<reading::directional_warped::row_##name>, \
      make_lookup<reading::spot::row_##name>, make_lookup<reading::point::row_##name>}},
constexpr CompiledRow kRows[] = {GNOMON_FILTERS(ROWS_OF_FILTER)};
#undef ROWS_OF_FILTER

constexpr double kSnap_texel = compare::directional::Kind::kRasterSnap_texel;
constexpr double kUnitRoundoff = compare::directional::Kind::kUnitRoundoff;
constexpr double kNormalError_rad = compare::directional::Kind::kNormalError_rad;
constexpr double kRebuiltRelative = compare::directional::Kind::kRebuiltRelative;
constexpr double kSteepTangent = compare::directional::Kind::kSteepTangent;

}  // namespace
}  // namespace gnomon::bench::glsl

namespace gnomon {
namespace {

using bench::glsl::CompiledRow;
using shadow::ShadowView;

constexpr double kLessBias = 0.9;
constexpr double kLit = 1.0 - 1e-6;  // a filter's weights sum up to 1 but for rounding
constexpr int kPlanesPerMap = 16;
constexpr int kKeepOff_texel = 12;  // from a flat map's border: no filter with its usual settings reads past it
constexpr double kPositionRounding = 6.0 * bench::glsl::kUnitRoundoff;  // half of publish.cpp's

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    double power(double from, double to) { return std::pow(10.0, between(from, to)); }
    bool chance(double share) { return between(0.0, 1.0) < share; }
    int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(engine_); }
    std::uint64_t bits() { return engine_(); }
    glm::dvec3 direction() {
        glm::dvec3 v;
        do v = {between(-1, 1), between(-1, 1), between(-1, 1)};
        while (!(glm::dot(v, v) <= 1.0 && glm::dot(v, v) > 1e-4));
        return glm::normalize(v);
    }
    glm::dmat3 axes() { return glm::dmat3(glm::angleAxis(between(-3.14, 3.14), direction())); }

private:
    std::mt19937_64 engine_;
};

/// The plane normal . p = offset_m, p relative to the light's anchor, as one view draws it: depth is linear in texels.
struct DrawnPlane {
    double start = 0.0, per_u = 0.0, per_v = 0.0;
    double at(double u, double v) const { return start + per_u * u + per_v * v; }
};

DrawnPlane drawn_plane(const ShadowView& view, double size_px, const glm::dvec3& normal, double offset_m) {
    using Matrix = glm::mat<4, 4, long double>;
    using Vector = glm::vec<4, long double>;
    const Matrix map_from_anchor(math::texture_from_clip() * glm::dmat4(view.clip_from_anchor));
    const Vector plane = glm::inverseTranspose(map_from_anchor) * Vector(glm::dvec4(normal, -offset_m));
    return {static_cast<double>(-plane.w / plane.z), static_cast<double>(-plane.x / plane.z) / size_px,
            static_cast<double>(-plane.y / plane.z) / size_px};
}

/// What the rasteriser makes of it, see judge_planes().
class PlaneTexels final : public bench::glsl::DepthTexels {
public:
    std::array<DrawnPlane, 6> faces;
    DepthFormat format = DepthFormat::d32f;
    glm::dvec2 aside_texel{0.0};            // by how much it is snapped; the sign is the slope's
    double absolute = 0.0, relative = 0.0;  // most rounding
    bool worst = false;
    std::uint64_t salt = 0;

    double texel(int layer, std::uint32_t column, std::uint32_t row) const override {
        const DrawnPlane& face = faces[static_cast<std::size_t>(layer)];
        const double exact = face.at(column + 0.5, row + 0.5) + std::abs(face.per_u) * aside_texel.x +
                             std::abs(face.per_v) * aside_texel.y;
        const double share = worst ? 1.0 : 2.0 * noise(static_cast<std::uint64_t>(layer) + 1, column, row) - 1.0;
        return stored(exact + share * (absolute + relative * std::abs(exact)),
                      noise(static_cast<std::uint64_t>(layer) + 7, column, row));
    }

private:
    double stored(double depth, double chance) const {
        const double clamped = std::min(std::max(depth, 0.0), 1.0);
        const double step = shadow::depth_format_row(format).step;
        if (step == 0.0) return static_cast<double>(static_cast<float>(clamped));
        const double steps = clamped / step;
        return std::min(step * (worst || chance < 0.5 ? std::ceil(steps) : std::floor(steps)), 1.0);
    }
    double noise(std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
        std::uint64_t x = salt ^ (a * 0x9e3779b97f4a7c15u) ^ (b * 0xbf58476d1ce4e5b9u) ^ (c * 0x94d049bb133111ebu);
        x = (x ^ (x >> 31)) * 0xbf58476d1ce4e5b9u;
        return static_cast<double>((x ^ (x >> 29)) >> 11) * 0x1p-53;
    }
};

/// A light's views as a fit could have made them, and a place in one of them.
class Maps {
public:
    Maps(PlaneKind kind, Random& random) : kind_(kind), random_(random) {
        size_px = 1u << random.whole(6, 12);
        scale_m_ = random.power(-3.0, 4.0);
        if (kind == PlaneKind::point) {
            cube();
        } else if (kind == PlaneKind::spot) {
            const glm::dvec2 low(random.between(-2.0, 1.0), random.between(-2.0, 1.0));
            const shadow::TangentRectangle sides{low,
                                                 low + glm::dvec2(random.power(-1.5, 0.5), random.power(-1.5, 0.5))};
            views.push_back(shadow::perspective_view(anchor_ws_m_, random.axes(), sides, range(), size_px));
        } else {
            sun();
        }
        camera_ws_m = anchor_ws_m_ + random.direction() * (scale_m_ * random.power(-2.0, 1.0));
    }

    /// Relative to the anchor: a point that the map shows, and the way from there to the light.
    struct Place {
        glm::dvec3 position_m, to_light;
    };
    Place place() {
        const ShadowView& view = views[kind_ == PlaneKind::point ? static_cast<std::size_t>(random_.whole(0, 5)) : 0];
        const int keep_off = kind_ == PlaneKind::point ? 0 : kKeepOff_texel;
        const int side = static_cast<int>(size_px);
        int column = random_.whole(keep_off, side - 1 - keep_off);
        if (kind_ == PlaneKind::point && random_.chance(1.0 / 3.0))
            column = random_.chance(0.5) ? random_.whole(0, 3) : side - 1 - random_.whole(0, 3);
        const glm::dvec2 at((column + part()) / side, (random_.whole(keep_off, side - 1 - keep_off) + part()) / side);
        if (view.projection == shadow::ViewProjection::orthographic) {
            const glm::dvec2 q = view.centre_ls_m + view.half_extent_m * (2.0 * at - 1.0);
            const double w = 1.0 / (1.0 - glm::dot(view.warp, q));
            const double z_m = w * (view.near_m + random_.between(0.05, 0.95) * (view.far_m - view.near_m));
            const glm::dvec2 p = q * w;
            return {view.axis_u * p.x + view.axis_v * p.y - view.axis_back * z_m, view.axis_back};
        }
        const glm::dvec2 tangent = view.tan_low + (view.tan_high - view.tan_low) * at;
        const double z_m = view.near_m * std::pow(view.far_m / view.near_m, random_.between(0.02, 0.98));
        const glm::dvec3 p = (view.axis_u * tangent.x + view.axis_v * tangent.y - view.axis_back) * z_m;
        return {p, -glm::normalize(p)};
    }

    std::vector<ShadowView> views;
    std::uint32_t size_px = 64;
    glm::dvec3 camera_ws_m{0.0};

private:
    /// Of a texel: beside its border, beside its middle, or anywhere.
    double part() {
        constexpr double kBeside = 0.01;
        const double near = random_.power(-6.0, -2.0) + 1e-9;
        const int where = random_.whole(0, 3);
        if (where == 0) return std::min(near, kBeside);
        if (where == 1) return 1.0 - std::min(near, kBeside);
        if (where == 2) return 0.5 + (random_.chance(0.5) ? near : -near);
        return random_.between(0.0, 1.0);
    }
    shadow::PerspectiveRange range() {
        const double near_m = scale_m_ * random_.power(-3.0, 0.0);
        return {near_m, near_m * random_.power(0.05, 3.0)};
    }
    void sun() {
        shadow::OrthographicBox box{anchor_ws_m_, random_.axes(), {}, {}, 0.0, 0.0};
        box.half_extent_m = {scale_m_, scale_m_ * random_.power(-0.7, 0.7)};
        box.centre_m = {scale_m_ * random_.between(-4.0, 4.0), scale_m_ * random_.between(-4.0, 4.0)};
        const double range_m = scale_m_ * random_.power(-2.0, 2.0);
        box.near_m = range_m * random_.between(-2.0, 1.0);
        box.far_m = box.near_m + range_m;
        if (kind_ == PlaneKind::warped_sun) {
            box.centre_m = {scale_m_ * random_.between(-1.0, 1.0), scale_m_ * random_.between(-1.0, 1.0)};
            box.near_m = -range_m;
            box.far_m = 0.0;
        }
        views.push_back(shadow::orthographic_view(box, size_px));
        if (kind_ != PlaneKind::warped_sun) return;
        ShadowView& view = views.back();
        // Of its warped plane the map shows what lies on this side of the horizon.
        const double farthest_m = glm::length(box.half_extent_m) + glm::length(box.centre_m);
        const double turn = random_.between(0.0, 6.28);
        view.warp = glm::dvec2(std::cos(turn), std::sin(turn)) * (random_.between(0.0, 0.97) / farthest_m);
        shadow::set_warped_matrices(view);
    }
    void cube() {
        const shadow::PerspectiveRange common = range();
        for (std::uint32_t i = 0; i < 6; ++i) {
            const shadow::CubeFace& face = shadow::cube_face(i);
            const glm::dmat3 axes =
                glm::dmat3(shadow::cube_turn()) * glm::dmat3(face.axis_u, face.axis_v, face.axis_back);
            views.push_back(shadow::perspective_view(anchor_ws_m_, axes, shadow::TangentRectangle{}, common, size_px));
            views.back().projection = shadow::ViewProjection::cube_face;
            views.back().layer = i;
        }
    }

    PlaneKind kind_;
    Random& random_;
    double scale_m_ = 1.0;
    glm::dvec3 anchor_ws_m_{1234.5, -67.8, 910.1};
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
        light.shadow.depth_format = format;
        scene_.lights = {light};
    }
    const shadow::LightingLight& of(const Maps& maps) {
        scene_.consumers[0].position_ws_m = maps.camera_ws_m;
        LightItem& light = scene_.lights[0];
        light.position_ws_m = maps.views[0].anchor_ws_m;
        light.rotation_ws = {maps.views[0].axis_u, maps.views[0].axis_v, maps.views[0].axis_back};
        shadow::ShadowDemand demand;
        demand.filter = light.shadow.filter;
        demand.depth_format = light.shadow.depth_format;
        demand.resolution_px = maps.size_px;
        demand.filtering = shadow::filter_demand(light.shadow, maps.size_px);
        frame_.demands = {demand};
        frame_.views = maps.views;
        frame_.slots.assign(maps.views.size(), {.texture = {1}, .size_px = maps.size_px});
        shadow::publish_lights(scene_, {}, frame_);
        return frame_.inputs[0].lights[0];
    }

private:
    SceneSnapshot scene_;
    shadow::ShadowFrame frame_;
};

/// Unit, the angle to `to_light` of a tangent that is any power of ten between.
glm::dvec3 sloped_normal(Random& random, const glm::dvec3& to_light, double& tangent) {
    tangent = random.power(-3.0, 3.0);
    const glm::dvec3 aside = glm::normalize(glm::cross(to_light, random.direction()));
    return glm::normalize(to_light + aside * tangent);
}

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

PlaneTally judge_planes(PlaneKind kind, ShadowFilter filter, DepthFormat format, std::uint64_t count,
                        std::uint64_t seed) {
    using bench::glsl::kUnitRoundoff;
    Random random(seed);
    Published published(kind, filter, format);
    const bool linear = shadow::filter_row(filter).reading == shadow::MapReading::compare_linear;
    const auto lookup = compiled(filter)->make[static_cast<std::size_t>(kind)](linear);
    PlaneTally tally;
    PlaneTexels texels;
    texels.format = format;
    while (tally.planes < count) {
        Maps maps(kind, random);
        std::vector<const ShadowView*> views;
        for (const ShadowView& view : maps.views) views.push_back(&view);
        lookup->set(published.of(maps), views, maps.camera_ws_m);
        texels.size_px = maps.size_px;
        const bool orthographic = views[0]->projection == shadow::ViewProjection::orthographic;
        texels.absolute = orthographic ? 2.0 * kUnitRoundoff : kUnitRoundoff * std::abs(views[0]->depth_alpha);
        texels.relative = orthographic ? 0.0 : 3.0 * kUnitRoundoff;
        for (int i = 0; i < kPlanesPerMap && tally.planes < count; ++i, ++tally.planes) {
            const Maps::Place place = maps.place();
            double tangent = 0.0;
            const glm::dvec3 normal = sloped_normal(random, place.to_light, tangent);
            for (const ShadowView* view : views)
                texels.faces[view->layer] =
                    drawn_plane(*view, maps.size_px, normal, glm::dot(normal, place.position_m));
            texels.worst = random.chance(0.5);
            texels.salt = random.bits();
            const auto share = [&] { return texels.worst ? 1.0 : random.between(-1.0, 1.0); };
            texels.aside_texel = glm::dvec2(share(), share()) * bench::glsl::kSnap_texel;

            const glm::dvec3 from_camera = place.position_m + views[0]->anchor_ws_m - maps.camera_ws_m;
            const double error_m = bench::glsl::kRebuiltRelative * glm::length(from_camera);
            // As the shaders count it: a sun's along the axes, a lamp's from the light.
            const glm::dvec3 far_m = glm::abs(place.position_m);
            const double counted_m = orthographic ? far_m.x + far_m.y + far_m.z : glm::length(far_m);
            bench::glsl::Lookup::Question question{
                from_camera - normal * (share() * error_m) + random.direction() * (kPositionRounding * counted_m), normal,
                error_m, 1.0};
            const glm::dvec3 off = random.direction() * bench::glsl::kNormalError_rad;
            question.normal = glm::normalize(normal + off - normal * glm::dot(normal, off));
            bench::glsl::Trace trace;
            tally.dark += lookup->visibility(texels, question, trace) < kLit;
            tally.looked_up += trace.taps > 0;
            question.bias_share = kLessBias;
            tally.dark_with_less += lookup->visibility(texels, question, trace) < kLit;
            tally.steep += tangent > bench::glsl::kSteepTangent;
        }
    }
    return tally;
}

}  // namespace gnomon
