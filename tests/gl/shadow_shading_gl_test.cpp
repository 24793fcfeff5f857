#include "systems/lighting/lighting_system.h"
#include "tests/gl/box_fixture.h"

// A shadow takes the light's own part, diffuse and specular, and leaves the ambient one.
namespace gnomon {
namespace {

constexpr float kPi = 3.14159265f;

/// Returns a level of the picture, 0 to 255: shaders/lighting/post/tonemap.frag and the target's encoding, for a fixed
/// exposure.
int encoded(float luminance, float ev) {
    constexpr float kWhite = 8.0f, kCalibration = 1.2f;
    const float x = luminance / (kCalibration * std::exp2(ev));
    const float mapped = std::min(x * (1.0f + x / (kWhite * kWhite)) / (1.0f + x), 1.0f);
    const float srgb = mapped <= 0.0031308f ? 12.92f * mapped : 1.055f * std::pow(mapped, 1.0f / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(255.0f * srgb));
}

struct Finish {
    const char* name;
    float metallic, roughness;
    friend void PrintTo(const Finish& finish, std::ostream* out) { *out << finish.name; }
};

class ShadowShading : public BoxTest {
protected:
    /// Returns the pixels for which every light's oracle claims `wanted`, as places of their first bytes in the picture
    /// (top row first).
    std::vector<std::size_t> pixels_claimed(boxes::Claim wanted, std::uint32_t light_count) {
        std::vector<std::size_t> found;
        const SceneSnapshot& scene = frame().snapshot();
        const glm::uvec2 size = settings.viewport_px;
        for (std::uint32_t y = 0; y < size.y; ++y)
            for (std::uint32_t x = 0; x < size.x; ++x) {
                bool all = true;
                for (std::uint32_t light = 0; light < light_count && all; ++light)
                    all = boxes::claim_of_pixel(truth, scene.consumers.front(), scene.lights[light], x, y) == wanted;
                if (all) found.push_back((std::size_t{size.y - 1 - y} * size.x + x) * 4);
            }
        return found;
    }
    static constexpr glm::vec3 kColour{0.8f, 0.5f, 0.3f};
};

class ShadowShadingOf : public ShadowShading, public ::testing::WithParamInterface<Finish> {};

TEST_P(ShadowShadingOf, APixelInFullShadowOfAllLightsKeepsItsAmbientValueAlone) {
    add_material({.name = "ground", .base_colour = glm::vec4(kColour, 1.0f), .metallic = GetParam().metallic, .roughness = GetParam().roughness});
    add_ground(6.0);
    add_box({-1.5, 1.0, -1.5}, {1.5, 1.5, 1.5});
    add_light({.kind = LightKind::directional, .intensity = 20000.0f}, {}, {0.4, -1.0, 0.3});
    add_light({.kind = LightKind::point, .intensity = 20000.0f}, {-1.0, 5.0, 0.5}, {0.0, -1.0, 0.0});
    add_light({.kind = LightKind::spot, .intensity = 20000.0f, .outer_cone_rad = 0.9f}, {-0.6, 6.0, 1.0}, {0.0, -1.0, 0.0});
    add_camera({.projection = CameraProjection::orthographic, .half_height_m = 5.0, .near_m = 0.1, .far_m = 60.0},
               {-20.0, 12.0, -16.0}, {20.0, -12.0, 16.0});
    settings.exposure_ev = 11.0f;
    draw();
    const auto rgba = picture();
    lighting::MidstFinder midst;
    const SceneSnapshot& scene = frame().snapshot();
    const auto ambient = lighting::ambient_for(lighting::scene_light(scene, midst.find(scene)));
    const auto dark = pixels_claimed(boxes::Claim::dark, 3), lit = pixels_claimed(boxes::Claim::lit, 3);
    ASSERT_GT(dark.size(), 100u);
    ASSERT_GT(lit.size(), 1000u);
    for (int channel = 0; channel < 3; ++channel) {
        // The ground faces straight up: all of its ambient light is the sky's.
        const int want = encoded(kColour[channel] / kPi * ambient.sky_lux[channel], *settings.exposure_ev);
        ASSERT_GT(want, 10) << "too dark to tell";
        for (const std::size_t at : dark) ASSERT_NEAR(rgba[at + static_cast<std::size_t>(channel)], want, 1) << at / 4;
        std::size_t brighter = 0;
        for (const std::size_t at : lit) brighter += rgba[at + static_cast<std::size_t>(channel)] > want + 5;
        // Where a smooth metal does not mirror a light toward the camera it returns hardly any.
        EXPECT_GT(brighter, GetParam().metallic > 0.5f ? std::size_t{0} : lit.size() * 9 / 10);
    }
}

INSTANTIATE_TEST_SUITE_P(EachFinish, ShadowShadingOf,
                         ::testing::Values(Finish{"rough", 0.0f, 0.9f}, Finish{"polished", 0.0f, 0.15f}, Finish{"metal", 1.0f, 0.4f}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_F(ShadowShading, AReceiverThatTakesNoShadowIsLitUnderTheBox) {
    add_ground(6.0);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {1.0, -2.0, 0.5});
    look_down(5.0);
    draw();
    EXPECT_GT(judged().dark, 100u);
    expect_true(100, 1000);
    const ecs::Entity ground = world.entities_with<MeshRef>().front();
    world.patch<MeshRef>(ground, [](MeshRef& m) { m.receives_shadow = false; });
    draw();
    const auto dark = judged();
    EXPECT_EQ(dark.wrong, dark.dark) << "every pixel that was in shadow is lit now, and no other has changed";
}

}  // namespace
}  // namespace gnomon
