#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/gl/lookup_fixture.h"

namespace gnomon {

/// Two boxes on the ground, and any number of lights around them.
class AllLights : public LookupTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0}));
        box = add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5}));
        place(plane, {}, false);
        for (const double x : {-1.5, 1.5}) boxes.push_back(place(box, {.translation_m = {x, 0.3, 0.4 * x}}));
        add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        settings.viewport_px = {160, 120};
    }
    /// Adds a light at a place of its own around the boxes.
    ecs::Entity add(LightKind kind, const LightShadow& wish, std::size_t i, float cone_rad = 0.6f, const ShadowTuning& tuning = {}) {
        const Light light{.kind = kind,
                          .intensity = 100.0f,
                          .outer_cone_rad = cone_rad,
                          .source_radius_m = 0.1f,
                          .sun_radius_rad = 0.03f};
        const double angle = 0.7 * static_cast<double>(i);
        const glm::dvec3 at(2.0 * std::cos(angle), 3.5, 2.0 * std::sin(angle));
        lights.push_back(add_light(light, at, -at, wish, tuning));
        return lights.back();
    }
    /// Adds suns, spots narrow and wide, and points, with maps of several sizes.
    void add_eight(ShadowFilter filter = ShadowFilter::automatic) {
        using enum LightKind;
        constexpr std::uint32_t kSizes_px[] = {700, 256, 400};
        for (const LightKind kind : {directional, spot, point, spot, point, spot, directional, point}) {
            const std::size_t i = lights.size();
            const float cone_rad = i % 8 == 5 ? 1.4f : 0.6f;  // a wide one has faces of a cube
            add(kind, {.filter = filter, .resolution_px = kSizes_px[i % 3]}, i, cone_rad);
        }
    }
    std::string name(std::uint32_t i) const {
        const shadow::ShaderKey& row = inputs().lights[i].row;
        return std::to_string(i) + ": " + std::string(row.kind_file) + " " + std::string(row.filter_file);
    }
    /// Expects every light to be looked up as by its own pass, to rounding.
    void expect_alike(gl::ProgramHandle program, std::size_t least_dark = 100, std::size_t most_apart = 0,
                      double most_by = kRounding) {
        const auto found = looked_up(program);
        double largest = 0.0;
        std::size_t apart = 0, between = 0;
        for (std::uint32_t i = 0; i < found.size(); ++i) {
            const Difference d = difference(found[i], recorded(i));
            EXPECT_EQ(table->outcomes()[i].status, lookup::LookupStatus::own_filter) << name(i) << " " << lookup::to_text(table->outcomes()[i].status);
            EXPECT_LE(d.pixels, most_apart) << name(i) << " differs by " << d.largest;
            EXPECT_LE(d.largest, most_by) << name(i);
            EXPECT_TRUE(d.dark > least_dark && d.lit > 100) << name(i) << ": " << d.dark << " dark, " << d.lit << " lit";
            largest = std::max(largest, d.largest);
            apart += d.pixels;
            between += static_cast<std::size_t>(std::count_if(found[i].begin(), found[i].end(), [](float v) { return v > 0.0f && v < 1.0f; }));
        }
        RecordProperty("largest_difference", std::to_string(largest));
        RecordProperty("pixels_apart", std::to_string(apart));
        RecordProperty("pixels_between", std::to_string(between));
    }

    static constexpr std::array kFew = {ShadowFilter::triangles, ShadowFilter::pcf_bilinear};  // compile sooner
    std::uint32_t box = 0;
    std::vector<ecs::Entity> boxes, lights;
};

}  // namespace gnomon
