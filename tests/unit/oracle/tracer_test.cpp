#include "tests/oracle/reference_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kSize = 64;
constexpr double kWidth = 8.0;  // width of the view from above: 8 px per metre
constexpr double kQuarterTurn = 0.5 * glm::pi<double>();

/// Returns the centre of pixel (x, y) of view_from_above() on the floor.
glm::dvec2 floor_point(std::uint32_t x, std::uint32_t y) {
    return {((x + 0.5) / kSize - 0.5) * kWidth, -((y + 0.5) / kSize - 0.5) * kWidth};
}

template <class Expected>
int mismatches(const std::vector<float>& visibility, const Expected& expected) {
    int wrong = 0;
    for (std::uint32_t y = 0; y < kSize; ++y)
        for (std::uint32_t x = 0; x < kSize; ++x)
            wrong += visibility[y * kSize + x] == expected(floor_point(x, y)) ? 0 : 1;
    return wrong;
}

/// Makes a floor and a 1 m cube that floats, its centre about 2.3 m above the floor's.
AnalyticScene floor_and_cube(const glm::dvec3& offset_m = glm::dvec3(0.0)) {
    AnalyticScene scene;
    scene.offset_m = offset_m;
    scene.place_floor(20.0);
    scene.place(scene.add_cube(), {0.1, 2.3, -0.2}).visible = false;
    return scene;
}

/// Computes the shadow of that cube under the sun (0.5, 1, 0.25): a slab swept from y 1.8 to 2.8.
float cube_shadow(const glm::dvec2& p) {
    // The point p + s*(0.5, 1, 0.25) is inside for some s in [1.8, 2.8].
    double from = 1.8, to = 2.8;
    const auto limit = [&](double start, double slope, double low, double high) {
        from = std::max(from, (low - start) / slope);
        to = std::min(to, (high - start) / slope);
    };
    limit(p.x, 0.5, -0.4, 0.6);
    limit(p.y, 0.25, -0.7, 0.3);
    return from < to ? 0.0f : 1.0f;
}

TEST(ReferenceTracer, ABoxUnderTheSunCastsTheShadowOfASweptSlab) {
    const AnalyticScene scene = floor_and_cube();
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const LightTruth truth = tracer.trace_light(hits, scene.sun({0.5, 1.0, 0.25}), true);
    EXPECT_EQ(mismatches(truth.visibility, cube_shadow), 0);
    EXPECT_GT(std::count(truth.visibility.begin(), truth.visibility.end(), 0.0f), 50);
    EXPECT_EQ(std::count(truth.scored.begin(), truth.scored.end(), 1), kSize * kSize);
    EXPECT_EQ(std::count(truth.ambiguous.begin(), truth.ambiguous.end(), 1), 0);
}

TEST(ReferenceTracer, TakingTheCasterAwayLightsEverything) {
    AnalyticScene scene = floor_and_cube();
    const auto dark = [&] {
        const ReferenceTracer tracer = scene.tracer();
        const auto v =
            tracer.visibility(tracer.trace_primary(scene.view_from_above(kSize, kWidth)), scene.sun({0.5, 1.0, 0.25}));
        return std::count(v.begin(), v.end(), 0.0f);
    };
    EXPECT_GT(dark(), 50);
    scene.snapshot.instances[1].casts = false;
    EXPECT_EQ(dark(), 0);
    scene.snapshot.instances.pop_back();
    EXPECT_EQ(dark(), 0);
}

TEST(ReferenceTracer, AMillionMetresAwayTheAnswerIsTheSame) {
    const glm::dvec3 offset(1.0e6, -2.0e6,
                            3.0e6);  // exact in double with the scene's numbers, except for the last bits
    const AnalyticScene near = floor_and_cube(), far = floor_and_cube(offset);
    std::vector<float> visibility[2];
    const AnalyticScene* scenes[] = {&near, &far};
    for (int i = 0; i < 2; ++i) {
        const ReferenceTracer tracer = scenes[i]->tracer();
        const PrimaryHits hits = tracer.trace_primary(scenes[i]->view_from_above(kSize, kWidth));
        visibility[i] = tracer.visibility(hits, scenes[i]->sun({0.5, 1.0, 0.25}));
    }
    EXPECT_EQ(visibility[0], visibility[1]);
    EXPECT_EQ(mismatches(visibility[1], cube_shadow), 0);
}

