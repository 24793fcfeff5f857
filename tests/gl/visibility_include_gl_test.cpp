#include <glm/gtc/matrix_transform.hpp>

#include "engine/math/projection.h"
#include "shaders/embedded.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/types.h"
#include "tests/gl/gl_test_context.h"

// shadow_visibility(), as a forward renderer would include it, on a map drawn by hand: what the pipeline's own fits
// never let happen (a point outside the map or beyond its far plane) must still be lit.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 64;
constexpr double kNear_m = 1.0, kFar_m = 9.0, kHalf = 1.0;  // half: metres of the sun's map, tangent of the spot's

/// Points are relative to the camera, which is at the light; the light shines along -z.
class VisibilityInclude : public GlTest, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    /// A record for a light at the origin that looks along -z.
    static shadow::LightRecord record(LightKind kind) {
        const bool sun = kind == LightKind::directional;
        const double range_m = kFar_m - kNear_m;
        const glm::dmat4 clip = sun ? math::reversed_orthographic(-kHalf, kHalf, -kHalf, kHalf, kNear_m, kFar_m)
                                    : math::reversed_perspective(-kHalf, kHalf, -kHalf, kHalf, kNear_m, kFar_m);
        shadow::LightRecord light;
        light.options = {1, 1, 0, 0x3f};  // one view, constant bias, every face drawn
        light.bias.x = 0.01f;
        light.views[0].map_from_anchor = glm::mat4(math::texture_from_clip() * clip);
        const float texel = static_cast<float>(2.0 * kHalf / kMap_px);
        light.views[0].axis_u = {1.0f, 0.0f, 0.0f, texel};
        light.views[0].axis_v = {0.0f, 1.0f, 0.0f, texel};
        light.views[0].axis_back = {0.0f, 0.0f, 1.0f, static_cast<float>(sun ? range_m : kNear_m * kFar_m / range_m)};
        light.views[0].numeric.z = static_cast<float>(-kNear_m / range_m);
        return light;
    }

    /// A map whose every texel holds a caster at `depth` (reversed; 0: none).
    gl::TextureHandle map_with(float depth, gl::TextureKind kind) {
        const std::vector<float> texels(kMap_px * kMap_px * (kind == gl::TextureKind::cube ? 6 : 1), depth);
        return keep(device().create_texture({.label = "map", .kind = kind, .format = gl::Format::d32f, .width = kMap_px, .height = kMap_px},
                                            std::as_bytes(std::span(texels))));
    }

    std::vector<float> evaluate(LightKind kind, float map_depth, const std::vector<glm::vec3>& points) {
        const auto& kind_row = shadow::light_kind_row(kind);
        const auto& filter = shadow::filter_row(GetParam());
        const std::string row = "#include \"" + std::string(kind_row.file) + "\"\n#include \"" + std::string(filter.file) + "\"\n";
        const std::string fragment =
            "#include \"row.glsl\"\n#include \"shadow/visibility.glsl\"\n"
            "layout(std430, binding = 0) readonly buffer Probes { vec4 probes[]; };\n"
            "layout(location = 0) out float result;\n"
            "void main() { result = shadow_visibility(probes[int(gl_FragCoord.x)].xyz, vec3(0.0, 0.0, 1.0), 0.0); }\n";
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        files.push_back({"row.glsl", row});
        files.push_back({"probe.frag", fragment});
        const std::vector<std::string> defines{"SHADOWED 1", "SHADOW_REACH_TEXEL " + std::to_string(filter.reach_texel)};
        const auto vertex = gl::expand_shader(files, "shared/fullscreen.vert", defines);
        const auto expanded = gl::expand_shader(files, "probe.frag", defines);
        if (!vertex || !expanded) {
            ADD_FAILURE() << "the include does not stand alone";
            return {};
        }
        const auto program = keep(device().create_program({"probe", vertex.value(), expanded.value()}));
        std::vector<glm::vec4> probes;
        for (const glm::vec3& p : points) probes.emplace_back(p, 0.0f);
        const auto probe_bytes = std::as_bytes(std::span(probes));
        const auto buffer = keep(device().create_buffer({.label = "probes", .size = probe_bytes.size(), .use = gl::BufferUse::fixed}, probe_bytes));
        const shadow::LightRecord light = record(kind);
        const auto uniforms = keep(device().create_buffer({.label = "light", .size = sizeof light, .use = gl::BufferUse::fixed},
                                                          std::as_bytes(std::span(&light, 1))));
        const auto width = static_cast<std::uint32_t>(points.size());
        const auto texture = keep(device().create_texture({.label = "result", .format = gl::Format::r32f, .width = width}, {}));
        const auto target = keep(device().create_target({.label = "result", .colours = {{texture}}}));
        const auto sampler = keep(device().create_sampler({.label = "compare", .linear = filter.linear_sampler, .compare = true,
                                                           .wrap_u = gl::Wrap::border, .wrap_v = gl::Wrap::border}));
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target, .viewport = {0, 0, static_cast<std::int32_t>(width), 1}});
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindUniforms{1, uniforms, 0, sizeof light});
        list.add(gl::BindStorage{0, buffer});
        list.add(gl::BindTexture{4, map_with(map_depth, kind_row.texture), sampler});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        return read<float>(texture, width);
    }

    static constexpr float kMiddle = 0.5f;  // a depth between near and far
};

TEST_P(VisibilityInclude, InsideTheMapACasterInFrontDarkensAndOneBehindDoesNot) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
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
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        SCOPED_TRACE(shadow::light_kind_row(kind).name);
        for (const float v : evaluate(kind, 0.0f, {{0.0f, 0.0f, -9.5f}, {0.0f, 0.1f, -1.0e3f}, {0.1f, 0.0f, -1.0e7f}}))
            EXPECT_NEAR(v, 1.0f, 1e-5f);
    }
}

INSTANTIATE_TEST_SUITE_P(EachFilter, VisibilityInclude,
                         ::testing::Values(ShadowFilter::hard, ShadowFilter::hardware_2x2, ShadowFilter::pcf_3x3),
                         [](const auto& row) { return std::string(shadow::filter_row(row.param).name); });

}  // namespace
}  // namespace gnomon
