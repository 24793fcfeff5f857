#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iostream>
#include <string>

#include "engine/image/srgb.h"
#include "tests/gl/frame_fixture.h"

// What the picture of fog adds to each block of pixels, against single scattering that is integrated in double with
// rays to a board's box.
namespace gnomon {
namespace {

constexpr math::Aabb kBoard{{-0.3, 0.4, -0.7}, {0.4, 0.5, 0.5}};  // below the light
constexpr glm::dvec3 kLamp_m(0.2, 1.5, -0.2);
constexpr double kFov_rad = 0.8;
constexpr int kExposures = 8;
constexpr int kSide_px = 96, kBlock_px = 12, kBlocks = kSide_px / kBlock_px;
const glm::dvec3 kEye_m(0.0, 0.2, 5.0);

/// Returns the distances at which a line enters and leaves a box.
glm::dvec2 span_in(const math::Aabb& box, const glm::dvec3& from, const glm::dvec3& along) {
    glm::dvec2 span(-1e30, 1e30);
    for (int i = 0; i < 3; ++i) {
        const double a = (box.min[i] - from[i]) / along[i], b = (box.max[i] - from[i]) / along[i];
        span = {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
    }
    return span;
}

class FogPicture : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.viewport_px = {kSide_px, kSide_px};
        settings.exposure_ev = 0.0f;
        settings.still_samples = 16;
        board =
            place(add_mesh(game::make_box(kBoard.min, kBoard.max),
                           add_material({.name = "black", .base_colour = {0.0f, 0.0f, 0.0f, 1.0f}, .metallic = 0.0f})));
        // The board itself is not looked at: its light is another matter.
        world.patch<MeshRef>(board, [](MeshRef& m) { m.visible = false; });
        add_camera({.fov_y_rad = kFov_rad, .near_m = 0.1}, kEye_m, {0.0, 0.0, -1.0});
        fog = world.create();
        world.emplace<Transform>(fog, {.translation_m = fog_at_m});
        world.emplace<FogVolume>(fog, numbers);
    }
    math::Aabb fog_box() const { return {fog_at_m - numbers.half_extent_m, fog_at_m + numbers.half_extent_m}; }

    /// Returns the means of blocks of pixels as radiance exposed at 0 EV, from the lowest left one on, row by row. A
    /// picture's bytes round light by up to 2 %, all pixels of an even block alike; those of eight exposures do not.
    std::vector<double> blocks(int exposures = 1) {
        std::vector<double> means(kBlocks * kBlocks, 0.0);
        for (int i = 0; i < exposures; ++i) {
            const float ev = static_cast<float>(i) / static_cast<float>(exposures);
            settings.exposure_ev = ev;
            for (std::uint32_t sample = 0; sample < settings.still_samples + 1; ++sample) draw();
            add_means(picture(), std::exp2(ev) / static_cast<float>(exposures), means);
        }
        return means;
    }
    static void add_means(const std::vector<std::uint8_t>& rgba, double weight, std::vector<double>& means) {
        for (int y = 0; y < kSide_px; ++y)
            for (int x = 0; x < kSide_px; ++x) {
                const double shown =
                    image::light_of_srgb(rgba[static_cast<std::size_t>((y * kSide_px + x) * 4)] / 255.0);
                constexpr double kWhite = 8.0;
                const double less = 1.0 - shown;
                const double exposed = 2.0 * shown / (less + std::sqrt(less * less + shown * 4.0 / (kWhite * kWhite)));
                means[static_cast<std::size_t>((kSide_px - 1 - y) / kBlock_px * kBlocks + x / kBlock_px)] +=
                    weight * exposed / (kBlock_px * kBlock_px);
            }
    }