TEST(ReferenceTracer, ASpotLightsADiskAndNothingElse) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const double half_angle = 0.5;
    const double radius = 4.0 * std::tan(half_angle);
    LightItem light = scene.spot({0.0, 4.0, 0.0}, {0.0, 1.0, 0.0}, half_angle);
    EXPECT_EQ(mismatches(tracer.visibility(hits, light),
                         [&](const glm::dvec2& p) { return glm::length(p) < radius ? 1.0f : 0.0f; }),
              0);
    light.range_m = 4.2;
    const double reach = std::sqrt(4.2 * 4.2 - 16.0);
    EXPECT_LT(reach, radius);
    const LightTruth truth = tracer.trace_light(hits, light, false);
    EXPECT_EQ(mismatches(truth.visibility, [&](const glm::dvec2& p) { return glm::length(p) < reach ? 1.0f : 0.0f; }),
              0);
    EXPECT_EQ(std::count(truth.scored.begin(), truth.scored.end(), 1),
              std::count(truth.visibility.begin(), truth.visibility.end(), 1.0f))
        << "out of reach is not scored";
    light.rotation_ws = math::basis_from_back({0.0, -1.0, 0.0});
    const auto away = tracer.visibility(hits, light);
    EXPECT_EQ(std::count(away.begin(), away.end(), 0.0f), kSize * kSize);
}

