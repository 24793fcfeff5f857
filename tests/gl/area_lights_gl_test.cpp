#include <algorithm>
#include <cmath>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/oracle/soft_metrics.h"
#include "tests/oracle/soft_truth.h"

/// Shadows of area lights against rays to 256 places of their sources.
namespace gnomon {
namespace {

constexpr LightKind kAreaKinds[] = {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube};

class AreaLights : public TracedFrameTest {
protected:
    /// Builds a ground with a box and a thin post, below a light of half a metre to a metre and a half.
    void build(LightKind kind, const LightShadow& shadow, const ShadowTuning& tuning = {}, bool casters = true) {
        start_anew();
        place(add_mesh(game::make_box({-4.0, -0.1, -4.0}, {4.0, 0.0, 4.0})));
        if (casters) {
            place(add_mesh(game::make_box({-0.5, 0.0, -0.4}, {0.1, 0.8, 0.3})));
            place(add_mesh(game::make_box({0.6, 0.0, 0.1}, {0.66, 1.2, 0.16})));
        }
        const Light light{.kind = kind,
                          .intensity = 1000.0f,
                          .source_radius_m = kind == LightKind::tube ? 0.04f : 0.35f,
                          .width_m = kind == LightKind::tube ? 1.4f : 0.9f,
                          .height_m = 0.5f};
        light_ = add_light(light, kLamp_m, -kLamp_m, shadow, tuning);
        add_camera({.fov_y_rad = 0.7}, {0.8, 2.2, 3.2}, glm::dvec3(-0.7, -2.0, -3.2));
    }
    oracle::SoftMetrics judge() {
        const SceneSnapshot& scene = frame().snapshot();
        const ConsumerItem& camera = scene.consumers.at(0);
        const oracle::ReferenceTracer tracer(scene, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        return oracle::compare_soft(hits, tracer.trace_source(hits, scene.lights.at(0), {}), visibility());
    }
    static std::size_t between(const std::vector<float>& shown) {
        return static_cast<std::size_t>(
            std::count_if(shown.begin(), shown.end(), [](float v) { return v > 0.0f && v < 1.0f; }));
    }

    const glm::dvec3 kLamp_m{-0.9, 2.4, 0.6};
    ecs::Entity light_;
};

TEST_F(AreaLights, ByRaysAreWithinTheNoiseOfSixteenOfTheTruth) {
    for (const LightKind kind : kAreaKinds) {
        SCOPED_TRACE(to_text(kind));
        build(kind, {.filter = ShadowFilter::exact_soft, .resolution_px = 512}, {.kernel = {.penumbra_rays = 16}});
        draw();
        const oracle::SoftMetrics m = judge();
        EXPECT_GT(m.penumbra, 500u);
        EXPECT_GT(m.umbra, 100u);
        EXPECT_LE(m.penumbra_error, 0.034);
        EXPECT_LE(m.umbra_leak, 1e-3) << "what 256 rays miss, and no more";
        EXPECT_LE(m.lit_loss, 1e-3);
    }
}

TEST_F(AreaLights, ByRaysLeakNothingAroundLargeSourcesAmongCasters) {
    // Casters within the ball around the source, and receivers within it: no map is certain there.
    for (const LightKind kind : kAreaKinds)
        for (const glm::dvec3& at : {glm::dvec3(-0.2, 1.1, 0.1), glm::dvec3(0.8, 0.5, -0.8)}) {
            SCOPED_TRACE(to_text(kind));
            build(kind, {.filter = ShadowFilter::exact_soft, .resolution_px = 256}, {.kernel = {.penumbra_rays = 32}});
            world.patch<Transform>(light_, [&](Transform& t) { t.translation_m = at; });
            world.patch<Light>(light_, [](Light& light) { light.width_m = 2.4f, light.height_m = 1.6f; });
            if (kind == LightKind::disc) world.patch<Light>(light_, [](Light& light) { light.source_radius_m = 0.9f; });
            draw();
            const oracle::SoftMetrics m = judge();
            EXPECT_GT(m.penumbra, 500u);
            EXPECT_LE(m.penumbra_error, 0.04);
            EXPECT_LE(m.umbra_leak, 2e-3);
            EXPECT_LE(m.lit_loss, 2e-3);
        }
}

TEST_F(AreaLights, ByTheMapAreAboutAsSoftAsTheTruth) {
    for (const LightKind kind : kAreaKinds) {
        SCOPED_TRACE(to_text(kind));
        build(kind, {.filter = ShadowFilter::pcss, .resolution_px = 1024}, {.kernel = {.taps = 32}});
        draw();
        const oracle::SoftMetrics m = judge();
        EXPECT_LE(m.mean_error, 0.008);
        EXPECT_LE(m.penumbra_error, 0.055);
        EXPECT_LE(m.umbra_leak, 0.05) << "what the search takes for seen";
        EXPECT_LE(m.lit_loss, 1e-3);
    }
}

TEST_F(AreaLights, ByTrianglesAreAsSoftAsTheTruth) {
    for (const LightKind kind : kAreaKinds) {
        SCOPED_TRACE(to_text(kind));
        build(kind, {.filter = ShadowFilter::soft_triangles, .resolution_px = 1024});
        draw();
        const oracle::SoftMetrics m = judge();
        EXPECT_LE(m.mean_error, 0.008);
        EXPECT_LE(m.penumbra_error, 0.055) << "shares of what is seen, not of what falls";
        EXPECT_LE(m.umbra_leak, 0.01);
        EXPECT_LE(m.lit_loss, 1e-3);
    }
}

TEST_F(AreaLights, WithoutCastersDarkenNothing) {
    for (const ShadowFilter filter :
         {ShadowFilter::exact_soft, ShadowFilter::pcss, ShadowFilter::soft_triangles, ShadowFilter::triangles})
        for (const LightKind kind : kAreaKinds) {
            SCOPED_TRACE(std::string(to_text(kind)) + " " + to_text(filter));
            build(kind, {.filter = filter, .resolution_px = 256}, {}, false);
            draw();
            const std::vector<float> shown = visibility();
            EXPECT_EQ(between(shown), 0u);
            EXPECT_GT(std::count(shown.begin(), shown.end(), 1.0f), 1000);
        }
}

TEST_F(AreaLights, ShineFromOneSideOfAPlaneAlone) {
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc}) {
        SCOPED_TRACE(to_text(kind));
        build(kind, {.filter = ShadowFilter::exact_soft, .resolution_px = 256});
        world.patch<Transform>(light_, [](Transform& t) { t.rotation = looking_along({0.0, 1.0, 0.0}); });
        draw();
        const std::vector<float> shown = visibility();
        EXPECT_EQ(std::count_if(shown.begin(), shown.end(), [](float v) { return v > 0.0f; }), 0);
    }
}

TEST_F(AreaLights, OfWhichTheMiddleIsHiddenLightByTheirRims) {
    // A small plate right before the middle of the source: a filter that sees the middle alone is dark in its shadow.
    for (const ShadowFilter filter : {ShadowFilter::exact_soft, ShadowFilter::triangles}) {
        build(LightKind::rectangle, {.filter = filter, .resolution_px = 256}, {}, false);
        const glm::dvec3 at = kLamp_m * 0.8;
        place(add_mesh(game::make_box(at - glm::dvec3(0.06, 0.01, 0.06), at + glm::dvec3(0.06, 0.01, 0.06))));
        draw();
        const std::vector<float> shown = visibility();
        const auto dark = std::count(shown.begin(), shown.end(), 0.0f);
        if (filter == ShadowFilter::triangles)
            EXPECT_GT(dark, 50) << "the control";
        else
            EXPECT_EQ(dark, 0);
    }
}

}  // namespace
}  // namespace gnomon
