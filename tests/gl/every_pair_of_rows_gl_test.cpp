#include <algorithm>
#include <cmath>
#include <string>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/held_frame_fixture.h"

/// All rows of light kinds and filters in one frame: none is disturbed by another, whatever stands before it.
namespace gnomon {
namespace {

constexpr glm::uvec2 kSize_px{48, 36};
constexpr std::uint32_t kMap_px = 32;

class EveryPairOfRows : public HeldFrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0}));
        const std::uint32_t box = add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5}));
        place(plane, {}, false);
        for (const double x : {-1.5, 1.5}) place(box, {.translation_m = {x, 0.3, 0.0}});
        add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        settings.viewport_px = kSize_px;
    }
    /// Returns whether a row is another than a point's: filters that see the middle alone look area lights up as points.
    static bool is_its_own(const shadow::LightKindRow& kind, const shadow::FilterRow& filter) {
        return !light_facts(kind.kind).area() || filter.width == shadow::FilterWidth::source;
    }
    static constexpr std::size_t kPointLike = 3, kArea = 4, kSoft = 4;  // kinds; kinds; filters that see a source
    /// Adds one light per row, each at its own place.
    void add_lights() {
        for (const shadow::LightKindRow& kind : shadow::light_kind_table())
            for (const shadow::FilterRow& filter : shadow::filter_table()) {
                if (!is_its_own(kind, filter)) continue;
                const LightShadow wish{.filter = filter.id, .resolution_px = kMap_px};
                const Light light{.kind = kind.kind,
                                  .intensity = 100.0f,
                                  .outer_cone_rad = 0.6f,
                                  .source_radius_m = 0.1f,
                                  .sun_radius_rad = 0.03f};
                const double angle = 0.4 * static_cast<double>(lights.size());
                const glm::dvec3 at(2.0 * std::cos(angle), 4.0, 2.0 * std::sin(angle));
                lights.push_back(add_light(light, at, -at, wish));
            }
    }
    /// Returns the visibility of the last of `indices`; all of them are recorded in one list.
    std::vector<float> visibility_after(std::initializer_list<std::uint32_t> indices) {
        gl::CommandList list;
        for (const std::uint32_t i : indices) EXPECT_TRUE(lighting->record_visibility(inputs(), i, *scene, list));
        GlTest::run(list);
        return read<float>(lighting->visibility_texture(), std::size_t{kSize_px.x} * kSize_px.y);
    }
    std::string name(std::uint32_t i) const {
        return std::string(inputs().lights[i].row.kind_file) + " " + std::string(inputs().lights[i].row.filter_file);
    }

    std::vector<ecs::Entity> lights;
};

TEST_F(EveryPairOfRows, IsDrawnInOneFrameAsEachIsAlone) {
    add_lights();
    run();
    const std::size_t rows = lights.size();
    ASSERT_EQ(rows, kPointLike * shadow::filter_table().size() + kArea * kSoft);
    std::vector<std::vector<float>> together;
    for (std::uint32_t i = 0; i < rows; ++i) {
        EXPECT_EQ(report.lights[i].state, LightState::rendered) << name(i) << ": " << reason_code(report.lights[i].reason);
        for (std::uint32_t k = 0; k < i; ++k) EXPECT_FALSE(inputs().lights[i].row == inputs().lights[k].row) << name(i);
        together.push_back(visibility_after({i}));
        const auto dark = std::count_if(together[i].begin(), together[i].end(), [](float v) { return v >= 0.0f && v < 0.5f; });
        const auto lit = std::count_if(together[i].begin(), together[i].end(), [](float v) { return v > 0.9f; });
        // Both are there, so that a row that reads another's map is seen; how dark a shadow is, other tests judge.
        EXPECT_TRUE(dark > 2 && lit > 100) << name(i) << ": " << dark << " dark, " << lit << " lit";
    }
    // Every row directly after every other one: nothing that a pass leaves bound may reach the next.
    for (std::uint32_t before = 0; before < rows; ++before)
        for (std::uint32_t i = 0; i < rows; ++i)
            if (i != before) {
                ASSERT_EQ(visibility_after({before, i}), together[i]) << name(i) << " after " << name(before);
            }
    // And alone in the world.
    std::vector<ecs::Entity> kept = lights;
    std::vector<Light> light_of;
    std::vector<LightShadow> shadow_of;
    for (const ecs::Entity light : kept) {
        light_of.push_back(*world.get<Light>(light));
        shadow_of.push_back(*world.get<LightShadow>(light));
        world.remove<Light>(light);
        world.remove<LightShadow>(light);
    }
    for (std::uint32_t i = 0; i < rows; ++i) {
        world.emplace<Light>(kept[i], light_of[i]);
        world.emplace<LightShadow>(kept[i], shadow_of[i]);
        run();
        ASSERT_EQ(inputs().lights.size(), 1u);
        EXPECT_EQ(visibility_after({0}), together[i]) << name(0);
        world.remove<Light>(kept[i]);
        world.remove<LightShadow>(kept[i]);
    }
}

}  // namespace
}  // namespace gnomon
