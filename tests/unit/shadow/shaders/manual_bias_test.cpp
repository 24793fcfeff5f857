#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/glsl_on_cpu/glsl_types.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/publish/publish_lights.h"

/// The shader's own manual biases, compiled in double: their formulas, one by one.
namespace gnomon::bench::glsl {
namespace {

#include "bench/glsl_on_cpu/begin_double.inc"
struct Shader {
#include "shaders/shadow/lookup/light_block.glsl"

#include "shaders/shadow/lookup/bias/automatic.glsl"

#include "shaders/shadow/lookup/bias/manual.glsl"
};
#include "bench/glsl_on_cpu/end_double.inc"

constexpr double kRange_m = 50.0, kTexel_m = 0.02, kBias_m = 0.03, kTexels = 1.5;
const double kCosine = std::cos(1.1), kSine = std::sin(1.1), kTangent = std::tan(1.1);

class ManualBias : public ::testing::Test {
protected:
    ManualBias() {
        shader_.light.bias = vec4(kBias_m, 0.0, kTexels, 0.0);
        sun_.axis_u.w = kTexel_m;
        sun_.axis_v.w = 0.5 * kTexel_m;
        sun_.axis_back.w = kRange_m;
        lamp_.axis_u.w = lamp_.axis_v.w = kTexel_m / 10.0;
        lamp_.axis_back.w = 0.2;
    }
    Shader::Bias of_sun(BiasMode mode, double cosine = kCosine) {
        shader_.light.options.y = static_cast<int>(mode);
        return shader_.manual_bias(shader_.orthographic_place(sun_, cosine, kRange_m));
    }
    /// Returns the bias at a point 10 m before the light, off its axis.
    Shader::Bias of_lamp(BiasMode mode, bool cube) {
        shader_.light.options.y = static_cast<int>(mode);
        const vec3 at(3.0, 4.0, -10.0), toward = at * (-1.0 / length(at));
        const vec3 aside = normalize(cross(toward, vec3(0.0, 1.0, 0.0)));
        Shader::BiasPlace place = shader_.perspective_place(lamp_, toward * kCosine + aside * kSine, at, 10.0);
        if (cube) place.distance_m = length(at);
        return shader_.manual_bias(place);
    }
    Shader shader_;
    Shader::ViewRecord sun_, lamp_;
};

TEST_F(ManualBias, OfMetresAndTexelsIsWhatItsNameSays) {
    const double constant = kBias_m / kRange_m;
    EXPECT_DOUBLE_EQ(of_sun(BiasMode::constant).depth, constant);
    EXPECT_NEAR(of_sun(BiasMode::slope).depth, constant + kTexels * kTexel_m * kTangent / kRange_m, 1e-12);
    EXPECT_DOUBLE_EQ(of_sun(BiasMode::normal_offset).depth, constant);
    EXPECT_NEAR(of_sun(BiasMode::normal_offset).along_normal_m, kTexels * kTexel_m * kSine, 1e-12);
    EXPECT_DOUBLE_EQ(of_sun(BiasMode::receiver_plane).depth, constant);
    EXPECT_DOUBLE_EQ(shader_.receiver_plane_margin(vec2(-0.1, 0.3)), kTexels * 0.4);
    for (const BiasMode mode : {BiasMode::constant, BiasMode::slope, BiasMode::receiver_plane})
        EXPECT_EQ(of_sun(mode).along_normal_m, 0.0);
}

TEST_F(ManualBias, OfTheTutorialsIsAShareOfAFlatMapsDepth) {
    EXPECT_EQ(of_sun(BiasMode::tutorial_constant).depth, 0.005);
    EXPECT_NEAR(of_sun(BiasMode::tutorial_cosine).depth, 0.05 * (1.0 - kCosine), 1e-15);
    EXPECT_EQ(of_sun(BiasMode::tutorial_cosine, 0.95).depth, 0.005) << "no less than that";
    EXPECT_NEAR(of_sun(BiasMode::tutorial_tangent).depth, 0.005 * kTangent, 1e-15);
    EXPECT_EQ(of_sun(BiasMode::tutorial_tangent, 0.1).depth, 0.01) << "no more than that";
    EXPECT_EQ(of_sun(BiasMode::tutorial_tangent, 1.0).depth, 0.0);
    EXPECT_EQ(of_lamp(BiasMode::tutorial_constant, false).depth, 0.005) << "as it is stored, not by distance";
}

TEST_F(ManualBias, OfTheTutorialsIsMetresTowardAPointLight) {
    const double distance_m = std::sqrt(125.0);
    for (const auto& [mode, amount_m] :
         {std::pair(BiasMode::tutorial_constant, 0.005), std::pair(BiasMode::tutorial_cosine, 0.05 * (1.0 - kCosine)),
          std::pair(BiasMode::tutorial_tangent, 0.005 * kTangent)}) {
        // A point `amount_m` nearer along the ray has a z smaller by the same share.
        const double nearer_m = 10.0 * (1.0 - amount_m / distance_m);
        EXPECT_NEAR(of_lamp(mode, true).depth, 0.2 / nearer_m - 0.2 / 10.0, 1e-12);
    }
}

TEST_F(ManualBias, InPerspectiveMetresCountAlongTheAxisAndTexelsGrowWithDistance) {
    EXPECT_NEAR(of_lamp(BiasMode::constant, false).depth, 0.2 * kBias_m / 100.0, 1e-15);
    EXPECT_NEAR(of_lamp(BiasMode::normal_offset, true).along_normal_m, kTexels * kTexel_m * kSine, 1e-12);
    const double slope_m = kBias_m + kTexels * kTexel_m * kTangent;
    EXPECT_NEAR(of_lamp(BiasMode::slope, true).depth, 0.2 * slope_m / 100.0, 1e-12);
}

TEST_F(ManualBias, StaysFiniteWhereLightGrazes) {
    for (int mode = 1; mode < static_cast<int>(BiasMode::count); ++mode)
        for (const double cosine : {0.0, -0.5, 1.0, 1.0 + 1e-9}) {
            const Shader::Bias bias = of_sun(static_cast<BiasMode>(mode), cosine);
            EXPECT_TRUE(std::isfinite(bias.depth) && std::isfinite(bias.along_normal_m)) << mode;
            EXPECT_GE(bias.depth, 0.0);
        }
}

shadow::LightingLight published(const ShadowTuning::Bias& bias) {
    SceneSnapshot scene;
    scene.consumers.resize(1);
    scene.lights.resize(1);
    scene.lights[0].kind = LightKind::directional;
    scene.lights[0].tuning.bias = bias;
    shadow::ShadowFrame frame;
    frame.decisions.resize(1);
    frame.decisions[0].request.map.resolution_px = 64;
    frame.statuses.resize(1);
    frame.fitted.lights.resize(1);
    frame.fitted.lights[0].views.count = 1;
    frame.fitted.views.resize(1);
    frame.maps.resize(1);
    frame.maps[0].texture = {1};
    frame.maps[0].size_px = 64;
    frame.updates.resize(1);
    const shadow::DrawnViews drawn = shadow::drawn_views(frame);
    const shadow::MapSamplers samplers;
    const visibility::RayBuffers no_rays;
    shadow::publish_lights(scene, {drawn, {}, {}, samplers, no_rays}, frame.inputs, {});
    return frame.inputs.at(0).lights.at(0);
}

TEST(ManualBiasSettings, ReachTheShaderAndAbsurdOnesCountAsTheDefaults) {
    const shadow::LightingLight good = published({.mode = BiasMode::slope, .offset_m = 0.5f, .offset_texel = 3.0f});
    EXPECT_TRUE(good.row.manual_bias);
    EXPECT_EQ(good.record.options.y, static_cast<int>(BiasMode::slope));
    EXPECT_EQ(good.record.bias.x, 0.5f);
    EXPECT_EQ(good.record.bias.z, 3.0f);
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN(), kMost = std::numeric_limits<float>::infinity();
    for (const float absurd : {-1.0f, kNone, kMost}) {
        const auto light = published({.mode = BiasMode::slope, .offset_m = absurd, .offset_texel = absurd});
        EXPECT_EQ(light.record.bias.x, ShadowTuning::Bias{}.offset_m);
        EXPECT_EQ(light.record.bias.z, ShadowTuning::Bias{}.offset_texel);
    }
    EXPECT_FALSE(published({.offset_m = 0.5f}).row.manual_bias);
    EXPECT_FALSE(published({.mode = BiasMode::count}).row.manual_bias) << "no mode at all";
}

}  // namespace
}  // namespace gnomon::bench::glsl