TEST(ReferenceTracer, ALampInABoxShinesThroughItsHole) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    // A plate 2 m above the floor has a square hole of 0.5 m; the lamp is 1 m above the hole. Below, the hole is three
    // times as large.
    const std::uint32_t square = scene.add_square();
    const glm::dmat3 flat({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    const auto slab = [&](double x0, double x1, double z0, double z1) {
        scene
            .place(square, {0.5 * (x0 + x1), 2.0, 0.5 * (z0 + z1)},
                   flat * glm::dmat3({x1 - x0, 0, 0}, {0, z1 - z0, 0}, {0, 0, 1}))
            .visible = false;
    };
    slab(-9.0, -0.25, -9.0, 9.0);
    slab(0.25, 9.0, -9.0, 9.0);
    slab(-0.25, 0.25, -9.0, -0.25);
    slab(-0.25, 0.25, 0.25, 9.0);
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const auto through_hole = [](const glm::dvec2& p) {
        return std::max(std::abs(p.x), std::abs(p.y)) < 0.75 ? 1.0f : 0.0f;
    };
    EXPECT_EQ(mismatches(tracer.visibility(hits, scene.lamp({0.0, 3.0, 0.0})), through_hole), 0);
    const auto below_plate = tracer.visibility(hits, scene.lamp({0.0, 1.5, 0.0}));
    EXPECT_EQ(std::count(below_plate.begin(), below_plate.end(), 1.0f), kSize * kSize)
        << "what lies beyond the lamp casts nothing";
}

TEST(ReferenceTracer, AMaskedSquareCastsItsCheckers) {
    AnalyticScene scene;
    assets::Texture checker;
    checker.width = checker.height = 2;
    checker.linear_filter = false;
    checker.rgba = {0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255};  // solid: upper left and lower right
    scene.library.textures.push_back(checker);
    scene.library.materials.emplace_back();
    scene.library.materials[1].alpha_mode = assets::AlphaMode::mask;
    scene.library.materials[1].base_colour_texture = 0;
    scene.place_floor(20.0);
    scene.place(scene.add_square(1), {0.0, 1.0, 0.0}, glm::dmat3({4, 0, 0}, {0, 0, -4}, {0, 4, 0})).visible = false;
    const auto checkers = [](const glm::dvec2& p) {
        if (std::max(std::abs(p.x), std::abs(p.y)) > 2.0) return 1.0f;
        return (p.x < 0.0) == (p.y < 0.0) ? 0.0f : 1.0f;  // -z is up in the texture
    };
    const auto trace = [&] {
        const ReferenceTracer tracer = scene.tracer();
        return tracer.visibility(tracer.trace_primary(scene.view_from_above(kSize, kWidth)),
                                 scene.sun({0.0, 1.0, 0.0}));
    };
    EXPECT_EQ(mismatches(trace(), checkers), 0);
    scene.library.materials[1].alpha_mode = assets::AlphaMode::opaque;
    EXPECT_EQ(
        mismatches(trace(),
                   [&](const glm::dvec2& p) { return std::max(std::abs(p.x), std::abs(p.y)) > 2.0 ? 1.0f : 0.0f; }),
        0);
    scene.library.materials[1].alpha_mode = assets::AlphaMode::blend;
    EXPECT_EQ(mismatches(trace(), [](const glm::dvec2&) { return 1.0f; }), 0);
}

TEST(ReferenceTracer, PrimaryRaysLookThroughMaskedTexelsAndBlendedSurfaces) {
    AnalyticScene scene;
    scene.library.materials.emplace_back();
    scene.library.materials[1].alpha_mode = assets::AlphaMode::mask;
    scene.library.materials[1].base_colour.a = 0.4f;
    scene.place_floor(20.0);
    scene.place(scene.add_square(1), {0.0, 1.0, 0.0}, glm::dmat3({4, 0, 0}, {0, 0, -4}, {0, 4, 0}));
    const auto seen_instance = [&] {
        const ReferenceTracer tracer = scene.tracer();
        return tracer.source_of(tracer.trace_primary(scene.view_from_above(1, 1.0)).triangle[0]).instance;
    };
    EXPECT_EQ(seen_instance(), 0u);
    scene.library.materials[1].base_colour.a = 0.6f;
    EXPECT_EQ(seen_instance(), 1u);
    scene.library.materials[1].alpha_mode = assets::AlphaMode::blend;
    EXPECT_EQ(seen_instance(), 0u);
}

TEST(ReferenceTracer, BackFacesAreSeenOnlyOfDoubleSidedMaterialsAndMirroringSwapsThem) {
    for (const bool mirrored : {false, true})
        for (const bool turned : {false, true})
            for (const bool double_sided : {false, true}) {
                AnalyticScene scene;
                scene.library.materials[0].double_sided = double_sided;
                glm::dmat3 basis({1, 0, 0}, {0, 0, -1}, {0, 1, 0});                          // faces up
                if (mirrored) basis = basis * glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1});  // still faces up
                if (turned) basis = glm::dmat3({1, 0, 0}, {0, -1, 0}, {0, 0, -1}) * basis;   // half a turn: faces down
                scene.place(scene.add_square(), glm::dvec3(0.0), basis);
                const ReferenceTracer tracer = scene.tracer();
                const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(1, 0.5));
                const std::string what = std::string(mirrored ? "mirrored " : "") + (turned ? "turned " : "") +
                                         (double_sided ? "double" : "single");
                EXPECT_EQ(hits.triangle[0] != kNoTriangle, double_sided || !turned) << what;
                if (hits.triangle[0] != kNoTriangle) {
                    EXPECT_GT(hits.normal_ws[0].y, 0.99) << what;
                }
            }
}

TEST(ReferenceTracer, CastersBlockWithBothFacesAlsoWhenHiddenOrMirrored) {
    for (const double flip : {1.0, -1.0}) {
        AnalyticScene scene;
        scene.place_floor(20.0);
        InstanceItem& caster =
            scene.place(scene.add_square(), {0.0, 1.0, 0.0}, glm::dmat3({2 * flip, 0, 0}, {0, 0, 2}, {0, 2, 0}));
        caster.visible = false;
        const ReferenceTracer tracer = scene.tracer();
        const auto v =
            tracer.visibility(tracer.trace_primary(scene.view_from_above(kSize, kWidth)), scene.sun({0.0, 1.0, 0.0}));
        EXPECT_EQ(std::count(v.begin(), v.end(), 0.0f), 16 * 16);
    }
}

TEST(ReferenceTracer, NonReceiversAreLitWhereTheyFaceTheLight) {
    AnalyticScene scene = floor_and_cube();
    scene.snapshot.instances[0].receives = false;
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const auto above = tracer.visibility(hits, scene.sun({0.5, 1.0, 0.25}));
    EXPECT_EQ(std::count(above.begin(), above.end(), 1.0f), kSize * kSize);
    const LightTruth below = tracer.trace_light(hits, scene.sun({0.5, -1.0, 0.25}), true);
    EXPECT_EQ(std::count(below.visibility.begin(), below.visibility.end(), 0.0f), kSize * kSize);
    EXPECT_EQ(std::count(below.scored.begin(), below.scored.end(), 1), 0);
}

