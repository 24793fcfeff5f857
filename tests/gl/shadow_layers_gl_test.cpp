#include "tests/gl/traced_frame_fixture.h"

/// Light mask, caster mask, receiver mask: pixel by pixel against rays that honour them.
namespace gnomon {
namespace {

constexpr ShadowLayers kRed = 0x01, kBlue = 0x80;
constexpr glm::dvec3 kLightAt_m{-2.0, 5.0, -4.0};  // so that shadows fall toward the camera
/// Hard shadows of boxes at 512 px a map: edges may be a texel off, nothing else.
constexpr double kMostWrong = 0.02;

class ShadowLayersGl : public TracedFrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Adds two halves of a ground and two boxes above each. Their layers are up to the test.
    void make_world() {
        const std::uint32_t box = add_analysed(game::make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
        const std::uint32_t ground = add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 8.0}, {4.0, 0.0, 0.0}));
        left_ground = place(ground, {.translation_m = {-2.0, 0.0, 0.0}}, false);
        right_ground = place(ground, {.translation_m = {2.0, 0.0, 0.0}}, false);
        for (const double x : {-2.0, 2.0}) {
            red_boxes.push_back(place(box, {.translation_m = {x, 1.0, -1.5}}));
            blue_boxes.push_back(place(box, {.translation_m = {x, 1.0, 1.5}}));
        }
        add_camera({.fov_y_rad = 1.0}, {0.0, 9.0, 5.0}, {0.0, -9.0, -5.0});
    }
    void set_caster(ecs::Entity e, ShadowLayers layers) {
        world.patch<ShadowCaster>(e, [&](ShadowCaster& c) { c.layers = layers; });
    }
    void set_receiver(ecs::Entity e, ShadowLayers layers) {
        world.patch<MeshRef>(e, [&](MeshRef& m) { m.shadow_layers = layers; });
    }
    void set_light(ecs::Entity e, ShadowLayers layers) {
        world.patch<LightShadow>(e, [&](LightShadow& s) { s.layers = layers; });
    }
    void colour_boxes() {
        for (const ecs::Entity e : red_boxes) set_caster(e, kRed);
        for (const ecs::Entity e : blue_boxes) set_caster(e, kBlue);
    }
    /// Returns the scene as drawn, but with every mask open: what a pipeline without layers would have to show.
    SceneSnapshot without_layers() {
        SceneSnapshot scene = frame().snapshot();
        for (InstanceItem& item : scene.instances) item.cast_layers = item.receive_layers = kAllShadowLayers;
        for (LightItem& light : scene.lights) light.shadow.layers = kAllShadowLayers;
        return scene;
    }
    void expect_true(const char* what) {
        const Judged drawn = judge();
        EXPECT_EQ(drawn.metrics.acne + drawn.metrics.leak, 0u) << what;
        EXPECT_LT(drawn.metrics.fraction(drawn.metrics.wrong), kMostWrong) << what;
        EXPECT_GT(drawn.metrics.scored, 10000u) << what;
    }
    /// Expects the masks to matter here, so that a pipeline without them would fail (negative control).
    void expect_masks_matter(const char* what) {
        const oracle::Metrics open = judge(0, without_layers()).metrics;
        EXPECT_GT(open.leak, 500u) << what;
    }
    ecs::Entity left_ground, right_ground;
    std::vector<ecs::Entity> red_boxes, blue_boxes;
};

