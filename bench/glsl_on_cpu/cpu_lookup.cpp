#include "bench/glsl_on_cpu/cpu_lookup.h"

#include "bench/glsl_on_cpu/light_block_values.h"
#include "bench/glsl_on_cpu/samplers.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench::glsl {
namespace {

#include "bench/glsl_on_cpu/shader_structs.inc"

/// Returns the views of a light in the order in which they were published.
std::vector<const shadow::ShadowView*> published_views(const shadow::ShadowFrame& frame, std::uint32_t light) {
    const shadow::DrawnViews drawn = shadow::drawn_views(frame);
    std::vector<const shadow::ShadowView*> views;
    const shadow::IndexRange range = drawn.fitted.lights[light].views;
    for (std::size_t v = range.first; v < range.end(); ++v)
        if (drawn.has_map(v)) views.push_back(&drawn.view(v));
    return views;
}

struct CopiedTexels final : MapTexels {
    explicit CopiedTexels(const MapCopy& copy) : copied(copy) { size_px = copy.size_px; }
    double texel(int layer, std::uint32_t column, std::uint32_t row) const override {
        return static_cast<double>(copied.texels[index(layer, column, row)]);
    }
    uvec2 triangle(int layer, std::uint32_t column, std::uint32_t row) const override {
        const glm::uvec2 shown = copied.triangles[index(layer, column, row)];
        return {shown.x, shown.y};
    }
    std::size_t index(int layer, std::uint32_t column, std::uint32_t row) const {
        const std::size_t n = size_px;
        return (static_cast<std::size_t>(layer) * n + row) * n + column;
    }
    const MapCopy& copied;
};

template <class Row>
class RowLight final : public ExactLight {
public:
    RowLight(const shadow::ShadowFrame& frame, const SceneSnapshot& scene, std::uint32_t light, const MapCopy& map,
             const CasterTriangleList& casters)
        : camera_ws_m_(scene.consumers.front().position_ws_m), texels_(map) {
        if constexpr (ReadsTriangles<Row>) set_casters(scene.instances, casters, camera_ws_m_, row_);
        const auto views = published_views(frame, light);
        set_light(frame.inputs.front().lights[light], views, camera_ws_m_, row_);
        const ShadowFilter filter = frame.decisions[light].request.map.filter;
        row_.shadow_map.linear = shadow::filter_row(filter).reading == shadow::MapReading::compare_linear;
    }

    void evaluate(std::span<const SurfacePoint> points, std::span<ExactVisibility> values) const override {
        Row row = row_;
        Trace trace;
        set_map(texels_, trace, row);
        for (std::size_t i = 0; i < points.size(); ++i) {
            trace = {};
            const glm::dvec3 position_ca = points[i].position_ws_m - camera_ws_m_;
            const double value = row.shadow_visibility(to_vec3(position_ca), to_vec3(points[i].normal_ws), 0.0);
            values[i] = {static_cast<float>(value), trace.layers, trace.margin_texel < kEdge_texel, trace.taps};
        }
    }

private:
    Row row_;
    glm::dvec3 camera_ws_m_;
    CopiedTexels texels_;
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
std::unique_ptr<ExactLight> make_row(const shadow::ShadowFrame& frame, const SceneSnapshot& scene, std::uint32_t light,
                                     const MapCopy& map, const CasterTriangleList& casters) {
    return std::make_unique<glsl::RowLight<Row>>(frame, scene, light, map, casters);
}

struct CompiledRow {
    std::string_view kind_file, filter_file;
    decltype(&make_row<glsl::compare::directional::row_hard>) make;
};
#define ROWS_OF_FILTER(name, reading, file)                                                           \
    {"shadow/lookup/kinds/directional.glsl", file, make_row<glsl::reading::directional::row_##name>}, \
        {shadow::kWarpedSunFile, file, make_row<glsl::reading::directional_warped::row_##name>},      \
        {"shadow/lookup/kinds/spot.glsl", file, make_row<glsl::reading::spot::row_##name>},           \
        {"shadow/lookup/kinds/point.glsl", file, make_row<glsl::reading::point::row_##name>},
constexpr CompiledRow kRows[] = {GNOMON_FILTERS(ROWS_OF_FILTER)};
#undef ROWS_OF_FILTER

}  // namespace

std::unique_ptr<ExactLight> make_exact_light(const shadow::ShadowFrame& frame, const SceneSnapshot& scene,
                                             std::uint32_t light, const MapCopy& map,
                                             const CasterTriangleList& casters) {
    const shadow::ShaderKey& row = frame.inputs.front().lights[light].row;
    if (row.filter_file.empty()) return std::make_unique<LitLight>();
    for (const CompiledRow& compiled : kRows)
        if (compiled.kind_file == row.kind_file && compiled.filter_file == row.filter_file)
            return compiled.make(frame, scene, light, map, casters);
    return nullptr;
}

double steep_tangent() { return glsl::compare::directional::Kind::kSteepTangent; }

double faded_by_distance(double start_m, double end_m, double distance_m) {
    return glsl::compare::directional::Kind{}.share_between(start_m, end_m, distance_m);
}

double faded_near_border(double nearest, double blend) {
    return glsl::compare::directional::Kind{}.share_near_border(nearest, blend);
}

}  // namespace gnomon::bench
