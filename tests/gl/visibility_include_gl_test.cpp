#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>
#include <ostream>
#include <random>
#include <sstream>

#include "engine/math/projection.h"
#include "shaders/embedded.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/prefilter_settings.h"
#include "tests/gl/moment_maps.h"
#include "tests/source_paths.h"

namespace gnomon::shadow {
void PrintTo(const FilterRow& row, std::ostream* out) { *out << row.name; }
}  // namespace gnomon::shadow

// shadow_visibility(), as a forward renderer would include it, on a map drawn by hand. The pipeline's own fits never
// leave a point outside the map or beyond its far plane; here such points occur and must be lit.
namespace gnomon {
namespace {

constexpr std::uint32_t kDrawnMap_px = 64;
constexpr std::uint32_t kProbeBinding = 7;  // in probe.frag, beyond what rows bind
constexpr double kMapNear_m = 1.0, kMapFar_m = 9.0, kHalf = 1.0;  // half: metres of the sun's map, tangent of the spot's

// The worked example of docs/contributors/adding_a_filter.md: a file and a row.
std::string diamond_file() {
    std::ifstream file(test::source_folder() / "tests/gl/diamond.glsl");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}
// [row]
std::uint32_t five(const ShadowTuning::Kernel&, bool) { return 5; }

constexpr shadow::FilterRow kDiamond{
    ShadowFilter::count, "diamond", "shadow/filters/diamond.glsl", five, 1.5f, shadow::FilterWidth::fixed,
    shadow::MapReading::compare_nearest};
// [row]

/// Points are relative to the camera, which is at the light; the light shines along -z.
class VisibilityInclude : public MomentMapTest, public ::testing::WithParamInterface<shadow::FilterRow> {
protected:
    /// Returns the record of a light at the origin that looks along -z.
    static shadow::LightRecord record(LightKind kind) {
        const bool sun = kind == LightKind::directional;
        const double range_m = kMapFar_m - kMapNear_m;
        const glm::dmat4 clip = sun ? math::reversed_orthographic(-kHalf, kHalf, -kHalf, kHalf, kMapNear_m, kMapFar_m)
                                    : math::reversed_perspective(-kHalf, kHalf, -kHalf, kHalf, kMapNear_m, kMapFar_m);
        shadow::LightRecord light;
        light.options = {1, 1, 0, 0x3f};  // one view, constant bias, every face drawn
        light.bias.x = 0.01f;
        light.views[0].map_from_anchor = glm::mat4(math::texture_from_clip() * clip);
        light.to_light.z = 1.0f;
        light.views[0].axis_u = {1.0f, 0.0f, 0.0f, static_cast<float>(2.0 * kHalf / kDrawnMap_px)};
        light.views[0].axis_v = {0.0f, 1.0f, 0.0f, light.views[0].axis_u.w};
        light.views[0].axis_back = {0.0f, 0.0f, 1.0f, static_cast<float>(sun ? range_m : kMapNear_m * kMapFar_m / range_m)};
        light.views[0].numeric.z = static_cast<float>(-kMapNear_m / range_m);
        return light;
    }

    void SetUp() override {
        GlTest::SetUp();
        row_ = GetParam();
        if (is_soft()) settings_ = kSource;
    }
    /// Uses another row than the test's parameter.
    void use(const shadow::FilterRow& row, const LightItem& settings) {
        row_ = row;
        settings_ = settings;
        programs_ = {};
    }

    bool reads_depths() const { return row_.reading == shadow::MapReading::depths; }
    bool reads_triangles() const { return row_.storage.triangle_ids; }
    bool reads_moments() const { return row_.moments; }
    /// Returns a texture of triangles without any: a map drawn by hand shows casters that are no triangles.
    gl::TextureHandle no_triangles(gl::TextureKind kind) {
        const std::vector<std::uint32_t> none(std::size_t{kDrawnMap_px} * kDrawnMap_px * 2 * (kind == gl::TextureKind::cube ? 6 : 1), 0xffffffffu);
        return keep(device().create_texture({.label = "triangles", .kind = kind, .format = gl::Format::rg32ui, .width = kDrawnMap_px, .height = kDrawnMap_px},
                                            std::as_bytes(std::span(none))));
    }
    /// Returns whether values between lit and dark occur.
    bool blends() const { return row_.id != ShadowFilter::hard && (!reads_depths() || is_soft()); }
    bool is_soft() const { return row_.width == shadow::FilterWidth::source; }
    LightItem item(LightKind kind) const {
        LightItem light = settings_;
        light.kind = kind;
        return light;
    }
    shadow::FilterSettings filtering(LightKind kind) const { return shadow::filter_settings(row_, item(kind), kDrawnMap_px); }
    /// Returns E in the tangent or metres of the map.
    double reach(LightKind kind) const {
        return static_cast<double>(filtering(kind).widest_texel) * 2.0 * kHalf / kDrawnMap_px;
    }

