#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/stability/hard_cases.h"
#include "tests/stability/hard_cases_pancakes.h"

/// Rows about casters and receivers: their shapes, their places, their numbers, their lives.
namespace gnomon::hard {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

void yard(World& w) {
    w.ground(6.0);
    w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    w.box({1.4, 0.8, -1.6}, {2.0, 1.1, 1.2});
    w.three_lights();
    w.camera();
}

/// Everything that decides the views of a frame.
struct Fitted {
    std::vector<glm::mat4> matrices;
    std::vector<glm::dvec3> anchors_m;
    std::vector<double> texels;
    std::vector<std::size_t> casters;
};
template <class Build>
Fitted fitted(Build build) {
    World w;
    build(w);
    Stages stages(w);
    stages.run();
    Fitted f;
    for (const shadow::ShadowView& view : stages.frame().fitted.views) {
        f.matrices.push_back(view.clip_from_anchor);
        f.anchors_m.push_back(view.pose.anchor_ws_m);
        f.texels.push_back(view.plane.texel_u);
        f.casters.push_back(view.casters.count);
    }
    EXPECT_FALSE(f.matrices.empty());
    return f;
}

/// Expects the fits of the yard with one entity more to be those of the yard without it.
template <class Add>
void expect_no_trace_of(Add add) {
    const Fitted with = fitted([&](World& w) {
        yard(w);
        add(w);
    });
    const Fitted without = fitted(yard);
    EXPECT_EQ(with.matrices, without.matrices);
    EXPECT_EQ(with.casters, without.casters);
}

void flat_scene(World& w) {
    w.ground(6.0);
    w.place(w.mesh(game::make_card({0.0, 1.0, 0.0}, {0.0, 0.0, 1.5}, {2.0, 0.0, 0.0})));
    w.three_lights();
    w.camera();
}
void flat_seen_along_the_light() {
    for (const glm::dvec3& along : {kDown, glm::dvec3(1.0, 0.0, 0.0), {1.0, -1e-9, 0.0}}) {
        World w;
        w.ground(6.0);
        w.place(w.mesh(game::make_card({0.0, 1.0, 0.0}, {0.0, 0.0, 1.5}, {2.0, 0.0, 0.0})));
        w.sun(along);
        w.camera();
        EXPECT_GT(expect_sound(w, "a plane along or across the light"), 100u);
    }
}

void one_triangle(World& w) {
    w.place(w.triangles({{-3.0f, 0.0f, 2.5f}, {3.5f, 0.2f, 2.0f}, {0.0f, 0.1f, -3.0f}}), {}, false);
    w.place(w.triangles({{-0.5f, 1.0f, 0.4f}, {0.6f, 1.1f, 0.5f}, {0.1f, 1.3f, -0.7f}}));
    w.three_lights();
    w.camera();
}

std::uint32_t box_with_slivers(World& w) {
    game::Shape shape = game::make_box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& p : {a, b, c}) {
            shape.indices.push_back(static_cast<std::uint32_t>(shape.positions.size()));
            shape.positions.push_back(p);
            shape.normals.emplace_back(0.0f);
            shape.uvs.emplace_back(0.0f);
        }
    };
    add({-0.5f, 0.1f, 0.0f}, {0.0f, 0.1f, 0.0f}, {0.4f, 0.1f, 0.0f});  // in a row
    add({0.1f, 0.5f, 0.1f}, {0.1f, 0.5f, 0.1f}, {0.1f, 0.5f, 0.1f});   // a point
    return w.mesh(shape);
}
void slivers(World& w) {
    w.ground(6.0);
    w.place(box_with_slivers(w));
    w.three_lights();
    w.camera();
}
void slivers_leave_no_trace() {
    const Fitted with = fitted(slivers);
    const Fitted without = fitted([](World& w) {
        w.ground(6.0);
        w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
        w.three_lights();
        w.camera();
    });
    EXPECT_EQ(with.matrices, without.matrices);
}

