#include "bench/exact_visibility.h"

#include <concepts>
#include <limits>

#include "bench/glsl_in_double.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/light_kinds.h"

namespace gnomon::bench::glsl {
namespace {

/// What the taps of one lookup met.
struct Trace {
    std::uint8_t layers = 0;
    std::uint16_t taps = 0;
    double margin_texel = std::numeric_limits<double>::infinity();  // to the nearest change of mind
};

/// From a difference of depth to texels of the map at that depth.
struct DepthScale {
    bool perspective = false;
    double texels_per_depth = 0.0;        // orthographic
    double alpha = 0.0, texel_tan = 1.0;  // perspective: depth = alpha + beta / z, a texel is texel_tan * z
    double texels(double depth, double gap) const {
        return gap * (perspective ? 1.0 / (std::max(depth - alpha, 1e-300) * texel_tan) : texels_per_depth);
    }
};

struct ShadowSampler {
    const MapCopy* map = nullptr;
    bool linear = false;
    DepthScale scales[shadow::kMaxViews];
    Trace* trace = nullptr;

    /// Texels beyond the border hold 0.
    double stored(int layer, double column, double row) const {
        const double size = map->size_px;
        if (!(column >= 0.0 && column < size && row >= 0.0 && row < size)) return 0.0;
        const auto n = std::size_t{map->size_px};
        const std::size_t at = (static_cast<std::size_t>(layer) * n + static_cast<std::size_t>(row)) * n;
        return static_cast<double>(map->texels[at + static_cast<std::size_t>(column)]);
    }
    double compare(double reference, double depth, int scale) const {
        const double gap_texel = scales[scale].texels(reference, std::abs(reference - depth));
        trace->margin_texel = std::min(trace->margin_texel, gap_texel);
        return reference >= depth ? 1.0 : 0.0;
    }
    void note_borders(const vec2& at_texel) const {
        for (int i = 0; i < 2; ++i)
            trace->margin_texel = std::min(trace->margin_texel, std::abs(at_texel[i] - std::round(at_texel[i])));
    }
};

struct sampler2DArrayShadow : ShadowSampler {};
struct samplerCubeShadow : ShadowSampler {};
struct sampler2DArrayDepths : ShadowSampler {};
struct samplerCubeDepths : ShadowSampler {};

template <class Sampler>
concept CubeSampler = std::same_as<Sampler, samplerCubeShadow> || std::same_as<Sampler, samplerCubeDepths>;

ivec2 textureSize(const CubeSampler auto& s, int) {
    const int size = static_cast<int>(s.map->size_px);
    return {size, size};
}

ivec3 textureSize(const ShadowSampler& s, int) {
    const int size = static_cast<int>(s.map->size_px);
    return {size, size, 1};
}

double texture(const sampler2DArrayShadow& s, const vec4& at) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 texel = at.xy_() * static_cast<double>(s.map->size_px);
    if (!s.linear) {
        s.note_borders(texel);
        return s.compare(at.w, s.stored(layer, floor(texel.x), floor(texel.y)), layer);
    }
    const vec2 low = floor(texel - 0.5), share = fract(texel - 0.5);
    const auto tap = [&](double x, double y) { return s.compare(at.w, s.stored(layer, low.x + x, low.y + y), layer); };
    return mix(mix(tap(0, 0), tap(1, 0), share.x), mix(tap(0, 1), tap(1, 1), share.x), share.y);
}

struct OnFace {
    std::uint32_t face = 0;
    vec2 texel;
};
OnFace on_face(const vec3& direction, double size) {
    const vec3 a = abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    OnFace at;
    at.face = static_cast<std::uint32_t>(2 * axis + (direction[axis] < 0.0 ? 1 : 0));
    const shadow::CubeFace& f = shadow::cube_face(at.face);
    const vec3 u(f.axis_u.x, f.axis_u.y, f.axis_u.z), v(f.axis_v.x, f.axis_v.y, f.axis_v.z);
    at.texel = (vec2(dot(direction, u), dot(direction, v)) / a[axis] * 0.5 + 0.5) * size;
    return at;
}

/// Texel `texel` of a face; beyond its edge, that of the neighbour which lies in the same direction.
double stored_seamless(const samplerCubeShadow& s, std::uint32_t face, const vec2& texel) {
    const double size = s.map->size_px;
    const bool inside = texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size && texel.y < size;
    if (inside) return s.stored(static_cast<int>(face), texel.x, texel.y);
    const shadow::CubeFace& f = shadow::cube_face(face);
    const vec2 q = (texel + 0.5) / size * 2.0 - 1.0;
    const glm::dvec3 d = f.axis_u * q.x + f.axis_v * q.y - f.axis_back;
    const OnFace at = on_face({d.x, d.y, d.z}, size);
    const vec2 clamped = clamp(floor(at.texel), 0.0, size - 1.0);
    return s.stored(static_cast<int>(at.face), clamped.x, clamped.y);
}

double texture(const samplerCubeShadow& s, const vec4& at) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const double size = s.map->size_px;
    const OnFace face = on_face(at.xyz_(), size);
    if (!s.linear) {
        s.note_borders(face.texel);
        return s.compare(at.w, stored_seamless(s, face.face, clamp(floor(face.texel), 0.0, size - 1.0)), 0);
    }
    const vec2 low = floor(face.texel - 0.5), share = fract(face.texel - 0.5);
    const auto tap = [&](double x, double y) {
        return s.compare(at.w, stored_seamless(s, face.face, low + vec2(x, y)), 0);
    };
    return mix(mix(tap(0, 0), tap(1, 0), share.x), mix(tap(0, 1), tap(1, 1), share.x), share.y);
}

