#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/stability/hard_cases.h"

/// Rows about lights: where they shine, where they stand, how far and how wide.
namespace gnomon::hard {
namespace {

constexpr double kFlat_rad = 1.5707963267948966;

void yard(World& w) {
    w.ground(6.0);
    w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    w.box({1.4, 0.8, -1.6}, {2.0, 1.1, 1.2});
    w.camera();
}

void sun_overhead(World& w) {
    yard(w);
    w.sun(kDown);
}
void sun_overhead_checks() {
    // A basis that flips near a pole would show as another fit on the two sides of it.
    for (const double sign : {-1.0, 1.0}) {
        double first_texel = 0.0;
        for (const glm::dvec2 tilt : {glm::dvec2(0.0), {1e-7, 0.0}, {-1e-7, 0.0}, {0.0, 1e-7}, {0.0, -1e-7}}) {
            World w;
            yard(w);
            w.sun({tilt.x, sign, tilt.y});
            Stages stages(w);
            stages.run();
            EXPECT_GT(expect_sound(w, "a sun along the vertical"), 100u);
            const auto views = stages.views();
            if (sign > 0.0 && views.empty()) continue;  // it shines from below: no caster is between it and the ground
            ASSERT_FALSE(views.empty());
            const double texel_m2 = views.front()->plane.texel_u * views.front()->plane.texel_v;
            if (first_texel == 0.0) first_texel = texel_m2;
            EXPECT_NEAR(texel_m2 / first_texel, 1.0, 1e-4);
        }
    }
}

void sun_in_the_view(World& w) {
    yard(w);
    w.sun(kOrigin - glm::dvec3(5.0, 6.0, 8.0));
}
void duelling_checks() {
    for (const double sign : {1.0, -1.0}) {
        World w;
        yard(w);
        w.box({-40.0, 0.0, -60.0}, {-39.0, 3.0, -50.0});
        w.ground(100.0, {0.0, -0.01, 0.0});
        w.sun(sign * (kOrigin - glm::dvec3(5.0, 6.0, 8.0)), {.resolution_px = 512});
        Stages stages(w);
        stages.run();
        EXPECT_GT(expect_sound(w, "a sun along the view"), 100u);
        // Lloyd's m, bounded: orthographic cascades cannot be worse than their slice is deep.
        for (const auto* view : stages.views()) EXPECT_LT(view->error.texel_edge_px, 10.0);
    }
}

void lights_in_a_box(World& w) {
    w.ground(5.0);
    w.box({-1.0, 1.0, -1.0}, {1.0, 2.0, 1.0});
    w.lamp({0.1, 1.5, 0.0});
    w.spot({-0.1, 1.5, 0.1}, kDown, 0.8);
    w.camera();
}

void spot_over_two_halves(World& w) {
    w.ground(6.0);
    w.box({-0.5, 0.3, 1.0}, {0.5, 0.8, 1.6});
    w.box({-0.5, 0.3, -2.6}, {0.5, 0.8, -2.0});  // behind the light: casts nothing, and is not mirrored
    w.spot({0.0, 2.0, 0.0}, {0.0, -0.7, 1.0}, 0.7);
    w.camera({0.0, 9.0, 0.1}, kOrigin);
}

void beyond_everything(World& w) {
    w.ground(3000.0);
    w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    w.sun(kSlant);
    w.lamp({1.0, 3.0, 0.5}, 4.0);
    w.camera({0.0, 2.0, 8.0}, {0.0, 1.0, 0.0}, {.far_m = 60.0});
}

void near_and_far_apart(World& w) {
    w.ground(8000.0);
    w.box({-0.003, 1.995, -0.003}, {0.003, 1.997, 0.003});  // 3 mm under the lamps, which shine for kilometres
    w.box({50.0, 0.0, -5.0}, {60.0, 20.0, 5.0});
    w.lamp({0.0, 2.0, 0.0});
    w.spot({0.0, 2.0, 0.0}, {1.0, -0.2, 0.0}, 1.2);
    w.camera({-3.0, 2.5, 6.0}, {20.0, 0.0, 0.0}, {.near_m = 1e-3, .far_m = 1e4});
}
void near_and_far_checks() {
    constexpr double kUnitRoundoff = 0x1p-24;
    World w;
    near_and_far_apart(w);
    Stages stages(w);
    stages.run();
    for (std::uint32_t light = 0; light < 2; ++light)
        for (const auto* view : stages.views(light))
            for (double z = view->depth.near_m * 1.01; z < view->depth.far_m; z *= 1.7) {
                // One step of a reversed D32F, as distance: its ulp over the slope beta / z^2 of depth.
                const auto depth = static_cast<float>(view->depth.alpha + view->depth.beta / z);
                const auto ulp = static_cast<double>(std::nextafter(depth, 2.0f) - depth);
                EXPECT_LE(ulp * z * z / view->depth.beta, 2.0 * kUnitRoundoff * z * 1.001) << "at " << z << " m";
            }
}

void widest_cone(World& w) {
    yard(w);
    w.spot({0.0, 3.0, 0.0}, kDown, kFlat_rad);
}
void widening_cones() {
    for (const double outer : {0.9, 1.0, 1.04, 1.05, 1.1, 1.3, 1.39, 1.4, 1.5, 1.57, kFlat_rad}) {
        World w;
        yard(w);
        w.spot({0.0, 3.0, 0.0}, {0.2, -1.0, 0.1}, outer);
        EXPECT_GT(expect_sound(w, "a wide cone"), 20u) << outer;
    }
}

void narrow_cone(World& w) {
    yard(w);
    w.spot({0.0, 3.0, 0.0}, kDown, 0.1);
}
void narrowing_cones() {
    for (const double outer : {1e-2, 1e-3, 1e-4, 1e-6}) {
        World w;
        w.ground(6.0);
        w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
        w.spot({0.0, 3.0, 0.0}, kDown, outer);
        w.camera({0.5, 3.0, 0.0}, kOrigin);
        expect_sound(w, "a narrow cone");
    }
}

void lamp_on_the_ground(World& w) {
    yard(w);
    w.lamp({3.0, 0.0, 0.0});
    w.lamp({0.5, 1.2, 0.6});  // in a corner of the box
    w.spot({-3.0, 0.0, 0.5}, {1.0, 0.2, 0.0}, 0.6);
}

void cube_corner(World& w) {
    w.ground(6.0);
    // Bars from the lamp's point of view across edges and corners of its cube.
    w.box({0.9, 0.9, -2.5}, {1.1, 1.1, 2.5});
    w.box({-1.6, 0.2, -1.6}, {-1.3, 0.5, 1.6});
    w.box({-1.0, 0.9, 0.9}, {1.0, 1.1, 1.1});
    w.lamp({0.0, 2.0, 0.0});
    w.camera();
}
void turned_lamps() {
    // A lamp's own rotation means nothing: the maps stay bit for bit.
    const auto fitted = [](double turn_rad) {
        World w;
        cube_corner(w);
        for (const ecs::Entity e : w.registry.entities_with<Light>())
            w.registry.patch<Transform>(e, [&](Transform& t) {
                t.rotation = glm::angleAxis(turn_rad, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
            });
        Stages stages(w);
        stages.run();
        std::vector<glm::mat4> matrices;
        for (const auto* view : stages.views()) matrices.push_back(view->clip_from_anchor);
        return matrices;
    };
    const auto still = fitted(0.0);
    EXPECT_FALSE(still.empty());
    EXPECT_EQ(still, fitted(0.7853981633974483));
}

/// Makes lights under a parent that is stretched and turned: their axes are not at right angles.
void skewed_light(World& w) {
    yard(w);
    const ecs::Entity sun = w.sun(kSlant), spot = w.spot({0.5, 4.0, 0.5}, {0.3, -1.0, 0.2}, 0.8);
    const ecs::Entity parent = w.registry.create();
    w.registry.emplace<Transform>(
        parent, {.rotation = glm::angleAxis(0.6, glm::normalize(glm::dvec3(1.0, 1.0, 0.2))), .scale = {1.0, 3.0, 0.5}});
    for (const ecs::Entity e : {sun, spot}) w.registry.patch<Transform>(e, [&](Transform& t) { t.parent = parent; });
}
void skewed_checks() {
    World w;
    skewed_light(w);
    Stages stages(w);
    stages.run();
    for (const LightItem& light : stages.snapshot().lights) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                EXPECT_NEAR(glm::dot(light.rotation_ws[i], light.rotation_ws[j]), i == j ? 1.0 : 0.0, 1e-12);
        // Only the direction counts: that of the skewed -Z.
        const auto& world = *w.registry.get<WorldTransform>(light.entity);
        EXPECT_GT(glm::dot(light.rotation_ws[2], glm::normalize(world.basis[2])), 1.0 - 1e-12);
    }
}

void low_sun(World& w) {
    yard(w);
    w.sun({1.0, -0.1, 0.3});
}
void slow_sun() {
    World w;
    yard(w);
    const ecs::Entity sun = w.sun(kSlant);
    Stages stages(w);
    for (int step = 0; step < 20; ++step) {
        const double angle = 1e-5 * step;
        w.registry.patch<Transform>(sun, [&](Transform& t) {
            t.rotation = looking_along({0.4 + angle, -1.0, 0.3 - angle});
        });
        stages.run();
        ASSERT_FALSE(stages.views().empty());
        // What was drawn is the sun of this frame, not of an earlier one.
        EXPECT_GT(glm::dot(stages.views().front()->pose.axis_back, stages.snapshot().lights.front().rotation_ws[2]),
                  1.0 - 1e-15);
    }
}

void grazing_sun(World& w) {
    w.ground(6.0);
    w.box({-0.6, 0.0, -0.5}, {0.5, 0.4, 0.6});
    w.sun({1.0, -1.75e-4, 0.2});  // 0.01 degrees above the ground
    w.camera();
}

void smallest_map(World& w) {
    yard(w);
    w.sun(kSlant, {.resolution_px = 65536});
    w.lamp({1.5, 4.0, -1.0}, 0.0, {.resolution_px = 65536});
}
void clamped_maps() {
    World w;
    smallest_map(w);
    Stages stages(w);
    stages.run();
    for (std::uint32_t light = 0; light < 2; ++light) {
        EXPECT_EQ(stages.report().lights[light].reason, Reason::resolution_clamped);
        EXPECT_LE(stages.frame().fitted.lights[light].request.map.resolution_px, stages.device().info().max_texture_px);
        EXPECT_FALSE(stages.views(light).empty());
    }
}

constexpr std::array kCases{
    HardCase{"light_along_up", "a basis from an up vector is NaN at its poles", sun_overhead, sun_overhead_checks,
             OnGpu::right},
    HardCase{"light_along_the_view", "cascades coincide, a warp degenerates", sun_in_the_view, duelling_checks,
             OnGpu::right},
    HardCase{"light_inside_a_caster", "near cuts the caster away", lights_in_a_box, nullptr, OnGpu::right},
    HardCase{"receiver_behind_a_spot", "w below 0 mirrors the shadow", spot_over_two_halves, nullptr, OnGpu::right},
    HardCase{"beyond_map_and_far_plane", "the border is dark", beyond_everything, nullptr, OnGpu::right},
    HardCase{"near_to_far_1e7", "depth has no steps left", near_and_far_apart, near_and_far_checks, OnGpu::right},
    HardCase{"spot_toward_180_degrees", "the tangent is infinite", widest_cone, widening_cones},
    HardCase{"spot_toward_0_degrees", "the map has no extent", narrow_cone, narrowing_cones},
    HardCase{"light_touching_geometry", "the plane's distance is 0, the bias infinite", lamp_on_the_ground},
    HardCase{"cube_seams_and_corners", "lines where faces meet", cube_corner, turned_lamps, OnGpu::right},
    HardCase{"skewed_light_matrix", "depth is skewed", skewed_light, skewed_checks, OnGpu::right},
    HardCase{"slow_sun", "a map kept for a sun that has moved", low_sun, slow_sun, OnGpu::right},
    HardCase{"grazing_at_89_99_degrees", "the tangent of the slope is 5.7e3", grazing_sun, nullptr, OnGpu::right},
    HardCase{"map_larger_than_the_limit", "the allocation fails", smallest_map, clamped_maps},
};

}  // namespace

std::span<const HardCase> light_cases() { return kCases; }

}  // namespace gnomon::hard