void far_away(World& w) {
    w.offset_m = {0x1p26, 0.0, -0x1p26};  // 6.7e7 m
    yard(w);
}
void far_is_like_near() {
    const Fitted near = fitted(yard);
    for (const double distance_m : {1e6, 1e7, 1e8}) {
        World w;
        w.offset_m = {distance_m, -0.25 * distance_m, distance_m};
        yard(w);
        EXPECT_GT(expect_sound(w, "a scene far away"), 100u) << distance_m;
        const Fitted far = fitted([distance_m](World& v) {
            v.offset_m = {distance_m, -0.25 * distance_m, distance_m};
            yard(v);
        });
        ASSERT_EQ(far.texels.size(), near.texels.size());
        // A place is known to 2^-53 of its distance: 1.5e-8 m at 1e8 m, of extents of a metre and more.
        for (std::size_t i = 0; i < near.texels.size(); ++i)
            EXPECT_NEAR(far.texels[i] / near.texels[i], 1.0, 1e-7 + 1e-15 * distance_m) << distance_m;
        EXPECT_EQ(far.casters, near.casters);
    }
}

void tiny(World& w) {
    w.scale = 0x1p-13;  // boxes of a tenth of a millimetre
    yard(w);
}
void scale_is_free() {
    const Fitted unit = fitted(yard);
    for (const int power : {-13, -7, 10, 26}) {
        const double scale = std::exp2(power);
        const Fitted scaled = fitted([scale](World& w) {
            w.scale = scale;
            yard(w);
        });
        ASSERT_EQ(scaled.matrices.size(), unit.matrices.size()) << "power " << power;
        EXPECT_EQ(scaled.casters, unit.casters);
        for (std::size_t i = 0; i < unit.matrices.size(); ++i) {
            SCOPED_TRACE("power " + std::to_string(power) + ", view " + std::to_string(i));
            EXPECT_EQ(scaled.anchors_m[i], unit.anchors_m[i] * scale);
            // The same map from coordinates that are 2^k larger. An orthographic w is 1; a perspective one is metres,
            // which scales the whole row, and with it depth's constant.
            const bool perspective = unit.matrices[i][3][3] == 0.0f;
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 4; ++r)
                    EXPECT_EQ(scaled.matrices[i][c][r] * (perspective ? 1.0f : static_cast<float>(scale)),
                              unit.matrices[i][c][r]);
            for (int r = 0; r < 4; ++r)
                EXPECT_EQ(scaled.matrices[i][3][r] / (perspective ? static_cast<float>(scale) : 1.0f),
                          unit.matrices[i][3][r]);
        }
    }
}

void stretched(World& w) {
    w.ground(6.0);
    w.box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5},
          {.translation_m = {0.0, 1.0, 0.0},
           .rotation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(0.3, 1.0, 0.2))),
           .scale = {3.0, 0.2, 0.9}});
    w.three_lights();
    w.camera();
}
void mirrored(World& w) {
    w.ground(6.0);
    w.place(w.triangles({{0.0f, 0.0f, 0.0f},
                         {1.0f, 0.0f, 0.0f},
                         {0.0f, 1.0f, 0.3f},
                         {0.0f, 0.0f, 0.0f},
                         {0.0f, 1.0f, 0.3f},
                         {1.0f, 0.0f, 0.0f}}),
            {.translation_m = {0.5, 0.4, 0.0}, .scale = {-1.5, 1.5, 1.5}});
    w.box({-1.5, 0.1, -1.0}, {-0.7, 0.9, -0.2}, {.scale = {1.0, 1.0, -1.0}});
    w.three_lights();
    w.camera();
}