vec4 textureLod(const sampler2DArrayDepths& s, const vec3& at, double) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 texel = floor(at.xy_() * static_cast<double>(s.map->size_px));
    return {s.stored(layer, texel.x, texel.y), 0.0, 0.0, 0.0};
}

vec4 textureGather(const sampler2DArrayDepths& s, const vec3& at) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 corner = floor(at.xy_() * static_cast<double>(s.map->size_px) + 0.5);
    const auto tap = [&](double x, double y) { return s.stored(layer, corner.x + x, corner.y + y); };
    return {tap(-1.0, 0.0), tap(0.0, 0.0), tap(0.0, -1.0), tap(-1.0, -1.0)};
}

vec4 textureLod(const samplerCubeDepths& s, const vec3& at, double) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const OnFace face = on_face(at, s.map->size_px);
    const vec2 texel = clamp(floor(face.texel), 0.0, s.map->size_px - 1.0);
    return {s.stored(static_cast<int>(face.face), texel.x, texel.y), 0.0, 0.0, 0.0};
}

/// Inside a face only: that is all the shader asks for.
vec4 textureGather(const samplerCubeDepths& s, const vec3& at) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const OnFace face = on_face(at, s.map->size_px);
    const vec2 corner = floor(face.texel + 0.5);
    const auto tap = [&](double x, double y) {
        return s.stored(static_cast<int>(face.face), corner.x + x, corner.y + y);
    };
    return {tap(-1.0, 0.0), tap(0.0, 0.0), tap(0.0, -1.0), tap(-1.0, -1.0)};
}

#include "bench/exact_shaders.inc"

vec3 to_vec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
vec4 to_vec4(const glm::vec4& v) {
    const glm::dvec4 d(v);
    return {d.x, d.y, d.z, d.w};
}

ivec4 to_ivec4(const glm::ivec4& v) { return {v.x, v.y, v.z, v.w}; }

/// The views of a light in the order in which they were published.
std::vector<const shadow::ShadowView*> published_views(const shadow::ShadowFrame& frame, std::uint32_t light) {
    std::vector<const shadow::ShadowView*> views;
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (frame.slots[v].texture && frame.demands[frame.views[v].demand].light == light)
            views.push_back(&frame.views[v]);
    return views;
}

template <class Row>
class RowLight final : public ExactLight {
public:
    RowLight(const shadow::ShadowFrame& frame, const ConsumerItem& consumer, std::uint32_t light, const MapCopy& map)
        : camera_ws_m_(consumer.position_ws_m) {
        const shadow::LightingLight& published = frame.inputs.front().lights[light];
        const auto views = published_views(frame, light);
        row_.reach = static_cast<double>(published.row.reach_texel);
        const shadow::LightRecord& record = published.record;
        row_.light.position = to_vec4(record.position);
        row_.light.to_light = to_vec4(record.to_light);
        row_.light.radiance = to_vec4(record.radiance);
        row_.light.cone = to_vec4(record.cone);
        row_.light.options = to_ivec4(record.options);
        row_.light.bias = to_vec4(record.bias);
        row_.light.filtering = to_ivec4(record.filtering);
        row_.light.spread = to_vec4(record.spread);
        row_.light.seed_cell = to_ivec4(record.seed_cell);
        row_.light.seed_place = to_vec4(record.seed_place);
        row_.shadow_map.map = &map;
        row_.shadow_map.linear =
            shadow::filter_row(frame.demands[views.empty() ? 0 : views.front()->demand].filter).reading ==
            shadow::MapReading::compare_linear;
        for (std::size_t i = 0; i < views.size() && i < shadow::kMaxViews; ++i)
            fill(record.views[i], *views[i], row_.light.views[i], row_.shadow_map.scales[views[i]->layer]);
        if (map.is_cube && !views.empty()) row_.shadow_map.scales[0] = row_.shadow_map.scales[views.front()->layer];
    }