    /// Returns what the light adds to a pixel, as exposed radiance: a sum over places on its line. `blocks_light`: the
    /// board does.
    double scattered(const Light& light, const glm::dvec3& toward_sun, double x_px, double y_px,
                     bool blocks_light) const {
        const double tan_half = std::tan(0.5 * kFov_rad);
        const glm::dvec3 along = glm::normalize(
            glm::dvec3((2.0 * x_px / kSide_px - 1.0) * tan_half, (2.0 * y_px / kSide_px - 1.0) * tan_half, -1.0));
        const glm::dvec2 span = span_in(fog_box(), kEye_m, along);
        constexpr int kSteps = 400;
        const double step_m = (span.y - span.x) / kSteps, sigma = static_cast<double>(numbers.extinction_per_m);
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double at_m = span.x + (i + 0.5) * step_m;
            const glm::dvec3 place = kEye_m + along * at_m;
            const bool sun = light.kind == LightKind::directional;
            const glm::dvec3 way = sun ? toward_sun : kLamp_m - place;
            const double distance_m = glm::length(way);
            const glm::dvec3 to_light = way / distance_m;
            double lux = static_cast<double>(light.intensity);
            if (!sun) lux /= distance_m * distance_m;
            if (light.kind == LightKind::spot) {
                const double outer = std::cos(static_cast<double>(light.outer_cone_rad)),
                             inner = std::cos(static_cast<double>(light.inner_cone_rad));
                const double edge = std::clamp((to_light.y - outer) / (inner - outer), 0.0, 1.0);
                lux *= edge * edge;
            }
            const glm::dvec2 board_span = span_in(kBoard, place, to_light);
            if (blocks_light && board_span.x < board_span.y && board_span.y > 0.0 && (sun || board_span.x < distance_m))
                continue;
            const double leaves_m = span_in(fog_box(), place, to_light).y, g = static_cast<double>(numbers.anisotropy);
            const double fog_m = at_m - span.x + (sun ? leaves_m : std::min(leaves_m, distance_m));
            const double base = 1.0 + g * g - 2.0 * g * glm::dot(to_light, along);
            sum += lux * std::exp(-sigma * fog_m) * (1.0 - g * g) / (4.0 * glm::pi<double>() * std::pow(base, 1.5));
        }
        constexpr double kCalibration = 1.2;
        return sum * step_m * sigma * static_cast<double>(numbers.albedo.r) / kCalibration;
    }

    /// Returns the largest difference of a block's mean, of what the board takes, as a share of the largest mean.
    double worst_share(const Light& light, const glm::dvec3& toward_sun, const std::vector<double>& taken,
                       bool blocks_light) const {
        double worst = 0.0, largest = 0.0;
        constexpr int kPerSide = 12;
        for (int b = 0; b < kBlocks * kBlocks; ++b) {
            double truth = 0.0;
            for (int k = 0; k < kPerSide * kPerSide; ++k) {
                const double x = (b % kBlocks + (k % kPerSide + 0.5) / kPerSide) * kBlock_px,
                             y = (b / kBlocks + (k / kPerSide + 0.5) / kPerSide) * kBlock_px;
                const double shadow = blocks_light ? scattered(light, toward_sun, x, y, true) : 0.0;
                truth += (scattered(light, toward_sun, x, y, false) - shadow) / (kPerSide * kPerSide);
            }
            worst = std::max(worst, std::abs(truth - taken[static_cast<std::size_t>(b)]));
            largest = std::max(largest, truth);
        }
        return worst / largest;
    }

    glm::dvec3 fog_at_m{0.0, 0.2, -0.3};
    FogVolume numbers{
        .half_extent_m = {2.5, 2.5, 2.0}, .extinction_per_m = 0.15f, .albedo = glm::vec3(0.8f), .anisotropy = 0.3f};
    ecs::Entity board, fog;
};

struct LitFog {
    const char* name;
    Light light;
    glm::dvec3 toward_sun{0.0, 1.0, 0.0};
};

