#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "tests/gl/traced_frame_fixture.h"

/// Masked casters keep their coverage however coarse the map and however far the camera, against rays.
namespace gnomon {
namespace {

constexpr std::uint32_t kTexels = 128;
constexpr double kSide_m = 8.0;  // side of the card and of the ground
constexpr float kTiles = 7.31f;  // repeats of the texture along it: no whole number, or maps would sample all alike
/// A map of 64 texels samples the card 4096 times: three standard errors of a share.
constexpr double kShareError = 0.02;

class MaskedFrames : public TracedFrameTest {
protected:
    /// Returns twigs and small leaves. Their average over a few texels is below the cutoff nearly everywhere.
    static assets::Texture foliage() {
        assets::Texture texture;
        texture.name = "foliage";
        texture.width = texture.height = kTexels;
        std::vector<std::uint8_t> alpha(kTexels * kTexels, 0);
        std::mt19937 random(11);
        for (int n = 0; n < 420; ++n) {
            const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
            const std::uint32_t x = below(kTexels), y = below(kTexels), w = 1 + below(4), h = 1 + below(6);
            for (std::uint32_t j = 0; j < h; ++j)
                for (std::uint32_t i = 0; i < w; ++i) alpha[(y + j) % kTexels * kTexels + (x + i) % kTexels] = 255;
        }
        for (const std::uint8_t a : alpha) texture.rgba.insert(texture.rgba.end(), {60, 140, 50, a});
        return texture;
    }
    std::uint32_t add_foliage_card() {
        library.textures.push_back(foliage());
        leaf = {.name = "foliage",
                .base_colour_texture = 0,
                .metallic = 0.0f,
                .alpha_mode = assets::AlphaMode::mask,
                .double_sided = true};
        game::Shape card = game::make_card(glm::dvec3(0.0), {0.0, 0.0, kSide_m}, {kSide_m, 0.0, 0.0});
        for (glm::vec2& uv : card.uvs) uv *= kTiles;
        add_material({.name = "matt", .metallic = 0.0f});
        return add_mesh(card, add_material(leaf));
    }
    void look_down(double half_height_m) {
        camera = add_camera({.projection = CameraProjection::orthographic,
                             .half_height_m = half_height_m,
                             .near_m = 0.1,
                             .far_m = 40.0},
                            {0.0, 20.0, 0.0}, {0.0, -1.0, 0.0});
    }
    /// Adds an unseen card of foliage above a ground, and a camera that sees the ground.
    void make_canopy() {
        const ecs::Entity card = place(add_foliage_card(), {.translation_m = {0.0, 0.5, 0.0}});
        world.patch<MeshRef>(card, [](MeshRef& m) { m.visible = false; });
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, kSide_m}, {kSide_m, 0.0, 0.0}), 0), {}, false);
        look_down(0.45 * kSide_m);
    }
    /// Returns the share of wrong pixels, where the card's shadow may be.
    double wrong_share() {
        const Judged judged = judge();
        double wrong = 0.0, count = 0.0;
        for (std::size_t i = 0; i < judged.truth.size(); ++i) {
            if (judged.measured[i] < 0.0f) continue;
            count += 1.0;
            wrong += std::abs(judged.measured[i] - judged.truth[i]) > 0.5f ? 1.0 : 0.0;
        }
        return wrong / count;
    }
    /// Shares of dark pixels within the card's shadow, borders left out.
    struct Shares {
        double drawn = 0.0, truth = 0.0;
    };
    Shares dark_shares() {
        const Judged judged = judge();
        const glm::uvec2 size = settings.viewport_px;
        double drawn = 0.0, truth = 0.0, count = 0.0;
        for (std::uint32_t y = size.y / 4; y < size.y * 3 / 4; ++y)
            for (std::uint32_t x = size.x / 4; x < size.x * 3 / 4; ++x, count += 1.0) {
                drawn += 1.0 - static_cast<double>(judged.measured[std::size_t{y} * size.x + x]);
                truth += 1.0 - static_cast<double>(judged.truth[std::size_t{y} * size.x + x]);
            }
        return {drawn / count, truth / count};
    }
    assets::Material leaf;
    ecs::Entity camera;
};