void zero_scale_leaves_no_trace() {
    for (const glm::dvec3& scale : {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}) {
        expect_no_trace_of([&](World& w) { w.box({0.0, 0.0, 0.0}, {9.0, 9.0, 9.0}, {.scale = scale}); });
        World w;
        yard(w);
        const ecs::Entity none = w.box({0.0, 0.0, 0.0}, {9.0, 9.0, 9.0}, {.scale = scale});
        Stages stages(w);
        stages.run();
        ASSERT_EQ(stages.snapshot().dropped.size(), 1u);
        EXPECT_EQ(stages.snapshot().dropped.front().entity, none);
        EXPECT_EQ(stages.snapshot().dropped.front().reason, DropReason::zero_scale);
    }
}
void broken_numbers_leave_no_trace() {
    for (const double bad : {kNaN, kInfinity, -kInfinity, 1e308}) {
        expect_no_trace_of([&](World& w) {
            w.box({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, {.translation_m = {0.0, bad, 0.0}});
        });
        expect_no_trace_of([&](World& w) { w.box({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, {.scale = {1.0, bad, bad}}); });
    }
    expect_no_trace_of([](World& w) { w.box({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, {.rotation = {kNaN, 0.0, 0.0, 0.0}}); });
}
void denormals(World& w) {
    yard(w);
    w.box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {.translation_m = {5e-324, 1e-310, 0.0}, .scale = glm::dvec3(1e-310)});
}
void denormals_are_zero() {
    for (const double size : {5e-324, 1e-310, 1e-40}) {
        World w;
        yard(w);
        w.box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {.translation_m = {0.2, 0.0, size}, .scale = glm::dvec3(size)});
        EXPECT_GT(expect_sound(w, "an object of denormal size"), 100u) << size;
    }
    // A place that differs from the origin by a denormal is the origin.
    const Fitted moved = fitted([](World& w) {
        yard(w);
        w.offset_m = glm::dvec3(5e-324);
        w.box({-2.0, 0.0, -2.0}, {-1.0, 1.0, -1.0});
    });
    const Fitted still = fitted([](World& w) {
        yard(w);
        w.box({-2.0, 0.0, -2.0}, {-1.0, 1.0, -1.0});
    });
    EXPECT_EQ(moved.matrices, still.matrices);
}

/// Makes a card with a texture that is cut out in squares of an eighth of its side.
void cut_out(World& w) {
    assets::Texture texture{.name = "squares", .width = 64, .height = 64, .rgba = {}};
    for (std::uint32_t y = 0; y < texture.height; ++y)
        for (std::uint32_t x = 0; x < texture.width; ++x)
            for (const int channel : {200, 200, 200, (x / 8 + y / 8) % 2 == 0 ? 255 : 0})
                texture.rgba.push_back(static_cast<std::uint8_t>(channel));
    w.library.textures.push_back(texture);
    w.library.materials.push_back({.name = "cut out", .metallic = 0.0f});
    w.library.materials.back().alpha_mode = assets::AlphaMode::mask;
    w.library.materials.back().base_colour_texture = 0;
    w.ground(6.0);
    w.place(w.mesh(game::make_card({0.0, 1.5, 0.0}, {0.0, 0.0, 3.0}, {3.0, 0.0, 0.0}), 1));
    w.three_lights();
    w.camera();
}

void wires(World& w) {
    w.ground(6.0);
    w.box({-3.0, 0.8, 0.0}, {3.0, 0.802, 0.002});  // 2 mm thin, under texels of centimetres
    w.sun(kSlant);
    w.camera();
}

void open_sheet(World& w) {
    w.ground(6.0);
    w.place(w.mesh(game::make_cloth(2.0, 1.4, 0.2, 2.0, 24, 4)), {.translation_m = {0.0, 1.6, 0.0}});
    w.place(w.mesh(game::make_card({-1.5, 0.8, 0.5}, {1.0, 0.3, 0.0}, {0.0, 0.5, -0.8})));
    w.three_lights();
    w.camera();
}

void stuck_together(World& w) {
    w.ground(6.0);
    w.box({-0.6, -0.5, -0.5}, {0.5, 1.2, 0.6});  // half a metre into the ground
    w.box({-0.2, 0.3, -0.9}, {1.2, 0.8, 0.2}, {.rotation = glm::angleAxis(0.4, glm::dvec3(0.0, 1.0, 0.0))});
    w.three_lights();
    w.camera();
}

void creases(World& w) {
    w.ground(6.0);
    for (int i = 0; i < 6; ++i) {
        const double y = 0.25 * i;
        w.box({-1.5 + 0.3 * i, y, -1.0}, {1.5, y + 0.25, 1.0});
    }
    w.box({-2.0, 0.0, -1.4}, {2.0, 2.0, -1.0});
    w.sun({0.7, -1.0, -0.4});
    w.lamp({-1.0, 3.0, 1.5});
    w.camera({-5.0, 4.0, 6.0}, {0.0, 0.5, 0.0});
}

void twins(World& w) {
    w.ground(6.0);
    for (int i = 0; i < 2; ++i) w.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    w.place(w.mesh(game::make_card({0.0, 1.2, 0.05}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0})));  // on the boxes' tops
    w.three_lights();
    w.camera();
}

