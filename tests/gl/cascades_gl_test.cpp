#include <ostream>

#include "tests/gl/box_fixture.h"

// A sun's cascades in the picture: whatever the fit, their number and what fades between them, the shadows are true.
namespace gnomon {
namespace {

constexpr std::size_t kSome = 300;  // pixels; a claim about fewer is none

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
                   .fit = cascades.fit,
                   .cascades = cascades.count,
                   .splits = cascades.splits,
                   .split_m = {3.0f, 8.0f, 14.0f},
                   .cascade_blend = cascades.blend});
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
    world.patch<LightShadow>(sun, [](LightShadow& s) { s.cascade_blend = 0.0f; });
    draw();
    EXPECT_EQ(between(visibility()), 0);
}

}  // namespace
}  // namespace gnomon