class MaskedCasters : public MaskedFrames, public ::testing::WithParamInterface<LightKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, MaskedCasters,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(MaskedCasters, CastAsMuchShadowThroughCoarseMapsAsThroughFineOnes) {
    make_canopy();
    constexpr double kHeight_m = 9.0;
    const ecs::Entity lamp = add_light_of(GetParam(), {0.4, kHeight_m, 0.3}, {.resolution_px = 2048});
    // A map around the ground, or a cube's face of 90 degrees; half of the picture is looked at.
    const double map_m = GetParam() == LightKind::point ? 2.0 * kHeight_m : kSide_m, looked_at_m = 0.45 * kSide_m;
    for (const std::uint32_t resolution_px : {2048u, 1024u, 512u, 256u, 128u, 64u}) {
        world.patch<LightShadow>(lamp, [&](LightShadow& s) {
            s.resolution_px = resolution_px;
            s.cascades = 1;
        });
        draw();
        const Shares shares = dark_shares();
        EXPECT_GT(shares.truth, 0.1);
        const double samples = std::pow(resolution_px * looked_at_m / map_m, 2.0);
        const double three_errors = 3.0 * std::sqrt(shares.truth * (1.0 - shares.truth) / samples);
        EXPECT_NEAR(shares.drawn, shares.truth, std::max(kShareError, three_errors)) << resolution_px;
    }
}

TEST_P(MaskedCasters, AreCutWhereTheirTextureIsNotWhereTexelsAre) {
    make_canopy();
    const ecs::Entity lamp = add_light_of(GetParam(), {0.4, 9.0, 0.3}, {.resolution_px = 2048, .cascades = 1});
    draw();
    const double by_triangles = wrong_share();
    world.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::hard; });
    draw();
    const double by_texels = wrong_share();
    std::cout << "wrong: " << by_triangles << ", by texels " << by_texels << "\n";
    EXPECT_LT(by_triangles, by_texels / 10.0);
}

TEST_F(MaskedFrames, WouldLoseTheirLeavesByAverages) {
    // Negative control: the texture as its own fourth level would have it.
    make_canopy();
    const assets::MeshLibrary fine = library;
    constexpr std::uint32_t kBlock = 8;
    assets::Texture& texture = library.textures[0];
    for (std::uint32_t y = 0; y < kTexels; y += kBlock)
        for (std::uint32_t x = 0; x < kTexels; x += kBlock) {
            const auto alpha = [&](std::uint32_t i) -> std::uint8_t& {
                return texture.rgba[4 * ((y + i / kBlock) * kTexels + x + i % kBlock) + 3];
            };
            std::uint32_t sum = 0;
            for (std::uint32_t i = 0; i < kBlock * kBlock; ++i) sum += alpha(i);
            for (std::uint32_t i = 0; i < kBlock * kBlock; ++i)
                alpha(i) = static_cast<std::uint8_t>(sum / (kBlock * kBlock));
        }
    add_light_of(LightKind::directional, {0.4, 9.0, 0.3}, {.resolution_px = 1024});
    draw();
    const Shares averaged = dark_shares();
    library = fine;
    const Shares shares = dark_shares();
    EXPECT_NEAR(averaged.drawn, averaged.truth, kShareError);
    EXPECT_LT(averaged.truth, shares.truth - 2.0 * kShareError);
}

TEST_F(MaskedFrames, FillAsMuchOfThePictureFromAnyDistance) {
    place(add_foliage_card());
    add_light_of(LightKind::directional, {0.4, 9.0, 0.3}, {.resolution_px = 256});
    for (const double half_height_m : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
        look_down(half_height_m);
        draw();
        const SceneSnapshot& scene = frame().snapshot();
        const oracle::ReferenceTracer tracer(scene, library, scene.consumers.at(0).position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(scene.consumers.at(0));
        const std::vector<float> drawn = visibility();
        const auto seen =
            static_cast<double>(std::count_if(drawn.begin(), drawn.end(), [](float v) { return v >= 0; }));
        const auto there = static_cast<double>(std::count_if(hits.triangle.begin(), hits.triangle.end(),
                                                             [](std::uint32_t t) { return t != oracle::kNoTriangle; }));
        const double card_px =
            std::min(1.0, kSide_m / (2.0 * half_height_m)) * settings.viewport_px.y *
            std::min<double>(settings.viewport_px.x, kSide_m / (2.0 * half_height_m) * settings.viewport_px.y);
        EXPECT_NEAR(seen / card_px, there / card_px, kShareError) << half_height_m;
        world.destroy(camera);
    }
}

}  // namespace
}  // namespace gnomon