INSTANTIATE_TEST_SUITE_P(Kinds, ShadowLayersGl,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(ShadowLayersGl, ALightDrawsTheCastersOfItsLayersAlone) {
    make_world();
    const ecs::Entity lamp = add_light_of(GetParam(), kLightAt_m, {.resolution_px = 512});
    colour_boxes();
    draw();
    expect_true("a light of all layers");
    for (const ShadowLayers layers : {kRed, kBlue}) {
        set_light(lamp, layers);
        draw();
        expect_true(layers == kRed ? "red" : "blue");
        expect_masks_matter(layers == kRed ? "red" : "blue");
    }
}

TEST_P(ShadowLayersGl, AReceiverOfOtherLayersIsLitAsIfNothingWereInTheWay) {
    make_world();
    const ecs::Entity lamp = add_light_of(GetParam(), kLightAt_m, {.resolution_px = 512});
    set_light(lamp, kRed);
    set_receiver(left_ground, kBlue);
    set_receiver(right_ground, kRed | kBlue);
    draw();
    expect_true("half of the ground");
    expect_masks_matter("half of the ground");
    // The same frame, the other way round.
    set_receiver(left_ground, kRed);
    set_receiver(right_ground, kBlue);
    draw();
    expect_true("the other half");
}

TEST_P(ShadowLayersGl, CasterAndReceiverNeedNotShareALayer) {
    make_world();
    const ecs::Entity lamp = add_light_of(GetParam(), kLightAt_m, {.resolution_px = 512});
    draw();
    const std::vector<float> open = visibility();
    set_light(lamp, kRed | kBlue);
    colour_boxes();
    set_receiver(left_ground, kRed);
    set_receiver(right_ground, kBlue);
    draw();
    EXPECT_EQ(visibility(), open);
}

TEST_P(ShadowLayersGl, TheEightLayersAreEightBits) {
    make_world();
    const ecs::Entity lamp = add_light_of(GetParam(), kLightAt_m, {.resolution_px = 256});
    for (int bit = 0; bit < 8; ++bit) {
        const auto own = static_cast<ShadowLayers>(1 << bit);
        const auto others = static_cast<ShadowLayers>(~own);
        set_light(lamp, own);
        set_receiver(left_ground, others);
        set_receiver(right_ground, own);
        draw();
        const Judged drawn = judge();
        EXPECT_EQ(drawn.metrics.acne + drawn.metrics.leak, 0u) << bit;
    }
}

TEST_P(ShadowLayersGl, AnInvisibleCasterCastsOnlyAndOneWithoutShadowCasterReceivesOnly) {
    make_world();
    add_light_of(GetParam(), kLightAt_m, {.resolution_px = 512});
    for (const ecs::Entity e : red_boxes) world.patch<MeshRef>(e, [](MeshRef& m) { m.visible = false; });
    for (const ecs::Entity e : blue_boxes) world.remove<ShadowCaster>(e);
    draw();
    expect_true("cast-only and receive-only");
    SceneSnapshot swapped = frame().snapshot();
    for (InstanceItem& item : swapped.instances) item.casts = !item.casts;
    EXPECT_GT(judge(0, swapped).metrics.leak, 500u) << "negative control";
}

TEST_P(ShadowLayersGl, BlendedSurfacesHonourThem) {
    make_world();
    const std::uint32_t glass = add_material({.name = "glass",
                                              .base_colour = glm::vec4(1.0f, 1.0f, 1.0f, 0.5f),
                                              .metallic = 0.0f,
                                              .alpha_mode = assets::AlphaMode::blend});
    const ecs::Entity pane =
        place(add_mesh(game::make_card({0.0, 0.2, 0.0}, {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0}), glass), {}, false);
    const ecs::Entity lamp = add_light_of(GetParam(), kLightAt_m, {.resolution_px = 512});
    const auto pictured = [&](ShadowLayers light, ShadowLayers receiver) {
        set_light(lamp, light);
        set_receiver(pane, receiver);
        draw();
        return picture();
    };
    const auto open = pictured(kAllShadowLayers, kAllShadowLayers);
    EXPECT_EQ(pictured(kRed, kRed), open);
    const auto unshadowed = pictured(kRed, kBlue);
    EXPECT_NE(unshadowed, open);
    world.patch<MeshRef>(pane, [](MeshRef& m) { m.receives_shadow = false; });
    draw();
    EXPECT_EQ(picture(), unshadowed);
}

}  // namespace
}  // namespace gnomon
