#include <gtest/gtest.h>

#include "tests/unit/oracle/lamp_on_floor.h"
#include "tests/unit/visibility/query_scene.h"

namespace gnomon::visibility {
namespace {

using oracle::LampOnFloor;

std::vector<float> answers_of(const LampOnFloor& world, const glm::dvec3& offset_m) {
    test::QueryScene scene;
    scene.offset_m = offset_m;
    world.build(scene);
    scene.finish();
    std::vector<Place> places;
    for (const glm::dvec3& p : LampOnFloor::places()) places.push_back({p + offset_m});
    return scene.ask(scene.lamp(world.lamp_m), places);
}

void expect_true(const LampOnFloor& world, const glm::dvec3& offset_m = glm::dvec3(0.0)) {
    const std::vector<glm::dvec3> places = LampOnFloor::places();
    const std::vector<float> answers = answers_of(world, offset_m);
    std::size_t wrong = 0, lit = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        wrong += answers[i] != (world.lights(places[i]) ? 1.0f : 0.0f);
        lit += world.lights(places[i]);
    }
    EXPECT_EQ(wrong, 0u) << "of " << places.size() << ", " << lit << " of them lit";
    EXPECT_GT(lit, places.size() / 4);
}

TEST(QueriesOfALampOnAFloor, SeeItFromItsOwnSideAlone) {
    for (const glm::dvec3 offset_m : {glm::dvec3(0.0), glm::dvec3(1.0e3, -2.0e3, 500.0)})
        for (const double height_m : oracle::kLampHeights_m) {
            SCOPED_TRACE(height_m);
            expect_true({.lamp_m = {0.1, height_m, 0.2}}, offset_m);
        }
}

TEST(QueriesOfALampOnAFloor, TakeTheFloorsFrontForItsSideWhereItLiesInThePlane) {
    expect_true({.floor_faces_up = false});
}

TEST(QueriesOfALampOnAFloor, FindNothingInItsWayBesideTheFloor) { expect_true({.lamp_m = {2.6, 0.0, 0.3}}); }

}  // namespace
}  // namespace gnomon::visibility
