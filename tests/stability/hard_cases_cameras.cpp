#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/stability/hard_cases.h"

/// Rows about cameras: where they stand, what they see, how they move.
namespace gnomon::hard {
namespace {

constexpr double kTurn_rad = 6.283185307179586;

void field(World& w) {
    w.ground(400.0);
    for (int i = 0; i < 8; ++i) {
        const double x = 4.0 * i - 14.0, z = -6.0 * i;
        w.box({x, 0.0, z}, {x + 1.0, 1.5 + 0.2 * i, z + 1.0});
    }
}

void camera_in_a_caster(World& w) {
    w.ground(6.0);
    w.box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5});
    w.three_lights();
    w.camera({0.0, 0.5, 0.0}, {2.0, 0.0, 1.0});
}
void casters_behind_cameras() {
    // A caster between light and receiver casts, wherever the camera is.
    for (const glm::dvec3& at : {glm::dvec3(0.0, 0.5, 0.0), {1.5, 0.5, 0.1}, {0.6, 0.5, 0.0}}) {
        World w;
        w.ground(6.0);
        const ecs::Entity box = w.box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5});
        w.sun({1.0, -0.5, 0.0});
        w.camera(at, {4.0, 0.0, 0.0});  // the box's shadow falls to +x
        Stages stages(w);
        stages.run();
        EXPECT_GT(expect_sound(w, "a camera in or before a caster"), 100u);
        bool casts = false;
        for (const auto* view : stages.views())
            for (std::uint32_t i = 0; i < view->casters.count; ++i)
                casts |=
                    stages.snapshot().instances[stages.frame().fitted.casters[view->casters.first + i]].entity == box;
        EXPECT_TRUE(casts);
    }
}

void one_distance(World& w) {
    // A wall straight ahead, seen from straight ahead: all receivers lie at one distance along the view.
    w.place(w.mesh(game::make_card(kOrigin, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0})), {.translation_m = {0.0, 0.0, -5.0}},
            false);
    w.box({-0.3, -0.3, -3.0}, {0.3, 0.3, -2.5}, {});
    w.sun({0.3, -0.4, -1.0});
    w.camera(kOrigin, {0.0, 0.0, -1.0}, {.near_m = 4.0});
}

void nothing_at_all(World& w) {
    w.ground(6.0);
    w.three_lights();
    w.camera();
}
void empty_sets() {
    const auto expect_idle = [](World& w, Reason reason) {
        Stages stages(w);
        stages.run();
        EXPECT_EQ(stages.passes(), 0u);
        EXPECT_TRUE(stages.frame().fitted.views.empty());
        for (const LightReport& light : stages.report().lights) {
            EXPECT_EQ(light.state, LightState::skipped);
            EXPECT_EQ(light.reason, reason) << reason_code(light.reason);
            EXPECT_EQ(light.counts.bytes, 0u);
        }
    };
    World without_casters;
    nothing_at_all(without_casters);
    expect_idle(without_casters, Reason::no_caster);
    World looking_away;
    looking_away.ground(6.0);
    looking_away.box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5});
    looking_away.three_lights();
    looking_away.camera({0.0, 2.0, 0.0}, {0.0, 9.0, 0.1});
    expect_idle(looking_away, Reason::no_visible_receiver);
}

void split_from_zero(World& w) {
    field(w);
    w.sun(kSlant);
    w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0}, {.near_m = 1e-12});
}
void splits_grow() {
    for (const double near_m : {1e-300, 1e-30, 1e-12, 1e-3, 1.0}) {
        World w;
        field(w);
        w.sun(kSlant);
        w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0}, {.near_m = near_m});
        Stages stages(w);
        stages.run();
        EXPECT_GT(expect_sound(w, "a split from next to nothing"), 50u) << near_m;
        double last = -1.0;
        for (const auto* view : stages.views()) {
            EXPECT_GT(view->cascade.seen_from_m, last) << near_m;
            last = view->cascade.seen_from_m;
        }
    }
}

void lens_angles() {
    for (const double fov : {1e-4, 1e-2, 3.0, 3.14, 3.1415926}) {
        World w;
        field(w);
        w.three_lights();
        w.camera({0.0, 1.6, 8.0}, {-1.0, 1.0, 0.0}, {.fov_y_rad = fov});
        expect_sound(w, "a lens of an extreme angle");
    }
}
void wide_lens(World& w) {
    field(w);
    w.three_lights();
    w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0}, {.fov_y_rad = 2.6});
}

void flat_camera(World& w) {
    field(w);
    w.three_lights();
    w.camera({10.0, 20.0, 20.0}, kOrigin,
             {.projection = CameraProjection::orthographic, .half_height_m = 8.0, .near_m = 0.1, .far_m = 100.0});
}
void linear_splits() {
    World w;
    w.ground(50.0);
    w.box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5});
    w.sun(kSlant, {.cascades = 4}, {.cascades = {.blend = 0.0f}});  // so that each begins where the one before ends
    w.camera({0.0, 20.0, 20.0}, kOrigin,
             {.projection = CameraProjection::orthographic, .half_height_m = 8.0, .near_m = 0.1, .far_m = 100.0});
    Stages stages(w);
    stages.run();
    const auto views = stages.views();
    ASSERT_GE(views.size(), 3u);
    const double step = views[1]->cascade.seen_from_m - views[0]->cascade.seen_from_m;
    for (std::size_t i = 2; i < views.size(); ++i)
        EXPECT_NEAR(views[i]->cascade.seen_from_m - views[i - 1]->cascade.seen_from_m, step, 0.02 * step)
            << "nearer is not larger here";
}