    /// Returns the row as a program that looks up a list of probes.
    gl::ProgramHandle program_of(LightKind kind) {
        gl::ProgramHandle& program = programs_[static_cast<std::size_t>(kind)];
        if (program) return program;
        const auto& kind_row = shadow::light_kind_row(kind);
        const shadow::ShaderKey program_row{.kind_define = kind_row.define,
                                             .kind_file = kind_row.file,
                                             .filter_file = row_.file,
                                             .reach_texel = filtering(kind).reach_texel,
                                             .depths = reads_depths(),
                                             .triangles = reads_triangles(),
                                             .moments = reads_moments()};
        const std::string row = shadow::row_glsl(program_row);
        const std::string fragment =
            "#include \"row.glsl\"\n#include \"shadow/lookup/visibility.glsl\"\n"
            "layout(std430, binding = 7) readonly buffer Probes { vec4 probes[]; };\n"
            "layout(location = 0) out float result;\n"
            "void main() { result = shadow_visibility(probes[2 * int(gl_FragCoord.x)].xyz, probes[2 * int(gl_FragCoord.x) + 1].xyz, 0.0); }\n";
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        files.push_back({"row.glsl", row});
        files.push_back({"probe.frag", fragment});
        const std::string diamond = diamond_file();
        files.push_back({kDiamond.file, diamond});
        const std::vector<std::string> defines = shadow::program_defines(program_row);
        const auto vertex = gl::expand_shader(files, "common/fullscreen.vert", defines);
        const auto expanded = gl::expand_shader(files, "probe.frag", defines);
        if (!vertex || !expanded) {
            ADD_FAILURE() << "the include does not stand alone";
            return {};
        }
        return program = keep(device().create_program({"probe", vertex.value(), expanded.value()}));
    }

    /// Returns the normal of a plane across the map, or across the face of the cube.
    static glm::vec3 facing(LightKind kind, const glm::vec3& p) {
        const glm::vec3 size = glm::abs(p);
        if (kind != LightKind::point || (size.z >= size.x && size.z >= size.y)) return {0.0f, 0.0f, p.z > 0.0f ? -1.0f : 1.0f};
        return size.x >= size.y ? glm::vec3(p.x > 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, p.y > 0.0f ? -1.0f : 1.0f, 0.0f);
    }

