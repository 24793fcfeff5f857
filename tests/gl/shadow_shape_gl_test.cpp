#include <ostream>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/box_fixture.h"

// One box above a plane: the shadow's polygon is known.
namespace gnomon {
namespace {

struct Row {
    LightKind kind;
    ShadowFilter filter;
    friend void PrintTo(const Row& row, std::ostream* out) {
        *out << shadow::light_kind_row(row.kind).name << "_" << shadow::filter_row(row.filter).name;
    }
};

std::vector<Row> all_table_rows() {
    std::vector<Row> rows;
    for (const auto& kind : shadow::light_kind_table()) {
        if (light_facts(kind.kind).area()) continue;  // no single projection: area_lights_gl_test.cpp
        for (const auto& filter : shadow::filter_table()) rows.push_back({kind.kind, filter.id});
    }
    return rows;
}

class ShadowShape : public BoxTest {
protected:
    /// Adds a light of this kind high on the left that shines on `at`.
    ecs::Entity add_slanting_light(LightKind kind, const glm::dvec3& at = glm::dvec3(0.0), ShadowFilter filter = ShadowFilter::hard) {
        const glm::dvec3 position(-3.0, 6.0, 2.0);
        const Light light{.kind = kind, .intensity = kind == LightKind::directional ? 10000.0f : 3000.0f, .outer_cone_rad = 0.9f};
        return add_light(light, at + position, -position, {.filter = filter, .resolution_px = 512});
    }
};

class ShadowShapeOfRow : public ShadowShape, public ::testing::WithParamInterface<Row> {};
class PlacedShapeOfRow : public ShadowShapeOfRow {};

TEST_P(ShadowShapeOfRow, OfABoxAboveAPlaneIsItsProjection) {
    add_ground(6.0);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_slanting_light(GetParam().kind, {}, GetParam().filter);
    look_down(5.0);
    draw();
    expect_true(kSome, 10 * kSome);
}

TEST_P(PlacedShapeOfRow, OfABoxThatStandsOnThePlaneReachesItsFoot) {
    truth.margin_m = 0.08;
    add_ground(6.0);
    add_box({-0.5, 0.0, -0.7}, {0.6, 2.0, 0.8});
    add_slanting_light(GetParam().kind, {}, GetParam().filter);
    look_down(5.0);
    draw();
    expect_true(kSome, 10 * kSome);
}

TEST_P(PlacedShapeOfRow, IsTheSameAMillionMetresAway) {
    const glm::dvec3 far(1.0e6, 0.0, -1.0e6);
    add_ground(6.0, far);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8}, {.translation_m = far});
    add_slanting_light(GetParam().kind, far, GetParam().filter);
    look_down(5.0, far);
    draw();
    expect_true(kSome, 10 * kSome);
}

std::string name_of_row(const ::testing::TestParamInfo<Row>& row) {
    return std::string(shadow::light_kind_row(row.param.kind).name) + "_" + std::string(shadow::filter_row(row.param.filter).name);
}
INSTANTIATE_TEST_SUITE_P(EachKindAndFilter, ShadowShapeOfRow, ::testing::ValuesIn(all_table_rows()), name_of_row);
INSTANTIATE_TEST_SUITE_P(EachKindAndFilter, PlacedShapeOfRow, ::testing::ValuesIn(all_table_rows()), name_of_row);

class ShadowShapeOfKind : public ShadowShape, public ::testing::WithParamInterface<Row> {};

TEST_P(ShadowShapeOfKind, OfAMirroredInstanceIsMirrored) {
    add_ground(6.0);
    add_box({0.8, 0.5, -1.2}, {2.0, 1.2, 0.2}, {.scale = {-1.0, 1.0, 1.0}});
    add_slanting_light(GetParam().kind);
    look_down(5.0);
    draw();
    expect_true(kSome, 10 * kSome);
    // Without the mirroring the oracle finds the box's shadow in the wrong place.
    truth.boxes.front().basis = glm::dmat3(1.0);
    EXPECT_GT(judged().wrong, kSome);
}

TEST_P(ShadowShapeOfKind, OfAStretchedAndTurnedBoxFollowsItsShape) {
    add_ground(6.0);
    const Transform turned{.translation_m = {0.4, 1.6, 0.2},
                           .rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, 0.2))),
                           .scale = {2.5, 0.3, 0.8}};
    add_box(glm::dvec3(-0.5), glm::dvec3(0.5), turned);
    add_slanting_light(GetParam().kind);
    look_down(5.0);
    draw();
    expect_true(kSome, 10 * kSome);
    truth.boxes.front().basis = glm::mat3_cast(turned.rotation);
    EXPECT_GT(judged().wrong, kSome / 3) << "the same box unstretched would pass";
}

TEST_P(ShadowShapeOfKind, OfTwoInstancesOfOneMeshOneMirroredAreBothThere) {
    add_ground(6.0);
    const glm::dvec3 min(0.8, 0.5, -1.2), max(2.0, 1.2, 0.2);
    add_box(min, max);
    place(1, {.scale = {-1.0, 1.0, 1.0}});  // the mesh of the box
    truth.boxes.push_back({{min, max}, glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)), {}});
    add_slanting_light(GetParam().kind);
    look_down(5.0);
    draw();
    expect_true(2 * kSome, 10 * kSome);
}

TEST_P(ShadowShapeOfKind, FollowsABoxThatMoves) {
    add_ground(6.0);
    const ecs::Entity box = add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_slanting_light(GetParam().kind);
    look_down(5.0);
    draw();
    const auto before = visibility();
    const glm::dvec3 step(0.3, -0.2, -1.1);
    world.patch<Transform>(box, [&](Transform& t) { t.translation_m = step; });
    draw();
    EXPECT_NE(before, visibility());
    EXPECT_GT(judged().wrong, kSome / 3) << "the former shadow would pass";
    truth.boxes.front().translation_m = step;
    expect_true(kSome, 10 * kSome);
}

TEST_P(ShadowShapeOfKind, IsSeenFromAPerspectiveCameraInsideTheCaster) {
    truth.boxes_hide = false;  // from within, the box's faces are turned away and culled
    add_ground(8.0);
    add_box({-1.0, 1.0, -1.0}, {1.0, 3.0, 1.0});
    add_slanting_light(GetParam().kind);
    add_camera({.fov_y_rad = 2.0}, {0.1, 2.0, -0.2}, {0.0, -1.0, 0.0});
    draw();
    expect_true(kSome, 10 * kSome);
}

TEST_P(ShadowShapeOfKind, IsSeenFromAPerspectiveCameraBesideIt) {
    truth.margin_m = 0.15;
    add_ground(8.0);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_slanting_light(GetParam().kind);
    add_camera({.fov_y_rad = 0.9}, {1.0, 5.0, 8.0}, {-0.1, -0.6, -1.0});
    draw();
    expect_true(kSome, 5 * kSome);
}

INSTANTIATE_TEST_SUITE_P(EachKind, ShadowShapeOfKind,
                         ::testing::Values(Row{LightKind::directional, ShadowFilter::hard}, Row{LightKind::spot, ShadowFilter::hard},
                                           Row{LightKind::point, ShadowFilter::hard}),
                         [](const auto& row) { return std::string(shadow::light_kind_row(row.param.kind).name); });

}  // namespace
}  // namespace gnomon
