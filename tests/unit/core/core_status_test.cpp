#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/unit/allocation_counter.h"
#include "tests/unit/core/core_scene.h"

/// Input without meaning gets a status, and leaves the rest as it was; a warm call allocates nothing.
namespace gnomon::core {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

bool is_finite(const glm::mat4& m) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i / 4][i % 4])) return false;
    return true;
}

class CoreStatus : public ::testing::Test {
protected:
    /// Fits from a fresh history, and checks what holds whatever the input.
    void run(const Settings& settings = {}) {
        history = {};
        again(settings);
    }
    void again(const Settings& settings = {}) {
        fit_shadows(own.scene(), settings, history, fits);
        ASSERT_EQ(fits.lights().size(), own.lights.size());
        for (std::size_t i = 0; i < own.lights.size(); ++i) {
            const LightFit& fit = fits.lights()[i];
            EXPECT_EQ(fits.views_of(i).empty(), !has_maps(fit.status)) << to_text(fit.status);
            EXPECT_EQ(fit.map_px > 0, has_maps(fit.status));
        }
        for (const View& view : fits.views()) {
            EXPECT_TRUE(is_finite(view.clip_from_anchor) && is_finite(view.map_from_anchor));
            EXPECT_LT(view.near_m, view.far_m);
            EXPECT_LT(view.layer, fits.lights()[view.light].layers);
            for (const std::uint32_t c : fits.casters_of(view)) EXPECT_LT(c, own.boxes.size());
        }
    }
    Status status(std::size_t light) const { return fits.lights()[light].status; }

    OwnScene own = courtyard();
    History history;
    Fits fits;
};

TEST_F(CoreStatus, HasANameAndASentence) {
    for (int i = 0; i <= static_cast<int>(Status::fit_degenerate); ++i) {
        const auto status = static_cast<Status>(i);
        const std::string text = sentence(status);
        EXPECT_STRNE(to_text(status), "unknown");
        EXPECT_EQ(text.back(), '.');
        EXPECT_EQ(text.find(". "), std::string::npos) << "one sentence";
    }
    EXPECT_STREQ(to_text(static_cast<Status>(200)), "unknown");
}

TEST_F(CoreStatus, SaysWhyALightHasNoMap) {
    const OwnScene usual = own;
    own.lights[1].enabled = false;
    run();
    EXPECT_EQ(status(0), Status::fitted);
    EXPECT_EQ(status(1), Status::off);
    own = usual;
    own.cameras.clear();
    run();
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(status(i), Status::no_camera);
    own = usual;
    own.boxes.clear();
    run();
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(status(i), Status::no_visible_receiver);
    own.lights.clear();
    run();
    EXPECT_TRUE(fits.lights().empty() && fits.views().empty());
    fit_shadows({}, {}, history, fits);
    EXPECT_TRUE(fits.lights().empty());
}

TEST_F(CoreStatus, SaysWhatWasChanged) {
    struct Case {
        std::function<void(Shadow&)> set;
        Status status;
        std::size_t light = 0;
    };
    const Case cases[] = {{[](Shadow& s) { s.resolution_px = 1u << 20; }, Status::resolution_clamped},
                          {[](Shadow& s) { s.cascades = 99; }, Status::cascades_clamped},
                          {[](Shadow& s) { s.split_lambda = 7.0f; }, Status::splits_invalid},
                          {[](Shadow& s) { s.blend = std::numeric_limits<float>::quiet_NaN(); }, Status::splits_invalid},
                          {[](Shadow& s) { s.near_m = -1.0f; }, Status::range_invalid, 1},
                          {[](Shadow& s) { s.near_m = 5.0f, s.far_m = 2.0f; }, Status::range_invalid, 2},
                          {[](Shadow& s) { s.filter = Filter::grid, s.kernel_texel = 1000; }, Status::filter_cut},
                          {[](Shadow& s) { s.filter = Filter::disk, s.spread_texel = -3.0f; }, Status::filter_cut},
                          {[](Shadow& s) { s.max_error_px = 1e-6f; }, Status::error_above_target},
                          {[](Shadow& s) { s.max_error_px = std::numeric_limits<float>::quiet_NaN(); }, Status::fitted},
                          {[](Shadow& s) { s.filter = static_cast<Filter>(77); }, Status::fitted}};
    for (const Case& one : cases) {
        own = courtyard();
        one.set(own.lights[one.light].shadow);
        run();
        for (std::size_t i = 0; i < own.lights.size(); ++i)
            EXPECT_EQ(status(i), i == one.light ? one.status : Status::fitted) << to_text(status(i)) << " for " << to_text(one.status);
    }
}