TEST(ReferenceTracer, NothingSeenIsMinusOneAndNearAndFarCut) {
    AnalyticScene scene;
    const ConsumerItem view = scene.view_from_above(4, 1.0);
    const ReferenceTracer empty = scene.tracer();
    const auto v = empty.visibility(empty.trace_primary(view), scene.sun({0, 1, 0}));
    EXPECT_EQ(v, std::vector<float>(16, -1.0f));

    scene.place_floor(20.0);
    const ReferenceTracer tracer = scene.tracer();
    ConsumerItem camera = view;
    camera.projection = CameraProjection::perspective;
    for (const auto& [near_m, far_m, seen] : {std::tuple{0.1, 49.0, false},
                                              {0.1, 51.0, true},
                                              {50.5, 99.0, false},
                                              {0.1, std::numeric_limits<double>::infinity(), true}}) {
        camera.near_m = near_m;
        camera.far_m = far_m;
        EXPECT_EQ(tracer.trace_primary(camera).triangle[5] != kNoTriangle, seen) << near_m << ' ' << far_m;
        ConsumerItem flat = camera;
        flat.projection = CameraProjection::orthographic;
        EXPECT_EQ(tracer.trace_primary(flat).triangle[5] != kNoTriangle, seen) << near_m << ' ' << far_m;
    }
}

TEST(ReferenceTracer, PixelCentresOfAPerspectiveLieWhereTheProjectionPutsThem) {
    AnalyticScene scene;
    scene.place_floor(200.0);
    ConsumerItem camera = scene.view_from_above(1, 1.0);
    camera.projection = CameraProjection::perspective;
    camera.fov_y_rad = kQuarterTurn;  // 100 m high on the floor
    camera.viewport_px = {20, 10};
    camera.near_m = 0.1;
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(camera);
    const glm::dvec3 lower_left = hits.position_rel_m[0], second = hits.position_rel_m[1];
    EXPECT_NEAR(lower_left.x, -95.0, 1e-9);
    EXPECT_NEAR(lower_left.y, 0.0, 1e-12);
    EXPECT_NEAR(lower_left.z, 45.0, 1e-9) << "the first row is the lowest";
    EXPECT_NEAR(second.x, -85.0, 1e-9);
}

TEST(ReferenceTracer, FlatNeighboursAndCoincidentLayersDoNotShadowThemselves) {
    for (const double at : {0.0, 1.0e6}) {
        AnalyticScene scene;
        scene.offset_m = glm::dvec3(at);
        scene.library.materials[0].double_sided = true;
        const glm::dmat3 tilt =
            glm::dmat3({0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}) * glm::dmat3({9, 0, 0}, {0, 0, -9}, {0, 9, 0});
        const std::uint32_t square = scene.add_square();
        scene.place(square, glm::dvec3(0.0), tilt);
        scene.place(square, glm::dvec3(0.0), tilt);  // the same again
        const ReferenceTracer tracer = scene.tracer();
        const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(64, 2.0));  // pixels on the diagonal
        for (const glm::dvec3& sun :
             {glm::dvec3(-0.8, 0.6, 0.0), {0.6001, 0.8, 0.0}, {0.6, 0.801, 0.3}, {-0.6, -0.795, 0.01}}) {
            const LightTruth truth = tracer.trace_light(hits, scene.sun(sun), true);
            const auto scored = std::count(truth.scored.begin(), truth.scored.end(), 1);
            EXPECT_EQ(std::count(truth.visibility.begin(), truth.visibility.end(), 1.0f), scored);
            EXPECT_EQ(std::count(truth.ambiguous.begin(), truth.ambiguous.end(), 1), 0);
        }
    }
}