    /// Returns the visibility of the points. `texels`: the map's, reversed depth, row by row, face by face.
    std::vector<float> look_up(LightKind kind, std::span<const float> texels, const std::vector<glm::vec3>& points, bool early_bail = false) {
        const auto& kind_row = shadow::light_kind_row(kind);
        const auto map = keep(device().create_texture({.label = "map", .kind = kind_row.texture, .format = gl::Format::d32f, .width = kDrawnMap_px, .height = kDrawnMap_px},
                                                      std::as_bytes(texels)));
        std::vector<glm::vec4> probes;
        for (const glm::vec3& p : points) {
            probes.emplace_back(p, 0.0f);
            probes.emplace_back(facing(kind, p), 0.0f);
        }
        const auto probe_bytes = std::as_bytes(std::span(probes));
        const auto buffer = keep(device().create_buffer({.label = "probes", .size = probe_bytes.size(), .use = gl::BufferUse::fixed}, probe_bytes));
        shadow::LightRecord light = record(kind);
        const shadow::FilterSettings filter = filtering(kind);
        light.filtering = {static_cast<int>(filter.size), static_cast<int>(filter.taps), early_bail ? 1 : 0, 1};
        light.spread = {filter.spread_texel, 0.0f, 0.0f, filter.most_spread_texel};
        light.seed_place.w = 1.0f / filter.cell_m;
        const shadow::PrefilterSettings moments = shadow::prefilter_settings(row_, item(kind), kDrawnMap_px);
        light.moments = moments.settings;
        light.moment_sampling.x = moments.bleeding;
        light.radiance.w = kind == LightKind::directional ? filter.sun_radius_tan : filter.source_radius_m;
        const auto uniforms = keep(device().create_buffer({.label = "light", .size = sizeof light, .use = gl::BufferUse::fixed},
                                                          std::as_bytes(std::span(&light, 1))));
        const auto width = static_cast<std::uint32_t>(points.size());
        const auto texture = keep(device().create_texture({.label = "result", .format = gl::Format::r32f, .width = width}, {}));
        const auto target = keep(device().create_target({.label = "result", .colours = {{texture}}}));
        const auto sampler = keep(device().create_sampler({.label = "map", .linear = row_.reading == shadow::MapReading::compare_linear || reads_moments(), .compare = !reads_depths() && !reads_moments(),
                                                           .wrap_u = reads_moments() ? gl::Wrap::clamp : gl::Wrap::border,
                                                           .wrap_v = reads_moments() ? gl::Wrap::clamp : gl::Wrap::border}));
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target, .viewport = {0, 0, static_cast<std::int32_t>(width), 1}});
        list.add(gl::SetPipeline{{.program = program_of(kind)}});
        list.add(gl::BindUniforms{1, uniforms, 0, sizeof light});
        list.add(gl::BindStorage{kProbeBinding, buffer});
        list.add(gl::BindTexture{
            4, reads_moments() ? moments_of(row_, item(kind), map, kDrawnMap_px, {kMapNear_m, kMapFar_m}) : map, sampler});
        if (reads_triangles()) list.add(gl::BindTexture{5, no_triangles(kind_row.texture), {}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        return read<float>(texture, width);
    }

    /// Returns the visibility of the points in a map with a caster at `map_depth` in every texel (0: none).
    std::vector<float> evaluate(LightKind kind, float map_depth, const std::vector<glm::vec3>& points) {
        return look_up(kind, std::vector<float>(texels_of(kind), map_depth), points);
    }

    static std::size_t texels_of(LightKind kind) { return std::size_t{kDrawnMap_px} * kDrawnMap_px * (kind == LightKind::point ? 6 : 1); }

    /// Returns a map with a caster before every texel that looks toward negative x, and none before the others.
    static std::vector<float> half_covered(LightKind kind) {
        std::vector<float> texels(texels_of(kind), 0.0f);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const double u = (static_cast<double>(i % kDrawnMap_px) + 0.5) / kDrawnMap_px * 2.0 - 1.0;
            const double v = (static_cast<double>(i / kDrawnMap_px % kDrawnMap_px) + 0.5) / kDrawnMap_px * 2.0 - 1.0;
            double x = u;
            if (kind == LightKind::point) {
                const shadow::CubeFace& face = shadow::cube_face(static_cast<std::uint32_t>(i / kDrawnMap_px / kDrawnMap_px));
                x = (face.axis_u * u + face.axis_v * v - face.axis_back).x;
            }
            if (x < 0.0) texels[i] = kMiddle;
        }
        return texels;
    }

    /// Returns places all over what the light sees, between `nearest_m` and `farthest_m` along the view. They include
    /// seams and corners of cubes, borders of maps and the far end of the range.
    static std::vector<glm::vec3> places(LightKind kind, double nearest_m, double farthest_m) {
        std::mt19937 random(20240229);
        std::uniform_real_distribution<double> share(-1.0, 1.0);
        std::vector<glm::vec3> found;
        for (int i = 0; i < 1500; ++i) {
            const double z_m = i % 5 == 0 ? farthest_m : nearest_m + (farthest_m - nearest_m) * 0.5 * (1.0 + share(random));
            glm::dvec3 p(share(random), share(random), -1.0);
            if (i % 3 == 0) p.y = share(random) < 0.0 ? -1.0 : 1.0;  // a border, or a seam
            if (i % 12 == 0) p.x = share(random) < 0.0 ? -1.0 : 1.0;  // a corner
            if (kind == LightKind::point && i % 2 == 0) p = share(random) < 0.0 ? glm::dvec3(p.z, p.x, p.y) : glm::dvec3(p.y, -p.z, p.x);
            if (kind == LightKind::directional) found.emplace_back(p.x * kHalf, p.y * kHalf, -z_m);
            else found.emplace_back(p * z_m);
        }
        return found;
    }