TEST_F(CoreStatus, SentencesOfLimitsNameThem) {
    EXPECT_NE(std::string(sentence(Status::cascades_clamped)).find("the light has " + std::to_string(kMostCascades) + "."), std::string::npos);
    EXPECT_NE(std::string(sentence(Status::resolution_clamped)).find("below 16 texels"), std::string::npos);
    own.lights[0].shadow.resolution_px = 15;
    run();
    EXPECT_EQ(status(0), Status::resolution_clamped);
    EXPECT_EQ(fits.lights()[0].map_px, 16u);
}

TEST_F(CoreStatus, KeepsToTheDevicesSizes) {
    for (Light& light : own.lights) light.shadow.max_error_px = 0.01f;
    run({.max_map_px = 512, .max_cube_px = 128});
    EXPECT_EQ(fits.lights()[0].map_px, 512u);
    EXPECT_EQ(fits.lights()[1].map_px, 512u);
    EXPECT_EQ(fits.lights()[2].map_px, 128u);
    run({.max_map_px = 0, .max_cube_px = 0});
    EXPECT_EQ(fits.lights()[0].map_px, 16u);
}

TEST_F(CoreStatus, PassesOverLightsWithoutMeaning) {
    const std::function<void(Light&)> breaks[] = {[](Light& l) { l.position_ws_m.x = kNan; },
                                                  [](Light& l) { l.rotation_ws[1].y = kInfinity; },
                                                  [](Light& l) { l.range_m = -1.0f; },
                                                  [](Light& l) { l.range_m = std::numeric_limits<float>::infinity(); },
                                                  [](Light& l) { l.kind = static_cast<LightKind>(9); },
                                                  [](Light& l) { l.kind = LightKind::spot, l.outer_cone_rad = 0.0f; },
                                                  [](Light& l) { l.kind = LightKind::spot, l.outer_cone_rad = 3.0f; }};
    run();
    const glm::mat4 sun = fits.views_of(0).front().clip_from_anchor;
    for (const auto& damage : breaks) {
        own = courtyard();
        damage(own.lights[2]);
        run();
        EXPECT_EQ(status(2), Status::invalid_light);
        EXPECT_EQ(status(0), Status::fitted);
        EXPECT_EQ(fits.views_of(0).front().clip_from_anchor, sun) << "others as usual";
    }
}

TEST_F(CoreStatus, PassesOverCamerasWithoutMeaning) {
    const std::function<void(Camera&)> breaks[] = {
        [](Camera& c) { c.position_ws_m.z = kNan; }, [](Camera& c) { c.rotation_ws[0].x = kNan; },
        [](Camera& c) { c.fov_y_rad = 4.0; },        [](Camera& c) { c.near_m = 0.0; },
        [](Camera& c) { c.far_m = c.near_m; },       [](Camera& c) { c.viewport_px.y = 0; },
        [](Camera& c) { c.fov_y_rad = kNan; }};
    run();
    const glm::mat4 sun = fits.views_of(0).front().clip_from_anchor;
    for (const auto& damage : breaks) {
        own = courtyard();
        own.cameras.insert(own.cameras.begin(), own.cameras[0]);
        damage(own.cameras[0]);
        run();
        EXPECT_EQ(fits.unusable_cameras(), 1u);
        EXPECT_EQ(fits.views_of(0).front().clip_from_anchor, sun);
        EXPECT_EQ(fits.views_of(0).front().cameras, 2u) << "a bit per camera of the caller";
        own.cameras.pop_back();
        run();
        EXPECT_EQ(status(0), Status::no_camera);
    }
}