void foil(World& w) {
    w.ground(6.0);
    w.box({-1.0, 0.5, -1.0}, {1.0, 0.5001, 1.0});
    LightShadow coarse;
    coarse.resolution_px = 64;
    w.sun(kSlant, coarse);
    w.camera();
}

void after_deletion() {
    // What is left after a life is what a new world would hold.
    World w;
    yard(w);
    const ecs::Entity passing = w.box({-2.5, 0.0, 1.0}, {-1.5, 2.0, 2.0});
    const ecs::Entity second_sun = w.sun({-0.4, -1.0, 0.2});
    Stages stages(w);
    stages.run();
    w.registry.destroy(passing);
    w.registry.destroy(second_sun);
    stages.run();
    World fresh_world;
    yard(fresh_world);
    (void)fresh_world.mesh(game::make_box({-2.5, 0.0, 1.0}, {-1.5, 2.0, 2.0}));
    Stages fresh(fresh_world);
    fresh.run();
    ASSERT_EQ(stages.frame().fitted.views.size(), fresh.frame().fitted.views.size());
    for (std::size_t v = 0; v < fresh.frame().fitted.views.size(); ++v) {
        EXPECT_EQ(stages.frame().fitted.views[v].casters.count, fresh.frame().fitted.views[v].casters.count);
        EXPECT_FALSE(stages.frame().updates[v].reuse && stages.frame().fitted.views[v].casters.count > 2) << "a stale map";
    }
    stages.run();
    EXPECT_EQ(stages.passes(), 0u) << "a still scene redraws nothing";
}

constexpr std::array kCases{
    HardCase{"zero_extent_bounds", "division by an extent of 0", flat_scene, flat_seen_along_the_light, OnGpu::right},
    HardCase{"one_triangle", "the thinnest depth range", one_triangle, nullptr, OnGpu::right},
    HardCase{"degenerate_triangles", "normals are NaN", slivers, slivers_leave_no_trace, OnGpu::right},
    HardCase{"far_from_the_origin", "floats are metres apart", far_away, far_is_like_near, OnGpu::right},
    HardCase{"objects_of_a_tenth_millimetre", "absolute epsilons dominate", tiny, scale_is_free, OnGpu::right},
    HardCase{"nonuniform_scale", "normals are skewed", stretched, nullptr, OnGpu::right},
    HardCase{"negative_scale", "the winding flips", mirrored, nullptr, OnGpu::right},
    HardCase{"zero_scale", "a singular inverse", yard, zero_scale_leaves_no_trace},
    HardCase{"nan_and_infinity", "bounds are poisoned", yard, broken_numbers_leave_no_trace},
    HardCase{"denormals", "flushed here and not there", denormals, denormals_are_zero, OnGpu::right},
    HardCase{"pancaking", "clamping vertices bends long triangles", pancakes,
             pancakes_are_made_where_depths_are_compared_alone, OnGpu::right},
    HardCase{"alpha_mask", "shadows of what is cut away", cut_out, nullptr, OnGpu::right},
    HardCase{"thinner_than_a_texel", "the caster vanishes", wires, nullptr, OnGpu::too_thin},
    HardCase{"two_sided_and_open", "culling leaks", open_sheet, nullptr, OnGpu::right},
    HardCase{"interpenetration", "light leaks along the crease", stuck_together, nullptr, OnGpu::right},
    HardCase{"concave_creases", "a plane's bias shadows its neighbour", creases, nullptr, OnGpu::right},
    HardCase{"coincident_casters", "the order decides", twins, nullptr, OnGpu::right},
    HardCase{"bias_above_thickness", "a leak at the contact", foil, nullptr, OnGpu::right},
    HardCase{"deleted_entity", "a stale map", yard, after_deletion},
};

}  // namespace

std::span<const HardCase> mesh_cases() { return kCases; }

}  // namespace gnomon::hard
