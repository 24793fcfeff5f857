#include <array>

#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/box_fixture.h"
#include "tests/long_run.h"

// What is seen lies in one plane across the light: all at one depth, with the casters far before it.
namespace gnomon {
namespace {

class FlatReceivers : public BoxTest {
protected:
    /// Builds a ground under two boxes. The camera is below both, so that it sees the ground alone.
    void build(double scale) {
        start_anew();
        truth = {};
        truth.margin_m = 0.15 * scale;
        add_ground(6.0 * scale);
        add_box(scale * glm::dvec3(-1.5, 1.0, -1.5), scale * glm::dvec3(1.2, 1.5, 1.5));
        add_box(scale * glm::dvec3(-1.5, 3.5, -1.5), scale * glm::dvec3(0.0, 4.0, 1.5));
        add_camera({.fov_y_rad = 2.5, .near_m = 0.01 * scale}, scale * glm::dvec3(0.0, 0.8, 0.0), {0.0, -1.0, 0.0});
    }
    /// Adds a light straight above for every row of the table.
    void add_rows(LightKind kind, double scale, const ShadowTuning& tuning) {
        const Light light{.kind = kind, .intensity = 3000.0f, .outer_cone_rad = 0.9f};
        for (const shadow::FilterRow& row : shadow::filter_table())
            add_light(light, scale * glm::dvec3(0.0, 6.0, 0.0), {0.0, -1.0, 0.0},
                      {.filter = row.id, .resolution_px = 512}, tuning);
    }
    void expect_every_row_true(const std::string& what) {
        constexpr float kOnePercent = 0.01f;
        const SceneSnapshot& scene = frame().snapshot();
        for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
            SCOPED_TRACE(what + ", " + std::string(shadow::filter_row(scene.lights[i].shadow.filter).name));
            const boxes::Verdict verdict =
                boxes::judge(truth, scene.consumers.front(), scene.lights[i], visibility(i), kOnePercent);
            EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
            EXPECT_GT(verdict.dark, 3000u);
            EXPECT_GT(verdict.lit, 1000u);
        }
    }
};

TEST_F(FlatReceivers, UnderTheSunAreDarkBelowWhatFloatsAboveThemWhateverTheFit) {
    constexpr std::array kFits{ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised};
    constexpr std::array kScales{1.0, 1.0e-3, 1.0e3};
    for (const ShadowFit fit : kFits)
        for (const double scale : kScales) {
            // A short run takes each fit and each scale once, a long one every pair.
            if (!is_long_run() && kScales[static_cast<std::size_t>(fit) % kScales.size()] != scale) continue;
            build(scale);
            add_rows(LightKind::directional, scale, {.cascades = {.fit = fit}});
            draw();
            expect_every_row_true("fit " + std::to_string(static_cast<int>(fit)) + ", " + std::to_string(scale));
        }
}

TEST_F(FlatReceivers, UnderLampsAreDarkBelowWhatFloatsAboveThem) {
    for (const LightKind kind : {LightKind::spot, LightKind::point}) {
        build(1.0);
        add_rows(kind, 1.0, {.moments = {.bleeding = 0.4f}});  // one caster behind the other
        draw();
        expect_every_row_true(std::string(shadow::light_kind_row(kind).name));
    }
}

}  // namespace
}  // namespace gnomon