    void evaluate(std::span<const SurfacePoint> points, std::span<ExactVisibility> values) const override {
        Row row = row_;
        Trace trace;
        row.shadow_map.trace = &trace;
        for (std::size_t i = 0; i < points.size(); ++i) {
            trace = {};
            const glm::dvec3 position_ca = points[i].position_ws_m - camera_ws_m_;
            const double value = row.shadow_visibility(to_vec3(position_ca), to_vec3(points[i].normal_ws), 0.0);
            values[i] = {static_cast<float>(value), trace.layers, trace.margin_texel < kEdge_texel, trace.taps};
        }
    }

private:
    template <class Record>
    void fill(const shadow::ViewRecord& from, const shadow::ShadowView& view, Record& to, DepthScale& scale) {
        for (int c = 0; c < 4; ++c) to.map_from_anchor[c] = to_vec4(from.map_from_anchor[c]);
        to.axis_u = to_vec4(from.axis_u);
        to.axis_v = to_vec4(from.axis_v);
        to.axis_back = to_vec4(from.axis_back);
        to.numeric = to_vec4(from.numeric);
        to.anchor_from_camera =
            vec4(to_vec3(camera_ws_m_ - view.anchor_ws_m), static_cast<double>(from.anchor_from_camera.w));
        scale.perspective = view.projection != shadow::ViewProjection::orthographic;
        scale.texel_tan = std::max(view.texel_u, view.texel_v);
        scale.alpha = view.depth_alpha;
        scale.texels_per_depth = (view.far_m - view.near_m) / std::max(view.texel_u, view.texel_v);
    }

    Row row_;
    glm::dvec3 camera_ws_m_;
};

}  // namespace
}  // namespace gnomon::bench::glsl

namespace gnomon::bench {
namespace {

class LitLight final : public ExactLight {
public:
    void evaluate(std::span<const SurfacePoint>, std::span<ExactVisibility> values) const override {
        std::fill(values.begin(), values.end(), ExactVisibility{});
    }
};

template <class Row>
std::unique_ptr<ExactLight> make_row(const shadow::ShadowFrame& frame, const ConsumerItem& consumer,
                                     std::uint32_t light, const MapCopy& map) {
    return std::make_unique<glsl::RowLight<Row>>(frame, consumer, light, map);
}

struct CompiledRow {
    std::string_view kind_file, filter_file;
    std::unique_ptr<ExactLight> (*make)(const shadow::ShadowFrame&, const ConsumerItem&, std::uint32_t, const MapCopy&);
};
#define ROWS_OF_FILTER(name, reading)                                                                           \
    {"shadow/kinds/directional.glsl", "shadow/filters/" #name ".glsl",                                          \
     make_row<glsl::reading::directional::row_##name>},                                                         \
        {shadow::kWarpedSunFile, "shadow/filters/" #name ".glsl",                                               \
         make_row<glsl::reading::directional_warped::row_##name>},                                              \
        {"shadow/kinds/spot.glsl", "shadow/filters/" #name ".glsl", make_row<glsl::reading::spot::row_##name>}, \
        {"shadow/kinds/point.glsl", "shadow/filters/" #name ".glsl", make_row<glsl::reading::point::row_##name>},
constexpr CompiledRow kRows[] = {GNOMON_FILTERS(ROWS_OF_FILTER)};
#undef ROWS_OF_FILTER

}  // namespace

std::unique_ptr<ExactLight> make_exact_light(const shadow::ShadowFrame& frame, const SceneSnapshot& scene,
                                             std::uint32_t light, const MapCopy& map) {
    const shadow::ProgramRow& row = frame.inputs.front().lights[light].row;
    if (row.filter_file.empty()) return std::make_unique<LitLight>();
    for (const CompiledRow& compiled : kRows)
        if (compiled.kind_file == row.kind_file && compiled.filter_file == row.filter_file)
            return compiled.make(frame, scene.consumers.front(), light, map);
    return nullptr;
}

double steep_tangent() { return glsl::compare::directional::Kind::kSteepTangent; }

}  // namespace gnomon::bench
