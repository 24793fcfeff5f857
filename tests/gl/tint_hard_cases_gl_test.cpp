#include <iostream>

#include "systems/shadow/maps/tint_maps.h"
#include "tests/gl/tint_fixture.h"

/// Situations in which numbers or surfaces are unusual, by maps and by rays.
namespace gnomon {
namespace {

constexpr double kMostByMaps = 2.0, kMostByRays = 0.1;  // mean difference, of 255ths

struct HardCase {
    const char* name;
    double scale = 1.0;            // scale of the whole world
    glm::dvec3 offset_m{0.0};      // place of the whole world
    glm::dvec3 pane_scale{1.0};    // scale of panes alone
    glm::dvec3 lamp_m{0.7, 9.0, 0.4};
    double tilt_rad = 0.0;         // tilt of panes, from level
};
const HardCase kCases[] = {
    {.name = "as_usual"},
    {.name = "a_thousandth", .scale = 1.0e-3},
    {.name = "a_thousandfold", .scale = 1.0e3},
    {.name = "a_million_metres_away", .offset_m = {1.0e6, -1.0e6, 1.0e6}},
    {.name = "mirrored", .pane_scale = {-1.0, 1.0, 1.0}},
    {.name = "stretched", .pane_scale = {0.3, 1.0, 1.6}},
    {.name = "slanting_light", .lamp_m = {7.0, 7.0, 0.4}},
    {.name = "panes_aslant", .tilt_rad = 1.2},
};

class HardTints : public TintTest,
                  public ::testing::WithParamInterface<std::tuple<HardCase, LightKind, ShadowFilter>> {
protected:
    void make(const HardCase& hard) {
        const auto placed = [&](const glm::dvec3& at_m) { return hard.offset_m + hard.scale * at_m; };
        const auto stand = [&](ecs::Entity entity, const glm::dvec3& at_m, const glm::dvec3& scale) {
            world.patch<Transform>(entity, [&](Transform& t) {
                t.translation_m = placed(at_m);
                t.scale = hard.scale * scale;
            });
        };
        const auto [_, kind, filter] = GetParam();
        stand(place(add_mesh(game::make_card(glm::dvec3(0.0), {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}), 0), {}, false),
              {0.0, 0.0, 0.0}, glm::dvec3(1.0));
        turn = glm::angleAxis(hard.tilt_rad, glm::normalize(glm::dvec3(0.2, 0.0, 1.0)));
        stand(add_pane(glass({0.9f, 0.2f, 0.1f}), {}, 1.2), {-0.4, 2.0, 0.1}, hard.pane_scale);
        stand(add_pane(film(0.6f), {}, 1.2), {0.5, 2.8, -0.2}, hard.pane_scale);
        add_camera({.fov_y_rad = 0.6f,
                    .near_m = static_cast<float>(0.1 * hard.scale),
                    .far_m = static_cast<float>(60.0 * hard.scale)},
                   placed({0.3, 14.0, 3.0}), {0.0, -14.0, -3.0});
        add_light({.kind = kind, .range_m = 0.0f, .outer_cone_rad = 1.0f}, placed(hard.lamp_m), -hard.lamp_m,
                  {.filter = filter});
    }
};

INSTANTIATE_TEST_SUITE_P(
    Cases, HardTints,
    ::testing::Combine(::testing::ValuesIn(kCases),
                       ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                       ::testing::Values(ShadowFilter::hardware_2x2, ShadowFilter::exact)),
    [](const auto& test) {
        return std::string(std::get<0>(test.param).name) + "_" + kind_name(std::get<1>(test.param)) +
               (std::get<2>(test.param) == ShadowFilter::exact ? "_by_rays" : "_by_maps");
    });

TEST_P(HardTints, AreThoseOfRaysInDouble) {
    const auto& [hard, kind, filter] = GetParam();
    make(hard);
    draw();
    const Errors found = errors();
    std::cout << "mean " << found.mean << "/255, beyond 1/255 " << found.beyond << " of " << found.pixels << ", tinted "
              << found.tinted << '\n';
    EXPECT_GT(found.pixels, 10000u);
    EXPECT_GT(found.tinted, 200u);
    EXPECT_LE(found.mean, filter == ShadowFilter::exact ? kMostByRays : kMostByMaps);
}

TEST(TintLayers, HaveTheMapsEdgeUpToTheirLimit) {
    EXPECT_EQ(shadow::tint_edge_px(0, 1), 0u);
    EXPECT_EQ(shadow::tint_edge_px(1, 8), 1u);
    EXPECT_EQ(shadow::tint_edge_px(1024, 1), 1024u);
    EXPECT_EQ(shadow::tint_edge_px(1024, 2), 1024u);
    EXPECT_EQ(shadow::tint_edge_px(1024, 3), 512u);
    EXPECT_EQ(shadow::tint_edge_px(2048, 1), 1024u);
    EXPECT_EQ(shadow::tint_edge_px(16384, 6), 512u);
    for (std::uint32_t edge_px = 1; edge_px < 20000; edge_px = edge_px * 3 / 2 + 1)
        for (std::uint32_t views = 1; views <= 8; ++views) {
            const std::uint64_t edge = shadow::tint_edge_px(edge_px, views);
            EXPECT_LE(edge * edge * views * shadow::kTintTexelBytes, std::uint64_t{96} << 20);
            EXPECT_GE(edge, 1u);
        }
}

}  // namespace
}  // namespace gnomon
