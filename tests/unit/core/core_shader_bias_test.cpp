#include <gtest/gtest.h>

#include <cmath>

#include "bench/glsl_on_cpu/glsl_types.h"
#include "tests/unit/core/core_scene.h"
#include "tests/unit/math/random_seed.h"

/// offset_at() is the shader's own bias: its text, compiled in double, gives the same.
namespace gnomon::bench::glsl {
namespace {

#include "bench/glsl_on_cpu/begin_double.inc"
struct AutomaticBias {
#include "shaders/shadow/lookup/light_block.glsl"

#include "shaders/shadow/lookup/bias/automatic.glsl"
};
// The guide's, for shaders of engines on other APIs.
using float2 = vec2;
using float3 = vec3;
struct GuideBias {
    float2 texel;
    double reach_texel = 0.0, depth = 0.0, depth_share = 0.0, near_m = 0.0, far_m = 0.0;
    bool orthographic = false;
#include "tests/unit/core/shadow_offset.hlsl"
};
#include "bench/glsl_on_cpu/end_double.inc"

vec3 turned(const core::View& view, const glm::dvec3& v) {
    return {glm::dot(v, view.axis_u), glm::dot(v, view.axis_v), glm::dot(v, view.axis_back)};
}

/// Returns what the shader computes for a view at a place.
core::Offset by_shader(const core::View& view, const glm::dvec3& p, const glm::dvec3& n) {
    AutomaticBias shader;
    AutomaticBias::ViewRecord record;
    record.axis_u.w = view.bias.texel.x;
    record.axis_v.w = view.bias.texel.y;
    const bool flat = view.kind == core::ViewKind::orthographic;
    const double range_m = view.far_m - view.near_m;
    record.axis_back.w = flat ? range_m : view.near_m * view.far_m / range_m;
    record.numeric.x = view.bias.depth;
    record.numeric.z = -view.near_m / range_m;
    const double reach_texel = view.bias.reach_texel - AutomaticBias::kRasterSnap_texel;
    const glm::dvec3 from_anchor = p - view.anchor_ws_m;
    const double error_m = AutomaticBias::kPositionRounding *
                           (flat ? std::abs(from_anchor.x) + std::abs(from_anchor.y) + std::abs(from_anchor.z)
                                 : glm::length(from_anchor));
    const vec3 n_map = turned(view, n);
    const vec3 p_map = turned(view, p - view.eye_ws_m);
    const AutomaticBias::Bias bias =
        flat ? shader.orthographic_bias(record, n_map, reach_texel, error_m)
             : shader.perspective_bias(record, n_map, vec2(std::abs(n_map.x), std::abs(n_map.y)),
                                       std::max(-n_map.z, 0.0), p_map, reach_texel, error_m);
    return {bias.along_normal_m, bias.depth};
}

/// Returns what the guide's shader computes, with a normal that is exact.
core::Offset by_guide(const core::View& view, const glm::dvec3& p, const glm::dvec3& n) {
    GuideBias guide;
    guide.texel = vec2(view.bias.texel.x, view.bias.texel.y);
    guide.reach_texel = view.bias.reach_texel;
    guide.depth = view.bias.depth;
    guide.depth_share = view.bias.depth_share;
    guide.near_m = view.near_m;
    guide.far_m = view.far_m;
    guide.orthographic = view.kind == core::ViewKind::orthographic;
    const glm::dvec3 d = glm::abs(p - view.anchor_ws_m);
    const double error_m = AutomaticBias::kPositionRounding * (guide.orthographic ? d.x + d.y + d.z : glm::length(d));
    const vec2 offset = guide.shadow_offset(turned(view, n), turned(view, p - view.eye_ws_m), error_m);
    return {offset.x, offset.y};
}

/// Returns true if the two differ by less than the digits of the shader's constants.
bool near(double a, double b) { return std::abs(a - b) <= 1e-7 * (std::abs(a) + std::abs(b)); }

TEST(CoreShaderBias, IsTheShadersOwn) {
    core::Random random(print_seed());
    core::History history;
    core::Fits fits;
    const core::OwnScene own = core::courtyard();
    core::fit_shadows(own.scene(), {}, history, fits);
    int compared = 0, steep = 0, seams = 0;
    for (const core::View& view : fits.views())
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 p = random.inside({-8.0, 0.0, -8.0}, {8.0, 2.0, 8.0});
            if (!core::holds(core::map_place(view, p))) continue;
            const glm::dvec3 toward = core::way_to(own.lights[view.light], p).toward;
            const glm::dvec3 n = glm::normalize(toward + random.number(0.0, 6.0) * random.inside(glm::dvec3(-1.0), glm::dvec3(1.0)));
            if (glm::dot(n, toward) <= 0.001) continue;
            const core::Offset mine = core::offset_at(view, p, n), theirs = by_shader(view, p, n);
            const glm::dvec3 place = core::map_place(view, p);
            const double border = 8.0 / fits.lights()[view.light].map_px;
            const bool seam = view.kind == core::ViewKind::cube_face &&
                              std::min({place.x, place.y, 1.0 - place.x, 1.0 - place.y}) < border;
            if (seam) {  // kinds/point.glsl hands it more of the normal there
                EXPECT_GE(mine.along_normal_m + mine.depth, (theirs.along_normal_m + theirs.depth) * (1.0 - 1e-7));
                ++seams;
                continue;
            }
            EXPECT_TRUE(near(mine.along_normal_m, theirs.along_normal_m)) << mine.along_normal_m << ' ' << theirs.along_normal_m;
            EXPECT_TRUE(near(mine.depth, theirs.depth)) << mine.depth << ' ' << theirs.depth;
            const core::Offset exact = core::offset_at(view, p, n, 0.0, 0.0), guide = by_guide(view, p, n);
            EXPECT_TRUE(near(exact.along_normal_m, guide.along_normal_m)) << exact.along_normal_m << ' ' << guide.along_normal_m;
            EXPECT_TRUE(near(exact.depth, guide.depth)) << exact.depth << ' ' << guide.depth;
            ++compared;
            steep += mine.along_normal_m > 0.0 ? 1 : 0;
        }
    EXPECT_GT(compared, 3000);
    EXPECT_GT(steep, 100);
    EXPECT_LT(steep, compared - 100) << "both forms";
    EXPECT_GT(seams, 0);
}

}  // namespace
}  // namespace gnomon::bench::glsl
