#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench/glsl_on_cpu/glsl_types.h"
#include "tests/unit/math/random_seed.h"

/// The shader's own bias for warped maps, compiled in double and judged on planes: exact where the shader states so.
namespace gnomon::bench::glsl {
namespace {

constexpr int kSize_px = 1024;
vec2 shadow_map_size() { return {kSize_px, kSize_px}; }

#include "bench/glsl_on_cpu/begin_double.inc"
struct Shader {
#include "shaders/shadow/lookup/light_block.glsl"
#include "shaders/shadow/lookup/bias/automatic.glsl"
#include "shaders/shadow/lookup/bias/lispsm.glsl"
};
#include "bench/glsl_on_cpu/end_double.inc"

constexpr double kReach_texel = 0.5;

/// A warped view along z and a plane below it, both at random; the light's axes are the world's.
struct Case {
    Shader::ViewRecord view;
    vec2 gradient;
    double texel_m = 0.0, range_m = 0.0;
    vec3 normal, at;  // unit; the plane passes through `at`

    explicit Case(std::mt19937_64& random) {
        const auto number = [&](double from, double to) {
            return std::uniform_real_distribution<double>(from, to)(random);
        };
        const double length_m = std::exp(number(-5.0, 8.0)), stretch = std::exp(number(0.0, 4.0)) - 1.0;
        gradient = vec2(0.0, stretch / length_m);
        texel_m = length_m / (1.0 + stretch) / kSize_px;
        range_m = length_m * number(0.1, 3.0);
        for (int i = 0; i < 4; ++i) view.map_from_anchor[i] = vec4(0.0, 0.0, 0.0, 0.0);
        view.map_from_anchor[0].w = gradient.x;
        view.map_from_anchor[1].w = gradient.y;
        view.map_from_anchor[3].w = 1.0;
        // The rectangle may lie at any angle to the gradient.
        const double turn = number(0.0, 6.28);
        view.axis_u = vec4(std::cos(turn), std::sin(turn), 0.0, texel_m);
        view.axis_v = vec4(-std::sin(turn), std::cos(turn), 0.0, texel_m);
        view.axis_back = vec4(0.0, 0.0, 1.0, range_m);
        do normal = vec3(number(-1.0, 1.0), number(-1.0, 1.0), number(0.02, 1.0));
        while (!(length(normal) < 1.0));
        normal = normalize(normal);
        at = vec3(number(-0.5, 0.5) * length_m, number(0.0, 1.0) * length_m, number(0.1, 0.9) * range_m);
    }
    double w(const vec2& p) const { return 1.0 + dot(gradient, p); }
    vec2 in_map(const vec2& p) const {
        const vec2 q = p / w(p);
        return vec2(dot(q, view.axis_u.xy_()), dot(q, view.axis_v.xy_())) / texel_m;
    }
    vec2 from_map(const vec2& m) const {
        const vec2 q = view.axis_u.xy_() * (m.x * texel_m) + view.axis_v.xy_() * (m.y * texel_m);
        return q / (1.0 - dot(gradient, q));
    }
    double depth(const vec3& p) const { return p.z / (range_m * w(p.xy_())); }
    double plane_depth(const vec2& p) const {
        const double z = at.z - (normal.x * (p.x - at.x) + normal.y * (p.y - at.y)) / normal.z;
        return depth({p.x, p.y, z});
    }

    /// Returns how far the plane lies, in the worst corner of the footprint, above what is compared with it; in depth.
    double excess(double share_of_bias) const {
        Shader shader;
        const vec3 n_map(dot(normal, view.axis_u.xyz_()), dot(normal, view.axis_v.xyz_()), normal.z);
        const Shader::Bias bias = shader.cascade_bias(view, at, normal, n_map, kReach_texel, 0.0);
        const vec3 moved = at + normal * (bias.along_normal_m * share_of_bias);
        const double compared = depth(moved) + bias.depth * share_of_bias;
        const vec2 place = in_map(moved.xy_());
        double worst = -1e300;
        for (const double u : {-kReach_texel, kReach_texel})
            for (const double v : {-kReach_texel, kReach_texel})
                worst = std::max(worst, plane_depth(from_map(place + vec2(u, v))) - compared);
        return worst;
    }
};

TEST(WarpedBias, NoPlaneShadowsItselfAndWithNineTenthsOfItManyDo) {
    std::mt19937_64 random(print_seed());
    constexpr int kPlanes = 100000;
    int shadowed = 0, shadowed_with_less = 0, by_normal = 0;
    for (int i = 0; i < kPlanes; ++i) {
        const Case c(random);
        shadowed += c.excess(1.0) > 0.0 ? 1 : 0;
        shadowed_with_less += c.excess(0.9) > 0.0 ? 1 : 0;
        by_normal += std::hypot(c.normal.x, c.normal.y) > Shader::kSteepTangent * c.normal.z ? 1 : 0;
    }
    EXPECT_EQ(shadowed, 0);
    EXPECT_GT(shadowed_with_less, kPlanes / 2) << "a bias that is larger than it need be";
    EXPECT_GT(by_normal, kPlanes / 100) << "the steep branch is hardly tried";
    std::cout << shadowed_with_less << " of " << kPlanes << " with nine tenths, " << by_normal << " steep\n";
}

}  // namespace
}  // namespace gnomon::bench::glsl