    /// Returns the distance to where half_covered() changes: metres (sun) or a tangent, negative at the caster's side.
    static double from_edge(LightKind kind, const glm::vec3& p) {
        const double x = static_cast<double>(p.x);
        if (kind == LightKind::directional) return x;
        return x / static_cast<double>(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
    }

    /// Source for rows that read one: seen from half_covered()'s receivers it is a few texels wide at the casters.
    const LightItem kSource = [] {
        LightItem light;
        light.source_radius_m = 0.3f, light.sun_radius_rad = 0.05f;
        return light; }();
    static constexpr float kWeights = 1e-6f;  // a sampler's weights sum up to 1 except for rounding
    static constexpr float kMiddle = 0.5f;  // a depth between near and far
    static constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

private:
    shadow::FilterRow row_{};
    LightItem settings_;
    std::array<gl::ProgramHandle, 3> programs_{};
};

TEST_P(VisibilityInclude, InsideTheMapACasterInFrontDarkensAndOneBehindDoesNot) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(shadow::light_kind_row(kind).name);
        const std::vector<glm::vec3> far_points{{0.1f, 0.2f, -8.5f}}, near_points{{0.05f, -0.1f, -1.05f}};
        EXPECT_NEAR(evaluate(kind, kMiddle, far_points).front(), 0.0f, 1e-5f);
        EXPECT_NEAR(evaluate(kind, kMiddle, near_points).front(), 1.0f, 1e-5f);
        EXPECT_NEAR(evaluate(kind, 0.0f, far_points).front(), 1.0f, 1e-5f) << "an empty map is lit";
    }
}

TEST_P(VisibilityInclude, OutsideTheMapAPointIsLitWhateverTheMapHolds) {
    const float deep = -8.0f;
    const float sun_edge = static_cast<float>(kHalf), spot_edge = static_cast<float>(kHalf) * -deep;
    for (const float beyond : {1.01f, 1.5f, 100.0f, 1.0e6f}) {
        SCOPED_TRACE(beyond);
        for (const float v : evaluate(LightKind::directional, 1.0f,
                                      {{sun_edge * beyond, 0.0f, deep}, {-sun_edge * beyond, 0.0f, deep}, {0.0f, sun_edge * beyond, deep}, {0.0f, -sun_edge * beyond, deep}}))
            EXPECT_EQ(v, 1.0f);
        for (const float v : evaluate(LightKind::spot, 1.0f,
                                      {{spot_edge * beyond, 0.0f, deep}, {-spot_edge * beyond, 0.0f, deep}, {0.0f, spot_edge * beyond, deep}, {0.0f, -spot_edge * beyond, deep}}))
            EXPECT_EQ(v, 1.0f);
    }
}

TEST_P(VisibilityInclude, BehindASpotsMapAPointIsNotMirroredIntoIt) {
    for (const float v : evaluate(LightKind::spot, 1.0f, {{0.0f, 0.0f, 5.0f}, {0.1f, 0.1f, 0.5f}, {0.0f, 0.0f, 1.0e-6f}})) EXPECT_EQ(v, 1.0f);
}

TEST_P(VisibilityInclude, BeyondTheFarPlaneAnEmptyMapIsLit) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(shadow::light_kind_row(kind).name);
        for (const float v : evaluate(kind, 0.0f, {{0.0f, 0.0f, -9.5f}, {0.0f, 0.1f, -1.0e3f}, {0.1f, 0.0f, -1.0e7f}}))
            EXPECT_NEAR(v, 1.0f, 1e-5f);
    }
}

TEST_P(VisibilityInclude, FartherThanItsHalfWidthFromACastersEdgeItIsLitOrDarkAndNothingBetween) {
    // Beyond the caster, which is at 1.8 m of a spot and 5 m of a sun.
    for (const LightKind kind : kKinds)
        for (const bool early_bail : {false, true}) {
            SCOPED_TRACE(std::string(shadow::light_kind_row(kind).name) + (early_bail ? ", bailing early" : ""));
            const auto points = places(kind, 5.5, 8.8);
            const auto values = look_up(kind, half_covered(kind), points, early_bail);
            // A flat map leaves a border; a texel of the next face is larger by what lies beyond the seam.
            const double border = kind == LightKind::point ? 2.0 : 1.0 - reach(kind);
            const double clear = reach(kind) * (kind == LightKind::point ? 1.0 + 2.0 * reach(kind) : 1.0);
            std::size_t dark = 0, lit = 0, between = 0, inside = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double away = from_edge(kind, points[i]);
                ASSERT_TRUE(values[i] >= 0.0f && values[i] <= 1.0f) << values[i] << " at " << i;
                const double across = kind == LightKind::directional ? 1.0 : static_cast<double>(-points[i].z);
                const bool in_map = std::abs(points[i].x / across) < border && std::abs(points[i].y / across) < border;
                if (kind != LightKind::point && !in_map) continue;
                between += std::abs(away) < clear && values[i] > 0.0f && values[i] < 1.0f;
                inside += std::abs(away) < 0.5 * clear;
                if (std::abs(away) <= clear + 1e-5) continue;
                const float expected = away < 0.0 ? 0.0f : 1.0f;
                EXPECT_NEAR(values[i], expected, kWeights) << "at " << points[i].x << " " << points[i].y << " " << points[i].z;
                (expected > 0.0f ? lit : dark) += 1;
            }
            const auto enough =
                static_cast<std::size_t>(200.0 * (1.0 - 2.0 * reach(kind)));  // wide ones leave fewer
            EXPECT_GT(lit, enough);
            EXPECT_GT(dark, enough);
            EXPECT_GT(inside, 5u) << "nothing near the edge: the test sees nothing";
            // What is prefiltered takes nothing behind the caster for something far away, and is lit.
            if (reads_moments()) continue;
            if (blends()) {
                EXPECT_GT(between, 5u);
            } else {
                EXPECT_EQ(between, 0u);
            }
        }
}

