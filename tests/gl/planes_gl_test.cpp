#include <cmath>
#include <random>

#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/frame_fixture.h"
#include "tests/unit/math/random_seed.h"

// A plane never shadows itself, whatever light shines on it, through whichever filter and depth format.
namespace gnomon {
namespace {

constexpr double kHalf_m = 5.0, kDistance_m = 8.0;
constexpr float kNear_m = 0.02f;  // so near that a fixed-point depth is worth a decimetre where the plane is
constexpr int kRounds = 2;
constexpr std::size_t kManyPixels = 800;
constexpr float kLit = 1.0f - 1e-6f;  // a sampler's weights sum up to 1 except for rounding

class Planes : public FrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Adds one card that casts, seen from its lit side, and a light of each filter and of the given formats.
    void add_scene(std::mt19937_64& random, std::span<const shadow::DepthFormatRow> formats = shadow::kDepthFormats) {
        std::uniform_real_distribution<double> turn(-1.0, 1.0), lift(0.05, 1.5);
        const double azimuth = 3.14 * turn(random), elevation = lift(random);
        const glm::dvec3 toward_light(std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                                      std::sin(azimuth) * std::cos(elevation));
        place(add_mesh(game::make_card(glm::dvec3(0.0), {2.0 * kHalf_m, 0.0, 0.0}, {0.0, 0.0, -2.0 * kHalf_m})));
        add_camera({.fov_y_rad = 1.0}, {3.0 * turn(random), 7.0, 3.0 * turn(random)}, {0.01, -1.0, 0.02});
        const Light light{.kind = GetParam(), .intensity = 1000.0f, .outer_cone_rad = 0.9f};
        const auto add = [&](const LightShadow& shadow, const ShadowTuning& tuning = {}) {
            return add_light(light, toward_light * kDistance_m, -toward_light, shadow, tuning);
        };
        for (const shadow::FilterRow& filter : shadow::filter_table())
            for (const shadow::DepthFormatRow& format : formats)
                lights_.push_back(add({.filter = filter.id, .resolution_px = 64},
                                      {.projection = {.near_m = GetParam() == LightKind::directional ? 0.0f : kNear_m},
                                       .maps = {.depth_format = format.id}}));
        add({.enabled = false});
    }
    /// Counts, among the pixels that this light reaches, how many its shadow leaves lit and how many it darkens.
    std::pair<std::size_t, std::size_t> lit_and_dark(std::uint32_t light) {
        const std::vector<float> unshadowed = visibility(static_cast<std::uint32_t>(lights_.size())),
                                 shown = visibility(light);
        std::size_t lit = 0, dark = 0;
        for (std::size_t i = 0; i < shown.size(); ++i)
            if (unshadowed[i] > 0.0f) (shown[i] >= kLit ? lit : dark) += 1;
        return {lit, dark};
    }
    /// Draws the scene and expects no light's shadow to darken a pixel. Returns the number of lit pixels, summed over
    /// lights.
    std::size_t expect_lit(int round) {
        std::size_t lit_of_all = 0;
        draw();
        for (std::uint32_t i = 0; i < lights_.size(); ++i) {
            const LightReport& report = frame().report().lights[i];
            // With kNear_m a lamp's d16 is coarser than the texels, which is reported. The plane is lit all the same.
            if (report.reason != Reason::depth_coarse) {
                EXPECT_EQ(report.state, LightState::rendered) << report.name;
            }
            const auto [lit, dark] = lit_and_dark(i);
            const LightItem& item = frame().snapshot().lights[i];
            EXPECT_EQ(dark, 0u) << "round " << round << ", " << shadow::filter_row(item.shadow.filter).name
                                << ", format " << static_cast<int>(item.tuning.maps.depth_format);
            lit_of_all += lit;
        }
        return lit_of_all;
    }
    std::vector<ecs::Entity> lights_;
};

// One plane; stability_random_planes looks through each filter and format at 20 000.
TEST_P(Planes, AreLitThroughEveryFilterAndFormat) {
    std::mt19937_64 random(print_seed());
    std::size_t dark_without_bias = 0;
    start_anew();
    add_scene(random);
    const std::size_t lit_of_all = expect_lit(0);
    for (const ecs::Entity light : lights_)
        edit_light(world, light, [](ShadowTuning& t) { t.bias.mode = BiasMode::constant; });
    draw();
    for (std::uint32_t i = 0; i < lights_.size(); ++i) dark_without_bias += lit_and_dark(i).second;
    EXPECT_GT(lit_of_all, kManyPixels * lights_.size());
    EXPECT_GT(dark_without_bias, kManyPixels) << "without a bias nothing is amiss: the test sees nothing";
}

// Beside a cube's seams a steep plane's normal leads away along the face's axis. The bias moves the receiver farther
// away there, which makes its taps wider than at its own place.
TEST_P(Planes, AreLitWhereTheBiasTakesTheReceiverFartherAway) {
    std::mt19937_64 random(3);
    for (int round = 0; round < kRounds; ++round) {
        lights_.clear();
        start_anew();
        add_scene(random, std::span(shadow::kDepthFormats).first(1));
        EXPECT_GT(expect_lit(round), 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Planes,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(shadow::light_kind_row(row.param).name); });

}  // namespace
}  // namespace gnomon
