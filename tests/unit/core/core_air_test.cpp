#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/core_scene.h"

/// Boxes of air: receivers that a camera may stand in.
namespace gnomon::core {
namespace {

/// Makes a scene with its camera in a box of air or, without `air`, of anything.
OwnScene camera_in_a_box(bool air) {
    OwnScene own = courtyard();
    own.cameras[0].position_ws_m = {0.0, 2.0, 2.0};  // in the light of all
    Box box;
    box.min_ws_m = {-20.0, 0.0, -20.0};
    box.max_ws_m = {20.0, 6.0, 20.0};
    box.casts = air;  // not read where it is air
    box.air = air;
    own.boxes.push_back(box);
    for (Light& light : own.lights) light.shadow.resolution_px = 1024;
    return own;
}

TEST(CoreAir, AsksForNoTexelsAsFineAsTheNearPlane) {
    const OwnScene in_air = camera_in_a_box(true), in_a_surface = camera_in_a_box(false);
    History history, other;
    Fits air, surface;
    fit_shadows(in_air.scene(), {}, history, air);
    fit_shadows(in_a_surface.scene(), {}, other, surface);
    for (std::size_t i = 0; i < in_air.lights.size(); ++i) {
        EXPECT_GT(air.lights()[i].edge_error_px, 0.0);
        EXPECT_LT(air.lights()[i].edge_error_px, 0.5 * surface.lights()[i].edge_error_px) << "control, light " << i;
    }
}

TEST(CoreAir, ReceivesAndDoesNotCast) {
    OwnScene own = camera_in_a_box(true);
    const auto box = static_cast<std::uint32_t>(own.boxes.size() - 1);
    for (Box& other : own.boxes) other.receives = other.air;
    History history;
    Fits fits;
    fit_shadows(own.scene(), {}, history, fits);
    const auto has = [&](std::span<const std::uint32_t> items) {
        return std::find(items.begin(), items.end(), box) != items.end();
    };
    for (std::size_t i = 0; i < own.lights.size(); ++i) {
        EXPECT_TRUE(has_maps(fits.lights()[i].status));
        EXPECT_TRUE(has(fits.receivers_of(i)));
        EXPECT_FALSE(has(fits.casters_of(i)));
    }
    own.boxes.back().receives = false;
    fit_shadows(own.scene(), {}, history, fits);
    for (const LightFit& fit : fits.lights()) EXPECT_EQ(fit.status, Status::no_visible_receiver) << "control";
    own.boxes.back().receives = true;
    own.boxes.back().max_ws_m.y = std::nan("");
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_EQ(fits.unusable_boxes(), 1u);
}

}  // namespace
}  // namespace gnomon::core
