#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/gl/hard_case_fixture.h"

// Neither the size of the world nor its distance from the origin changes a shadow.
namespace gnomon::hard {
namespace {

constexpr const char* kFits[] = {"fit=tight", "fit=stable", "fit=quantised"};
constexpr const char* kSize = "resolution=256";

void boxes(World& w) {
    w.ground(6.0);
    w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    w.box({1.4, 0.8, -1.6}, {2.0, 1.1, 1.2});
    w.camera();
}

void lamp_and_spots(World& w) {
    w.settings = {kSize};
    w.lamp({1.5, 4.0, -1.0});
    w.lamp({-1.0, 3.0, 2.0}, 6.0, {},
           {.projection = {.near_m = static_cast<float>(0.5 * w.scale), .far_m = static_cast<float>(7.0 * w.scale)}});
    w.spot({-2.0, 5.0, 1.0}, {0.4, -1.0, -0.2}, 0.7);
    w.spot({-2.0, 3.0, 1.0}, {0.4, -1.0, -0.2}, 1.2);  // so wide that it is faces of a cube
}

/// Adds a sun of each fit, one with distances of its own, one with a constant bias, and local lights.
void all_lights(World& w) {
    const auto metres = [&](double m) { return static_cast<float>(m * w.scale); };
    for (const char* fit : kFits) {
        w.settings = {fit, kSize};
        w.sun(kSlant);
    }
    w.settings = {"fit=tight", kSize, "splits=manual"};
    w.sun(kSlant, {}, {.cascades = {.split_m = {metres(6.0), metres(11.0)}, .blend = 0.25f}});
    w.settings = {"fit=tight", kSize};
    w.sun(kSlant, {}, {.bias = {.mode = BiasMode::constant, .offset_m = metres(0.03)}});
    lamp_and_spots(w);
}

class ScaleAndPlaceGl : public HardCaseGl {
protected:
    std::vector<std::vector<float>> fields(World& world) {
        draw(world);
        std::vector<std::vector<float>> all;
        for (std::uint32_t l = 0; l < scene().lights.size(); ++l) all.push_back(visibility(l));
        return all;
    }

    /// Expects the same visibility here and there in at least 99.99 % of the pixels.
    void expect_same(const std::vector<std::vector<float>>& here, const std::vector<std::vector<float>>& there) {
        constexpr double kMostChanged = 1e-4;
        ASSERT_EQ(here.size(), there.size());
        for (std::size_t l = 0; l < here.size(); ++l) {
            std::size_t changed = 0, lit = 0, dark = 0;
            for (std::size_t i = 0; i < here[l].size(); ++i) {
                changed += there[l][i] != here[l][i];
                lit += here[l][i] == 1.0f;
                dark += here[l][i] == 0.0f;
            }
            RecordProperty("changed_" + std::to_string(l), std::to_string(changed));
            EXPECT_LE(static_cast<double>(changed), kMostChanged * static_cast<double>(here[l].size()))
                << changed << " of " << here[l].size() << ", light " << l;
            EXPECT_GT(lit, here[l].size() / 50);
            EXPECT_GT(dark, here[l].size() / 200) << "light " << l;
        }
    }
};

TEST_F(ScaleAndPlaceGl, AScaleByAnyPowerOfTwoFromMinus13To26ChangesNoBitOfVisibility) {
    std::vector<std::vector<float>> unit;
    for (int power = -13; power <= 26; ++power) {
        SCOPED_TRACE("2^" + std::to_string(power));
        for (const bool scaled : {false, true}) {
            if (!scaled && !unit.empty()) continue;
            World world;
            world.viewport_px = {96, 54};
            world.scale = scaled ? std::exp2(power) : 1.0;
            boxes(world);
            all_lights(world);
            const auto all = fields(world);
            if (!scaled) unit = all;
            ASSERT_EQ(all.size(), unit.size());
            for (std::size_t l = 0; l < all.size(); ++l) EXPECT_EQ(all[l], unit[l]) << "light " << l;
        }
    }
    ASSERT_EQ(unit.size(), 9u);
    for (const auto& field : unit) {
        EXPECT_GT(std::count(field.begin(), field.end(), 0.0f), 20);
        EXPECT_GT(std::count(field.begin(), field.end(), 1.0f), 200);
    }
}

TEST_F(ScaleAndPlaceGl, LocalLightsAndATightSunShowTheSameAHundredMillionMetresAway) {
    std::vector<std::vector<float>> here;
    for (const glm::dvec3& offset_m : {glm::dvec3(0.0), glm::dvec3(1e8, 0.0, 0.0), glm::dvec3(-1e8, 1e8, 1e8)}) {
        SCOPED_TRACE(offset_m.x);
        World world;
        world.offset_m = offset_m;
        boxes(world);
        world.settings = {"fit=tight", kSize};
        world.sun(kSlant);
        lamp_and_spots(world);
        const auto there = fields(world);
        if (here.empty())
            here = there;
        else
            expect_same(here, there);
    }
}

/// Adds a sun with one cascade: no distance is whole in the texel sizes of several.
void one_cascade(World& w, const char* fit) {
    boxes(w);
    w.settings = {fit, kSize, "cascades=1"};
    w.sun(kSlant);
}

TEST_F(ScaleAndPlaceGl, SnappedFitsShowTheSameAHundredMillionMetresAwayByWholeTexels) {
    constexpr double kPlace_texel = 256.0;  // what stable maps move by, 8 texels of 256, divides it
    for (const char* fit : kFits) {
        if (fit == kFits[0]) continue;
        SCOPED_TRACE(fit);
        World world, other;
        one_cascade(world, fit);
        World measured;
        one_cascade(measured, fit);
        Stages stages(measured);
        stages.run();
        const shadow::ShadowView& view = *stages.views().at(0);
        const auto whole = [&](double texel_m, double distance_m) {
            return std::round(distance_m / (kPlace_texel * texel_m)) * kPlace_texel * texel_m;
        };
        other.offset_m = view.pose.axis_u * whole(view.plane.texel_u, 8e7) - view.pose.axis_v * whole(view.plane.texel_v, 6e7);
        ASSERT_NEAR(glm::length(other.offset_m), 1e8, 1e4);
        one_cascade(other, fit);
        const auto here = fields(world);
        expect_same(here, fields(other));
    }
}

}  // namespace
}  // namespace gnomon::hard