void letterbox(World& w) {
    field(w);
    w.three_lights();
    w.viewport_px = {4096, 4};
    w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0});
}
void absurd_pictures() {
    for (const glm::uvec2 size : {glm::uvec2(4, 4096), {4096, 4}, {16384, 1}, {1, 16384}, {1, 1}}) {
        World w;
        field(w);
        w.three_lights();
        w.viewport_px = size;
        w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0});
        EXPECT_GT(expect_sound(w, "an absurd picture"), 5u) << size.x << " x " << size.y;
    }
}

/// Makes a field under a sun with stable fits.
void stable_field(World& w) {
    w.settings = {"fit=stable"};
    field(w);
    w.sun(kSlant);
}

std::vector<glm::mat4> matrices(const Stages& stages) {
    std::vector<glm::mat4> all;
    for (const auto* view : stages.views()) all.push_back(view->clip_from_anchor);
    return all;
}

void rolling(World& w) {
    field(w);
    w.sun(kSlant);
    const ecs::Entity camera = w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0});
    w.registry.patch<Transform>(
        camera, [](Transform& t) { t.rotation = t.rotation * glm::angleAxis(0.7, glm::dvec3(0.0, 0.0, 1.0)); });
}
void rolls_once() {
    World w;
    stable_field(w);
    const ecs::Entity camera = w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0});
    const glm::dquat upright = w.registry.get<Transform>(camera)->rotation;
    Stages stages(w);
    std::vector<glm::mat4> first;
    for (int i = 0; i <= 60; ++i) {
        const double angle = kTurn_rad * i / 60.0;
        w.registry.patch<Transform>(
            camera, [&](Transform& t) { t.rotation = upright * glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0)); });
        stages.run();
        if (i == 0) first = matrices(stages);
        EXPECT_EQ(matrices(stages), first) << "rolled by " << angle;
    }
    EXPECT_FALSE(first.empty());
}

/// Computes where the map's corner lies on the grid of its own texels: whole numbers, if it is snapped.
glm::dvec2 corner_texels(const shadow::ShadowView& view) {
    const glm::dvec3 anchor = view.pose.anchor_ws_m;
    const glm::dvec2 at(glm::dot(anchor, view.pose.axis_u), glm::dot(anchor, view.pose.axis_v));
    return (at + view.plane.centre_ls_m - view.plane.half_extent_m) /
           glm::dvec2(view.plane.texel_u, view.plane.texel_v);
}
void expect_snapped(World& w, ecs::Entity camera, const Transform& start, bool turning, double step) {
    Stages stages(w);
    glm::dvec2 first(0.0);
    double texel = 0.0;
    for (int i = 0; i < 40; ++i) {
        w.registry.patch<Transform>(camera, [&](Transform& t) {
            t = start;
            if (turning)
                t.rotation = glm::angleAxis(step * i, glm::dvec3(0.0, 1.0, 0.0)) * t.rotation;
            else
                t.translation_m += glm::dvec3(1.0, 0.1, 0.7) * (step * i);
        });
        stages.run();
        for (const auto* view : stages.views()) {
            if (view->layer != 0) continue;
            if (i == 0) first = corner_texels(*view), texel = view->plane.texel_u;
            EXPECT_EQ(view->plane.texel_u, texel) << "the extent changes with the camera's place";
            const glm::dvec2 moved = corner_texels(*view) - first;
            EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6) << "frame " << i;
            EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6) << "frame " << i;
        }
    }
    EXPECT_GT(texel, 0.0);
}
void snaps_when_moved() {
    World w;
    stable_field(w);
    const ecs::Entity camera = w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0}, {.far_m = 100.0});
    expect_snapped(w, camera, *w.registry.get<Transform>(camera), false, 0.0037);
}
void snaps_when_turned() {
    World w;
    stable_field(w);
    const ecs::Entity camera = w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0}, {.far_m = 1000.0});
    expect_snapped(w, camera, *w.registry.get<Transform>(camera), true, 0.013);
}

void across_cascades(World& w) {
    field(w);
    for (int i = 0; i < 40; ++i) w.box({-3.0, 0.0, 4.0 - 1.5 * i}, {-2.8, 1.0, 4.2 - 1.5 * i});
    w.sun({1.0, -0.6, -0.2});
    w.camera({0.0, 1.6, 8.0}, {0.0, 1.0, 0.0});
}

constexpr std::array kCases{
    HardCase{"camera_in_a_caster", "the camera's near plane cuts casters", camera_in_a_caster, casters_behind_cameras,
             OnGpu::right},
    HardCase{"empty_sets", "boxes turned inside out", nothing_at_all, empty_sets},
    HardCase{"cascade_without_depth", "near equals far", one_distance, nullptr, OnGpu::right},
    HardCase{"split_from_near_0", "the logarithm of 0", split_from_zero, splits_grow, OnGpu::right},
    HardCase{"lens_toward_0_and_180_degrees", "corners at infinity", wide_lens, lens_angles, OnGpu::right},
    HardCase{"orthographic_camera", "splits and unprojection for perspective", flat_camera, linear_splits,
             OnGpu::right},
    HardCase{"absurd_aspect", "slices without width", letterbox, absurd_pictures},
    HardCase{"camera_roll", "a fit in view axes pulses", rolling, rolls_once, OnGpu::right},
    HardCase{"snap_translation", "texels crawl", split_from_zero, snaps_when_moved},
    HardCase{"snap_rotation_and_far_1000", "float snapping fails", split_from_zero, snaps_when_turned},
    HardCase{"cascade_borders", "the kernel reads past the border", across_cascades, nullptr, OnGpu::right},
};

}  // namespace

std::span<const HardCase> camera_cases() { return kCases; }

}  // namespace gnomon::hard
