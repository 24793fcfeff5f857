#include <cmath>

#include "tests/gl/traced_frame_fixture.h"

/// Instances that a scale of 0 along one axis flattens: they have no inverse, and an area.
namespace gnomon {
namespace {

class FlatCasters : public TracedFrameTest, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    void make_plate(const Transform& transform) {
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0})), {}, false);
        place(add_analysed(game::make_box({-1.0, -0.5, -1.0}, {1.0, 0.5, 1.0})), transform);
        add_camera({.fov_y_rad = 0.8, .near_m = 0.1, .far_m = 60.0}, {3.0, 5.0, 6.0}, {-3.0, -5.0, -6.0});
    }
    /// Returns the limit, a share of the pixels. Texels have steps; triangles have none, and a walk goes over the flat
    /// sides of a box.
    static double most_wrong() { return GetParam() == ShadowFilter::hard ? 0.005 : 0.0001; }
};

INSTANTIATE_TEST_SUITE_P(Filters, FlatCasters,
                         ::testing::Values(ShadowFilter::hard, ShadowFilter::triangles, ShadowFilter::exact),
                         [](const auto& test) { return std::to_string(static_cast<int>(test.param)); });

TEST_P(FlatCasters, CastAndReceiveAsPlatesDo) {
    // The second plate is turned out of all axes: its basis is singular except for rounding.
    const Transform plates[] = {{.translation_m = {0.0, 1.0, 0.0}, .scale = {1.0, 0.0, 1.0}},
                                {.translation_m = {0.0, 1.5, 0.0},
                                 .rotation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))),
                                 .scale = {-1.0, 0.0, 1.0}}};
    for (const Transform& plate : plates) {
        start_anew();
        make_plate(plate);
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
            add_light_of(kind, {0.8, 9.0, 0.5}, {.filter = GetParam(), .resolution_px = 1024});
        draw();
        ASSERT_TRUE(frame().snapshot().dropped.empty());
        for (const std::uint32_t light : {0u, 1u, 2u}) {
            const Judged judged = judge(light);
            EXPECT_GT(judged.truly_dark, 2000u) << light;
            const auto wrong = static_cast<double>(judged.metrics.false_light + judged.metrics.false_shadow);
            EXPECT_LE(wrong, most_wrong() * static_cast<double>(judged.metrics.scored)) << light;
            for (const float share : judged.measured) ASSERT_TRUE(std::isfinite(share));
        }
        // The middle of the picture shows the plate's upper face.
        const std::vector<float> seen = visibility(0);
        const glm::uvec2 size = settings.viewport_px;
        if (plate.scale.x < 0.0) continue;
        EXPECT_GT(seen[std::size_t{size.y} * 3 / 5 * size.x + size.x / 2], 0.9f) << "it is lit, and not dark by itself";
    }
}

TEST_P(FlatCasters, OfNoAreaAreLeftOutWithAWord) {
    for (const glm::dvec3& scale : {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)}) {
        start_anew();
        make_plate({.translation_m = {0.0, 1.0, 0.0}, .rotation = glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0)), .scale = scale});
        add_light_of(LightKind::directional, {0.8, 9.0, 0.5}, {.filter = GetParam()});
        draw();
        ASSERT_EQ(frame().snapshot().dropped.size(), 1u);
        EXPECT_EQ(frame().snapshot().dropped[0].reason, DropReason::zero_scale);
    }
}

}  // namespace
}  // namespace gnomon