TEST_P(VisibilityInclude, InAnyMapAtAnyPlaceItIsAShare) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> depth(0.0f, 1.0f);
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(shadow::light_kind_row(kind).name);
        std::vector<float> texels(texels_of(kind));
        for (float& texel : texels) texel = depth(random);
        std::vector<glm::vec3> points = places(kind, kMapNear_m, kMapFar_m);
        for (const float size : {0.0f, 1e-30f, 1e-6f, 0.999f, 9.0f, 9.001f, 1e6f, 1e18f})
            for (const glm::vec3 d : {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(1, 1, -1), glm::vec3(-1, 1, 1), glm::vec3(1, 0, 0)})
                points.push_back(size * d);
        std::size_t between = 0;
        for (const bool early_bail : {false, true})
            for (const float value : look_up(kind, texels, points, early_bail)) {
                ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << value;
                between += value > 0.0f && value < 1.0f;
            }
        EXPECT_EQ(between > 0, blends());
    }
}

// The sampler's weights have 8 bits; positions in the map add some of their own.
constexpr float kBlendError = 0.02f;

class FewestFetches : public VisibilityInclude {};

TEST_P(FewestFetches, AreTheMeanOfASquareOfHardwareTapsATexelApart) {
    shadow::FilterRow plain = shadow::filter_row(ShadowFilter::pcf_grid);
    plain.reading = shadow::MapReading::compare_linear;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> depth(0.0f, 1.0f);
    for (const LightKind kind : kKinds) {
        std::vector<float> texels(texels_of(kind));
        for (float& texel : texels) texel = depth(random) < 0.5f ? 0.0f : 1.0f;
        std::vector<glm::vec3> points;
        std::uniform_real_distribution<float> place(-0.7f, 0.7f);  // seams apart: there the grids of two faces meet
        for (int i = 0; i < 500; ++i) points.push_back({place(random) * (kind == LightKind::directional ? 1.0f : 8.0f), place(random), -8.0f});
        for (const std::uint32_t size : {1u, 3u, 5u, 7u}) {
            SCOPED_TRACE(std::string(shadow::light_kind_row(kind).name) + " " + std::to_string(size));
            LightItem wide;
            wide.tuning.kernel.size_texel = size;
            use(plain, wide);
            const auto wanted = look_up(kind, texels, points);
            use(GetParam(), wide);
            const auto found = look_up(kind, texels, points);
            float worst = 0.0f, range = 0.0f;
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                worst = std::max(worst, std::abs(wanted[i] - found[i]));
                range = std::max(range, std::abs(wanted[i] - wanted[0]));
            }
            EXPECT_LT(worst, kBlendError);
            EXPECT_GT(range, 5.0f * kBlendError) << "every place looks the same";
            EXPECT_EQ(GetParam().taps(wide.tuning.kernel, false), (size + 1) * (size + 1) / 4);
            EXPECT_EQ(plain.taps(wide.tuning.kernel, false), size * size);
        }
    }
}

std::vector<shadow::FilterRow> map_filters() {
    std::vector<shadow::FilterRow> rows;
    std::copy_if(shadow::filter_table().begin(), shadow::filter_table().end(), std::back_inserter(rows),
                 [](const shadow::FilterRow& row) { return !row.rays; });
    return rows;
}

INSTANTIATE_TEST_SUITE_P(EachFilter, VisibilityInclude, ::testing::ValuesIn(map_filters()),
                         [](const auto& row) { return std::string(row.param.name); });

INSTANTIATE_TEST_SUITE_P(OfAGrid, FewestFetches, ::testing::Values(shadow::filter_row(ShadowFilter::pcf_bilinear)));

INSTANTIATE_TEST_SUITE_P(AddedByTheGuide, VisibilityInclude, ::testing::Values(kDiamond));

}  // namespace
}  // namespace gnomon