TEST_F(FogPicture, LacksBehindABoardWhatRaysToTheBoardTakeFromSingleScattering) {
    const LitFog cases[] = {
        {"sun", {.kind = LightKind::directional, .intensity = 12.0f}, glm::normalize(glm::dvec3(0.3, 1.0, 0.2))},
        {"spot", {.kind = LightKind::spot, .intensity = 60.0f, .inner_cone_rad = 0.4f, .outer_cone_rad = 0.9f}},
        {"point", {.kind = LightKind::point, .intensity = 8.0f}}};
    for (const LitFog& c : cases) {
        const bool sun = c.light.kind == LightKind::directional;
        const ecs::Entity light = add_light(c.light, sun ? glm::dvec3(0.0) : kLamp_m,
                                            sun ? -c.toward_sun : glm::dvec3(0.0, -1.0, 0.0), {.resolution_px = 1024});
        world.emplace<ShadowCaster>(board, {.enabled = true});
        const std::vector<double> with = blocks(kExposures);
        world.emplace<ShadowCaster>(board, {.enabled = false});
        const std::vector<double> without = blocks(kExposures);
        std::vector<double> taken;
        for (std::size_t b = 0; b < with.size(); ++b) taken.push_back(without[b] - with[b]);
        const double share = worst_share(c.light, c.toward_sun, taken, true);
        std::cout << c.name << ": worst block " << 100.0 * share << " % off\n";
        EXPECT_LT(share, 0.04) << c.name;
        EXPECT_GT(worst_share(c.light, c.toward_sun, taken, false), 0.3)
            << c.name << ": control, as if the board took all light";
        world.destroy(light);
    }
}

// Two boxes, one behind the other, take what they would take as one: what is behind them shows by the same share.
TEST_F(FogPicture, DimsWhatIsBehindByItsLength) {
    const std::uint32_t wall =
        add_mesh(game::make_card({0.0, 0.0, -4.0}, {20.0, 0.0, 0.0}, {0.0, 20.0, 0.0}),
                 add_material({.name = "grey", .base_colour = {0.5f, 0.5f, 0.5f, 1.0f}, .metallic = 0.0f}));
    place(wall, {}, false);
    add_light({.kind = LightKind::directional, .intensity = 12.0f}, {}, {0.0, 0.0, -1.0});
    world.patch<FogVolume>(fog, [](FogVolume& f) { f.albedo = glm::vec3(0.0f); });
    const std::size_t middle = kBlocks * kBlocks / 2 + kBlocks / 2;
    const double foggy = blocks()[middle];
    world.patch<FogVolume>(fog, [](FogVolume& f) { f.extinction_per_m = 0.0f; });
    const double clear = blocks()[middle];
    EXPECT_NEAR(foggy / clear, std::exp(-0.15 * 4.0), 0.02);
    world.patch<FogVolume>(fog, [](FogVolume& f) { f.extinction_per_m = 0.15f, f.half_extent_m.z = 1.0; });
    const ecs::Entity other = world.create();
    world.emplace<Transform>(other, {.translation_m = fog_at_m + glm::dvec3(0.0, 0.0, 2.0)});
    world.emplace<FogVolume>(other, *world.get<FogVolume>(fog));
    EXPECT_NEAR(blocks()[middle] / clear, std::exp(-0.15 * 4.0), 0.02);
    // Behind the wall, nothing of it shows.
    for (const ecs::Entity e : {fog, other}) world.patch<Transform>(e, [](Transform& t) { t.translation_m.z -= 9.0; });
    EXPECT_NEAR(blocks()[middle] / clear, 1.0, 0.01);
}

TEST_F(FogPicture, WithoutFogIsTheSamePictureToTheBit) {
    place(add_mesh(game::make_box({-1.0, -1.0, -1.0}, {1.0, 0.0, 1.0})));
    add_light({.kind = LightKind::point, .intensity = 30.0f}, kLamp_m, {0.0, -1.0, 0.0});
    settings.still_samples = 1;
    draw();
    const std::vector<std::uint8_t> foggy = picture();
    world.patch<FogVolume>(fog, [](FogVolume& f) { f.extinction_per_m = 0.0f; });
    draw();
    const std::vector<std::uint8_t> receives = picture();
    world.destroy(fog);
    draw();
    EXPECT_EQ(picture(), receives);
    EXPECT_NE(foggy, receives) << "control";
}

}  // namespace
}  // namespace gnomon