TEST_F(CoreStatus, PassesOverBoxesWithoutMeaning) {
    run();
    const glm::mat4 sun = fits.views_of(0).front().clip_from_anchor;
    for (const double number : {kNan, kInfinity, -kInfinity}) {
        own = courtyard();
        Box bad;
        bad.max_ws_m = {1.0, number, 1.0};
        own.boxes.insert(own.boxes.begin(), bad);
        run();
        EXPECT_EQ(fits.unusable_boxes(), 1u);
        EXPECT_EQ(fits.views_of(0).front().clip_from_anchor, sun);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(status(i), Status::fitted);
            for (const std::uint32_t c : fits.casters_of(i)) EXPECT_NE(c, 0u);
            for (const std::uint32_t r : fits.receivers_of(i)) EXPECT_NE(r, 0u);
        }
        // It becomes usable, and unusable again, in place.
        own.boxes[0] = courtyard().boxes.back();
        again();
        EXPECT_EQ(fits.unusable_boxes(), 0u);
        own.boxes[0] = bad;
        again();
        EXPECT_EQ(fits.unusable_boxes(), 1u);
    }
}

TEST_F(CoreStatus, SurvivesAnySize) {
    int fitted = 0;
    for (const double scale : {1e-300, 1e-30, 1e-4, 1.0, 1e8, 1e30, 1e150, 1e300})
        for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
            own = courtyard();
            for (Box& box : own.boxes) box.min_ws_m *= scale, box.max_ws_m *= scale;
            for (Light& light : own.lights) light.position_ws_m *= scale, light.range_m = 0.0f;
            own.cameras[0].position_ws_m *= scale;
            own.cameras[0].projection = projection;
            own.cameras[0].half_height_m *= scale;
            own.cameras[0].near_m *= scale;
            own.cameras[0].far_m = 1000.0 * scale;
            run();
            again();
            if (scale < 1e-5 || scale > 1e9) continue;
            for (std::size_t i = 0; i < 3; ++i) fitted += status(i) == Status::fitted ? 1 : 0;
        }
    EXPECT_EQ(fitted, 18) << "every light from 1e-4 m to 1e8 m";
}

TEST_F(CoreStatus, AllocatesNothingOnceWarm) {
    const auto turn = [&] {
        constexpr int kFrames = 30;
        for (int frame = 0; frame < kFrames; ++frame) {
            const double angle = 2.0 * 3.14159265358979 * frame / kFrames;
            own.cameras[0].position_ws_m = {14.0 * std::sin(angle), 4.0, 14.0 * std::cos(angle)};
            own.cameras[0].rotation_ws = looking(-own.cameras[0].position_ws_m);
            own.boxes.back().min_ws_m.x = -9.0 + 0.3 * (frame % 15);
            own.boxes.back().max_ws_m.x = own.boxes.back().min_ws_m.x + 0.6;
            fit_shadows(own.scene(), {}, history, fits);
        }
    };
    turn();
    turn();
    const std::size_t before = allocation_count();
    turn();
    EXPECT_EQ(allocation_count(), before);
    const OwnScene more = courtyard();
    for (int i = 0; i < 20; ++i) own.boxes.insert(own.boxes.end(), more.boxes.begin(), more.boxes.end());
    const std::size_t grown = allocation_count();
    turn();
    EXPECT_GT(allocation_count(), grown) << "storage grows with the scene: the counter counts";
}

}  // namespace
}  // namespace gnomon::core