TEST(ReferenceTracer, ACasterThatTouchesTheFloorShadowsUpToTheContact) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    scene.place(scene.add_cube(), {0.0, 0.5, 0.0}).visible = false;  // its lower face lies in the floor
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const auto swept = [](const glm::dvec2& p) {  // the point p + s*(1, 1, 0), s in (0, 1), meets the cube
        return std::abs(p.y) < 0.5 && p.x < 0.5 && p.x > -1.5 ? 0.0f : 1.0f;
    };
    EXPECT_EQ(mismatches(tracer.visibility(hits, scene.sun({1.0, 1.0, 0.0})), swept), 0);
}

TEST(ReferenceTracer, PixelsOnAShadowEdgeAreAmbiguousAndTheirNeighboursAreNot) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    // Edge of the caster at x = 0.0625, right through the centres of column 32.
    scene.place(scene.add_square(), {-0.9675, 1.0, 0.0}, glm::dmat3({2.06, 0, 0}, {0, 0, -2}, {0, 2, 0})).visible =
        false;
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, kWidth));
    const LightTruth truth = tracer.trace_light(hits, scene.sun({0.0, 1.0, 0.0}), true);
    for (std::uint32_t x = 0; x < kSize; ++x) EXPECT_EQ(truth.ambiguous[32 * kSize + x], x == 32 ? 1 : 0) << x;
    EXPECT_EQ(tracer.ambiguous(hits, scene.sun({0.0, 1.0, 0.0})), truth.ambiguous);
}

TEST(ReferenceTracer, UnusableInstancesDoNotExist) {
    AnalyticScene scene = floor_and_cube();
    const std::size_t before = scene.tracer().triangle_count();
    EXPECT_EQ(before, 2u + 12u);
    scene.place(77, glm::dvec3(0.0));
    scene.place(scene.add_cube(), glm::dvec3(0.0), glm::dmat3(0.0));
    scene.place(scene.add_cube(), glm::dvec3(std::nan(""), 0.0, 0.0));
    EXPECT_EQ(scene.tracer().triangle_count(), before);
}

/// Compares with tests of every triangle against every ray, in double, without a tree. The tree must lose and add none.
TEST(ReferenceTracer, TheTreeAgreesWithAsManyTestsAsThereAreTriangles) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::uniform_real_distribution<float> anyf(-1.0f, 1.0f);
    AnalyticScene scene;
    scene.offset_m = {1.0e5, 0.0, -1.0e5};
    scene.library.materials[0].double_sided = true;
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 900; ++i) {
        points.emplace_back(3.0f * anyf(random), 3.0f * anyf(random), 3.0f * anyf(random));
        indices.push_back(i < 3 || i % 3 ? i : i - 3);  // long thin fans and strays
    }
    scene.place(scene.add_mesh(points, indices), glm::dvec3(0.0));
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(scene.view_from_above(kSize, 6.0));
    const LightItem light = scene.lamp({0.3, 7.0, 0.2});
    const std::vector<float> visibility = tracer.visibility(hits, light);

    const auto corner = [&](std::uint32_t i) { return glm::dvec3(points[indices[i]]); };
    int compared = 0, wrong = 0, dark = 0;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        if (hits.triangle[i] == kNoTriangle) continue;
        const glm::dvec3 p = hits.position_rel_m[i], to_light = light.position_ws_m - scene.offset_m - p;
        if (glm::dot(hits.normal_ws[i], to_light) <= 0.0) continue;
        bool blocked = false;
        for (std::uint32_t k = 0; k < indices.size() && !blocked; k += 3) {
            if (k / 3 == hits.triangle[i]) continue;
            const glm::dvec3 e1 = corner(k + 1) - corner(k), e2 = corner(k + 2) - corner(k);
            const glm::dvec3 q = glm::cross(to_light, e2);
            const double det = glm::dot(e1, q);
            const double u = glm::dot(p - corner(k), q) / det;
            const glm::dvec3 r = glm::cross(p - corner(k), e1);
            const double v = glm::dot(to_light, r) / det, t = glm::dot(e2, r) / det;
            blocked = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-12 && t < 1.0;
        }
        ++compared;
        dark += blocked ? 1 : 0;
        wrong += (visibility[i] == 0.0f) == blocked ? 0 : 1;
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(dark, 100);
    EXPECT_LT(dark, compared - 100);
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace gnomon::oracle
