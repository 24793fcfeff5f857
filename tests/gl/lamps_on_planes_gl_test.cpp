#include <cmath>
#include <sstream>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/oracle/exactness.h"

/// Lamps on a table's top, or nearer to it than floats resolve. A lamp on or above the top lights what stands above and
/// nothing below; a lamp below it does the reverse. The test itself states what a wall behind must show; rays in double
/// judge all of the picture.
namespace gnomon {
namespace {

constexpr double kTable_m = 2.0, kWall_m = 3.0;  // half of the table; how far behind its middle the wall stands
constexpr double kHeights_m[] = {0.0, 1e-9, -1e-9, 1e-6, -1e-6, 3e-5, -3e-5, 1e-3, -1e-3};
constexpr std::size_t kLeast = 200;  // pixels of the wall that are lit, and that are dark

struct Case {
    const char* name;
    LightKind kind;
    ShadowFilter filter;
    CubeRoute route = CubeRoute::automatic;
    double most_wrong = 0.002;  // share of the scored pixels: edges are off by that in maps of 512 texels; 0: none
};

class LampsOnPlanes : public TracedFrameTest {
protected:
    /// Builds the world askew and far from its origin, or along the axes. `thick_m`: thickness of a solid table, below
    /// its top; 0: a sheet.
    void make_world(bool askew, double thick_m = 0.0, const glm::dvec3& eye = {0.6, 0.5, 6.0}) {
        start_anew();
        settings.viewport_px = {160, 120};
        turn = askew ? glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 0.5))) : glm::dquat(1.0, 0.0, 0.0, 0.0);
        at = askew ? glm::dvec3(311.7, -40.3, 1234.1) : glm::dvec3(0.0);
        add_material({.name = "matt", .metallic = 0.0f, .double_sided = true});
        table = put(thick_m > 0.0 ? game::make_box({-kTable_m, -thick_m, -kTable_m}, {kTable_m, 0.0, kTable_m})
                                  : game::make_card(glm::dvec3(0.0), {0.0, 0.0, kTable_m}, {kTable_m, 0.0, 0.0}));
        put(game::make_box({0.7, 0.0, -0.9}, {1.0, 0.9, -0.6}));
        put(game::make_box({-1.2, -1.4, -0.9}, {-0.9, -0.3, -0.6}));
        put(game::make_card({0.0, 0.0, -kWall_m}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0}));
        add_camera({.fov_y_rad = 0.9, .near_m = 0.05}, placed(eye), turn * glm::dvec3(-0.1, -0.24 * eye.y, -1.0));
    }
    ecs::Entity put(const game::Shape& shape) {
        return place(add_analysed(shape), {.translation_m = at, .rotation = turn});
    }
    glm::dvec3 placed(const glm::dvec3& p) const { return at + turn * p; }
    void shine(const Case& c, const glm::dvec3& from) {
        lamp = add_light(
            {.kind = c.kind, .intensity = 1000.0f, .range_m = 0.0f, .inner_cone_rad = 1.2f, .outer_cone_rad = 1.3f},
            placed(from), turn * glm::dvec3(0.0, 0.0, -1.0), {.filter = c.filter, .resolution_px = 512},
            {.maps = {.cube_route = c.route}});
    }
    void move_lamp(const glm::dvec3& to) {
        world.patch<Transform>(lamp, [&](Transform& t) { t.translation_m = placed(to); });
    }
    /// Pixels of the wall, farther from the line in which the table's plane meets it than edges may be off.
    struct Wall {
        std::size_t lit = 0, dark = 0, wrong = 0, truth_wrong = 0, left_out = 0;
    };
    Wall look_at_wall(bool above, bool below, const std::vector<float>& measured, const oracle::LightTruth& truth,
                      const oracle::PrimaryHits& hits, const glm::dvec3& camera_ws_m) const {
        constexpr double kEdge_m = 0.06;
        Wall wall;
        for (std::size_t i = 0; i < hits.count(); ++i) {
            if (hits.triangle[i] == oracle::kNoTriangle) continue;
            const glm::dvec3 p = glm::inverse(turn) * (hits.position_rel_m[i] + camera_ws_m - at);
            if (std::abs(p.z + kWall_m) > 1e-6 || std::abs(p.y) < kEdge_m || behind_a_box(p)) continue;
            const bool lit = p.y > 0.0 ? above : below;
            ++(lit ? wall.lit : wall.dark);
            wall.wrong += (measured[i] >= 0.5f) != lit;
            wall.truth_wrong += (truth.visibility[i] > 0.5f) != lit;
            wall.left_out += !truth.scored[i] || truth.ambiguous[i];
        }
        return wall;
    }
    /// Returns whether the boxes' shadows may be there, of any of these lights: the boxes stand aside.
    static bool behind_a_box(const glm::dvec3& p) { return std::abs(p.x) > 0.65; }
    /// Draws, and compares the wall with what the caller states, the picture with rays. `above`, `below`: whether the
    /// wall is lit there.
    void expect_true(bool above, bool below, double most_wrong = 0.002) {
        draw();
        const SceneSnapshot& scene = frame().snapshot();
        const ConsumerItem& camera = scene.consumers.at(0);
        const oracle::ReferenceTracer tracer(scene, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        const oracle::LightTruth truth = tracer.trace_light(hits, scene.lights.at(0), true);
        const std::vector<float> measured = visibility();
        const Wall wall = look_at_wall(above, below, measured, truth, hits, camera.position_ws_m);
        EXPECT_EQ(wall.truth_wrong, 0u) << "by rays";
        EXPECT_EQ(wall.wrong, 0u) << "as drawn";
        EXPECT_EQ(wall.left_out, 0u);
        EXPECT_GT(wall.lit, above && below ? 2 * kLeast : kLeast);
        EXPECT_GE(wall.dark, above && below ? 0u : kLeast);
        if (!(most_wrong > 0.0)) {
            EXPECT_EQ(oracle::exactness(tracer, hits, camera, truth, measured).wrong, 0u);
            return;
        }
        const oracle::Metrics all =
            oracle::compare({hits.size_px, measured, truth.visibility, truth.scored, truth.ambiguous});
        EXPECT_LE(all.fraction(all.wrong), most_wrong) << all.wrong << " of " << all.scored;
        EXPECT_LE(all.ambiguous, all.scored / 500);
    }

    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 at{0.0};
    ecs::Entity table{}, lamp{};
};

