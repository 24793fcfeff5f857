#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::shadow {
namespace {

class DemandTest : public ::testing::Test {
protected:
    DemandTest() {
        device.max_texture_px = 8192;
        device.max_cube_px = 4096;
        scene.consumers.push_back({});
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
            LightItem light;
            light.kind = kind;
            light.intensity = 1.0f;
            light.has_shadow = true;
            light.outer_cone_rad = 0.5;
            scene.lights.push_back(light);
        }
    }
    const std::vector<ShadowRequest>& decide(bool shadows = true) {
        decide_requests(scene, {device, {}, shadows}, fallbacks, demands);
        return demands;
    }
    gl::DeviceInfo device;
    SceneSnapshot scene;
    std::vector<ShadowRequest> demands;
    RayFallbacks fallbacks;
};

TEST_F(DemandTest, EachLightHasOneInItsOrder) {
    ASSERT_EQ(decide().size(), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(demands[i].skip, Reason::none);
        EXPECT_EQ(demands[i].note, Reason::none);
    }
    EXPECT_EQ(demands[0].map.view_count, 4u);
    EXPECT_EQ(demands[1].map.view_count, 1u);
    EXPECT_EQ(demands[2].map.view_count, 6u);
    decide();
    EXPECT_EQ(demands.size(), 3u) << "and not more the next time";
}

TEST_F(DemandTest, WhatNobodyWantsEndsHereWithItsReason) {
    scene.lights[0].has_shadow = false;
    scene.lights[1].shadow.enabled = false;
    scene.lights[2].intensity = 0.0f;
    decide();
    EXPECT_EQ(demands[0].skip, Reason::no_light_shadow);
    EXPECT_EQ(demands[1].skip, Reason::shadows_off);
    EXPECT_EQ(demands[2].skip, Reason::light_off);
    scene.lights[2].intensity = 1.0f;
    EXPECT_EQ(decide(false)[2].skip, Reason::shadows_off);
    scene.lights[2].colour = glm::vec3(0.0f);
    EXPECT_EQ(decide()[2].skip, Reason::light_off);
}

constexpr float kUsual = FilterRow{}.texels_per_pixel;

TEST_F(DemandTest, AFilterThatNeedsFewerTexelsGetsThem) {
    for (const FilterRow& row : filter_table()) {
        scene.lights[1].shadow.filter = row.id;
        EXPECT_EQ(decide()[1].map.resolution_px,
                  automatic_resolution(scene.consumers[0].viewport_px, row.texels_per_pixel, 1.0f, 16384))
            << row.name;
    }
    EXPECT_LT(automatic_resolution({1280, 720}, filter_row(ShadowFilter::triangles).texels_per_pixel, 1.0f, 16384),
              automatic_resolution({1280, 720}, kUsual, 1.0f, 16384));
}

TEST_F(DemandTest, TheAutomaticSizeGrowsWithThePictureUpToTheLimit) {
    std::uint32_t last = 0;
    for (const std::uint32_t side : {1u, 64u, 640u, 1280u, 1920u, 3840u, 100000u, 0xffffffffu}) {
        const std::uint32_t size = automatic_resolution({side, 1}, kUsual, 1.0f, 8192);
        EXPECT_EQ(size, automatic_resolution({1, side}, kUsual, 1.0f, 8192));
        EXPECT_EQ(size % 256u, 0u);
        EXPECT_GE(size, std::max(last, 256u));
        EXPECT_LE(size, 8192u);
        EXPECT_GE(size, std::min(side, 8192u)) << "at least a texel per pixel";
        if (side < 4096u) {
            EXPECT_LT(size, side + side / 2 + 256u) << "no more than it asks for, rounded up";
        }
        last = size;
    }
    EXPECT_EQ(automatic_resolution({640, 480}, kUsual, 1.0f, 100), 100u) << "the device's limit comes first";
}

