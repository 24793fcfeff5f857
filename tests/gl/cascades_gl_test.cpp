#include <cmath>
#include <iostream>
#include <ostream>

#include "tests/gl/box_fixture.h"

// A sun's cascades in the picture: whatever the fit, their number and what fades between them, the shadows are true.
namespace gnomon {
namespace {

struct Cascades {
    ShadowFit fit;
    std::uint32_t count;
    float blend;
    CascadeSplits splits = CascadeSplits::practical;
    friend void PrintTo(const Cascades& c, std::ostream* out) {
        *out << "fit " << static_cast<int>(c.fit) << ", " << c.count << " cascades, blend " << c.blend << ", splits "
             << static_cast<int>(c.splits);
    }
};

class CascadePictures : public BoxTest {
protected:
    /// Boxes in a row along the view, from 3 m to 30 m, on a ground under a slanting sun.
    void add_street(const Cascades& cascades) {
        add_ground(40.0);
        for (const double z : {-1.0, -4.0, -9.0, -18.0, -30.0}) {
            add_box({-0.9, 0.0, z - 0.5}, {-0.2, 1.2, z + 0.4});
            add_box({1.2, 1.0, z - 0.6}, {2.0, 1.6, z + 0.5});
        }
        add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, {-0.5, -1.0, -0.3},
                  {.filter = ShadowFilter::hard,  // so that cascades differ where edges are
                   .resolution_px = 1024,
                   .cascades = cascades.count},
                  {.cascades = {.fit = cascades.fit,
                                .splits = cascades.splits,
                                .split_m = {3.0f, 8.0f, 14.0f},
                                .blend = cascades.blend}});
        add_camera({.fov_y_rad = 0.9f, .near_m = 0.1}, {0.3, 2.2, 3.0}, {0.0, -0.35, -1.0});
    }
};

class CascadesOf : public CascadePictures, public ::testing::WithParamInterface<Cascades> {};

TEST_P(CascadesOf, AStreetOfBoxesGiveTrueShadowsNearAndFar) {
    truth.margin_m = 0.12;
    add_street(GetParam());
    draw();
    expect_true(kSome, 10 * kSome);
    // And still, when the camera has moved with its history.
    for (int step = 0; step < 3; ++step) {
        const ecs::Entity camera = frame().snapshot().consumers.front().entity;
        world.patch<Transform>(camera, [](Transform& t) { t.translation_m += glm::dvec3(0.07, 0.0, -0.31); });
        draw();
        expect_true(kSome, 10 * kSome);
    }
}

INSTANTIATE_TEST_SUITE_P(EachMode, CascadesOf,
                         ::testing::Values(Cascades{ShadowFit::tight, 4, 0.0f}, Cascades{ShadowFit::tight, 4, 0.2f},
                                           Cascades{ShadowFit::tight, 8, 0.1f}, Cascades{ShadowFit::stable, 4, 0.0f},
                                           Cascades{ShadowFit::stable, 4, 0.3f}, Cascades{ShadowFit::stable, 8, 0.5f},
                                           Cascades{ShadowFit::quantised, 4, 0.0f},
                                           Cascades{ShadowFit::quantised, 4, 0.3f},
                                           Cascades{ShadowFit::quantised, 7, 0.1f},
                                           Cascades{ShadowFit::quantised, 4, 0.2f, CascadeSplits::manual},
                                           Cascades{ShadowFit::quantised, 4, 0.2f, CascadeSplits::seen},
                                           Cascades{ShadowFit::quantised, 4, 0.2f, CascadeSplits::sampled},
                                           Cascades{ShadowFit::tight, 4, 0.0f, CascadeSplits::sampled},
                                           Cascades{ShadowFit::tight, 4, 0.2f, CascadeSplits::uniform}));

TEST_F(CascadePictures, FadingMixesTwoHardEdgesAndNothingElseDoes) {
    add_street({ShadowFit::quantised, 4, 0.5f});
    draw();
    const auto between = [](const std::vector<float>& field) {
        return std::count_if(field.begin(), field.end(), [](float v) { return v > 0.01f && v < 0.99f; });
    };
    EXPECT_GT(between(visibility()), 8);
    const ecs::Entity sun = frame().snapshot().lights.front().entity;
    edit_light(world, sun, [](ShadowTuning& t) { t.cascades.blend = 0.0f; });
    draw();
    EXPECT_EQ(between(visibility()), 0);
}

class LitCascades : public CascadePictures, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    std::uint32_t skipped() {
        std::uint32_t count = 0;
        for (const ViewReport& view : frame().report().views)
            count += view.state == LightState::skipped && view.reason == Reason::no_caster ? 1u : 0u;
        return count;
    }
};

/// Compares two pictures. A cascade without a caster is taken as lit. With a caster that shadows only places out of
/// sight, it is drawn and looked up.
TEST_P(LitCascades, ShowToTheBitWhatEmptyMapsWouldShow) {
    for (const float blend : {0.0f, 0.3f}) {
        start_anew();
        add_ground(40.0);
        add_box({-0.9, 0.0, -1.5}, {-0.2, 1.2, -0.6});
        const glm::dvec3 along(-0.5, -1.0, -0.3);
        add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, along,
                  {.filter = GetParam(), .resolution_px = 512, .cascades = 4}, {.cascades = {.blend = blend}});
        add_camera({.fov_y_rad = 0.9f, .near_m = 0.1}, {0.3, 2.2, 3.0}, {0.0, -0.35, -1.0});
        // Casters to both sides of what is seen, high above the ground that the farther maps contain.
        std::vector<ecs::Entity> high;
        const std::uint32_t mesh = add_mesh(game::make_box(glm::dvec3(-0.3), glm::dvec3(0.3)));
        for (const double distance_m : {8.0, 12.0, 16.0, 22.0, 30.0})
            for (const double side : {-1.0, 1.0}) {
                const glm::dvec3 shadow_m(0.3 + side * (1.0 + 0.7 * distance_m), 0.0, 3.0 - distance_m);
                high.push_back(place(mesh, {.translation_m = shadow_m - 8.0 * along}, false));
                world.patch<MeshRef>(high.back(), [](MeshRef& there) { there.visible = false; });
            }
        draw();
        const std::uint32_t lit = skipped();
        EXPECT_GE(lit, 1u) << "the test says something";
        const std::vector<float> without = visibility();
        EXPECT_GT(std::count(without.begin(), without.end(), 0.0f), 50);
        for (const ecs::Entity caster : high) world.emplace<ShadowCaster>(caster);
        draw();
        EXPECT_LT(skipped(), lit) << "the caster is in a map";
        const std::vector<float> with = visibility();
        float largest = 0.0f;
        for (std::size_t i = 0; i < with.size(); ++i) largest = std::max(largest, std::abs(with[i] - without[i]));
        // Compilers of hardware drivers join products and sums as they like, otherwise in each program.
        EXPECT_LE(largest, device().info().is_software ? 0.0f : 0x1p-22f);
    }
}

INSTANTIATE_TEST_SUITE_P(EachStorage, LitCascades,
                         ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf_bilinear, ShadowFilter::triangles,
                                           ShadowFilter::vsm, ShadowFilter::evsm4, ShadowFilter::moments));

}  // namespace
}  // namespace gnomon