class LampsOnTables : public LampsOnPlanes, public ::testing::WithParamInterface<Case> {};

INSTANTIATE_TEST_SUITE_P(
    Filters, LampsOnTables,
    ::testing::Values(
        Case{"point_by_default", LightKind::point, ShadowFilter::automatic},
        Case{"spot_by_default", LightKind::spot, ShadowFilter::automatic},
        Case{"point_six_passes", LightKind::point, ShadowFilter::automatic, CubeRoute::six_passes},
        Case{"point_layered_vertex", LightKind::point, ShadowFilter::automatic, CubeRoute::layered_vertex},
        Case{"point_layered_geometry", LightKind::point, ShadowFilter::automatic, CubeRoute::layered_geometry},
        Case{"point_exact", LightKind::point, ShadowFilter::exact, CubeRoute::automatic, 0.0},
        Case{"spot_exact", LightKind::spot, ShadowFilter::exact, CubeRoute::automatic, 0.0},
        Case{"point_exact_soft", LightKind::point, ShadowFilter::exact_soft, CubeRoute::automatic, 0.01},
        Case{"point_pcf", LightKind::point, ShadowFilter::pcf_grid, CubeRoute::automatic, 0.02},
        Case{"spot_pcf", LightKind::spot, ShadowFilter::pcf_grid, CubeRoute::automatic, 0.02},
        Case{"point_hard", LightKind::point, ShadowFilter::hard, CubeRoute::automatic, 0.02}),
    [](const auto& test) { return test.param.name; });

TEST_P(LampsOnTables, LightWhatIsOnTheirSideOfTheTopAlone) {
    for (const bool askew : {false, true}) {
        make_world(askew);
        shine(GetParam(), {0.1, 0.5, 0.2});
        for (const double height_m : kHeights_m) {
            std::ostringstream where;
            where << (askew ? "askew, " : "along the axes, ") << height_m << " m above";
            SCOPED_TRACE(where.str());
            move_lamp({0.1, height_m, 0.2});
            expect_true(height_m >= 0.0, height_m < 0.0, GetParam().most_wrong);
        }
    }
}

constexpr Case kPoint{"point", LightKind::point, ShadowFilter::automatic};

TEST_F(LampsOnPlanes, OnASolidTableLightWhatIsAboveIt) {
    make_world(true, 0.1);
    shine(kPoint, {0.1, 0.5, 0.2});
    for (const double height_m : {0.0, 1e-9, 1e-6}) {
        SCOPED_TRACE(height_m);
        move_lamp({0.1, height_m, 0.2});
        expect_true(true, false);
    }
}

/// Checks lamps that see the table edge-on.
TEST_F(LampsOnPlanes, BesideATableInItsPlaneLightBothSidesOfIt) {
    for (const bool askew : {false, true}) {
        make_world(askew);
        shine(kPoint, {0.0, 0.5, kTable_m + 0.3});
        for (const double height_m : {0.0, 1e-9, -1e-9}) {
            SCOPED_TRACE(height_m);
            move_lamp({0.0, height_m, kTable_m + 0.3});
            expect_true(true, true);
        }
    }
}

TEST_F(LampsOnPlanes, SunsInATablesPlaneLightBothSidesOfIt) {
    make_world(false);
    lamp = add_light({.kind = LightKind::directional, .intensity = 1000.0f}, {}, {0.0, 0.0, -1.0}, {});
    for (const double rise : {0.0, 1e-9, -1e-9, 1e-6, -1e-6}) {
        SCOPED_TRACE(rise);
        world.patch<Transform>(lamp, [&](Transform& t) { t.rotation = looking_along({0.0, -rise, -1.0}); });
        expect_true(true, true);
    }
}

/// Checks that a camera in the plane sees the table as nothing, and the wall as any other camera does.
TEST_F(LampsOnPlanes, AreTheSameToACameraInTheTablesPlane) {
    for (const double eye_m : {0.0, 1e-9, -1e-9}) {
        SCOPED_TRACE(eye_m);
        make_world(false, 0.0, {0.6, eye_m, 6.0});
        shine(kPoint, {0.1, 0.0, 0.2});
        expect_true(true, false);
    }
}

/// Checks that it is the table that leaves one side dark (negative control).
TEST_F(LampsOnPlanes, WithoutTheTablesShadowLightBothSides) {
    make_world(false);
    world.remove<ShadowCaster>(table);
    shine(kPoint, {0.1, 0.0, 0.2});
    expect_true(true, true);
}

}  // namespace
}  // namespace gnomon