TEST_F(DemandTest, AFinerWishGetsMoreTexelsAndAnAbsurdOneStaysTotal) {
    const auto size = [](float max_error_px) { return automatic_resolution({1280, 720}, kUsual, max_error_px, 16384); };
    EXPECT_EQ(size(1.0f), 2048u);
    EXPECT_EQ(size(0.5f), 3840u);
    EXPECT_EQ(size(2.0f), 2048u) << "what a coarser wish saves is for the fits to find (accuracy_target.h)";
    EXPECT_EQ(size(1e9f), 2048u);
    EXPECT_EQ(size(1e-9f), 8192u);
    for (const float absurd : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(size(absurd), size(1.0f));
}

TEST_F(DemandTest, EveryKindTakesAnisotropyAndPaysForHalfItsFootprint) {
    for (LightItem& light : scene.lights) light.shadow.filter = ShadowFilter::vsm;
    for (const ShadowRequest& d : decide()) EXPECT_EQ(d.map.moments.reach_texel, 0.0f);
    for (LightItem& light : scene.lights) light.tuning.moments.anisotropy = 4;
    decide();
    for (std::size_t i = 0; i < demands.size(); ++i) {
        const ShadowRequest& d = demands[i];
        EXPECT_EQ(d.note, Reason::none);
        EXPECT_EQ(d.map.moments.anisotropy, 4u);
        EXPECT_EQ(d.map.moments.footprint_texel, 4.0f);
        EXPECT_EQ(d.map.moments.reach_texel, 2.0f);
        EXPECT_EQ(d.map.moments.sampler_anisotropy, i != 2) << "a sampler knows nothing of a cube's faces";
    }
}

TEST_F(DemandTest, ARequestedSizeIsKeptOrClampedWithANote) {
    for (LightItem& light : scene.lights) light.shadow.resolution_px = 777;
    for (const ShadowRequest& d : decide()) {
        EXPECT_EQ(d.map.resolution_px, 777u);
        EXPECT_EQ(d.note, Reason::none);
    }
    for (LightItem& light : scene.lights) light.shadow.resolution_px = 8192;
    decide();
    EXPECT_EQ(demands[1].map.resolution_px, 8192u);
    EXPECT_EQ(demands[1].note, Reason::none);
    EXPECT_EQ(demands[2].map.resolution_px, 4096u) << "cubes have a limit of their own";
    EXPECT_EQ(demands[2].note, Reason::resolution_clamped);
    for (const std::uint32_t beyond_px : {8193u, 65536u, 4000000000u}) {
        scene.lights[1].shadow.resolution_px = beyond_px;
        EXPECT_EQ(decide()[1].note, Reason::resolution_clamped) << beyond_px;
        EXPECT_EQ(demands[1].map.resolution_px, 8192u) << beyond_px;
    }
    scene.lights[1].shadow.resolution_px = 16;
    EXPECT_EQ(decide()[1].note, Reason::none);
    EXPECT_EQ(demands[1].map.resolution_px, 16u);
    for (const std::uint32_t below_px : {1u, 15u}) {
        scene.lights[1].shadow.resolution_px = below_px;
        EXPECT_EQ(decide()[1].note, Reason::resolution_clamped) << below_px;
        EXPECT_EQ(demands[1].map.resolution_px, 16u) << below_px;
    }
}

TEST_F(DemandTest, ASunChoosesFourCascadesAtMostWhateverItsTarget) {
    for (const float target_px : {0.0f, 1.0f, 0.1f, 1e-6f}) {
        scene.lights[0].shadow.max_error_px = target_px;
        EXPECT_LE(decide()[0].map.view_count, 4u) << target_px;
        EXPECT_LE(demands[0].limits.max_views, 4u) << target_px;
    }
    scene.lights[0].shadow.cascades = 5;
    EXPECT_EQ(decide()[0].map.view_count, 5u) << "control: more are given where they are requested";
}

TEST_F(DemandTest, AWideConeGetsFiveFacesInsteadOfOneView) {
    scene.lights[1].outer_cone_rad = 1.5;
    EXPECT_EQ(decide()[1].note, Reason::none);
    EXPECT_EQ(demands[1].map.view_count, 5u);
    EXPECT_EQ(demands[1].projection.cube_blend_eighths, 8);
}

TEST_F(DemandTest, WithoutCamerasItStaysTotal) {
    scene.consumers.clear();
    for (const ShadowRequest& d : decide()) EXPECT_GE(d.map.resolution_px, 256u);
}

}  // namespace
}  // namespace gnomon::shadow
