#include "tests/unit/oracle/lamp_on_floor.h"

#include <gtest/gtest.h>

#include "tests/oracle/reference_tracer.h"

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kWall_px = 64;

struct Seen {
    std::size_t wrong = 0, lit = 0, dark = 0, left_out = 0;
};

/// Counts where the tracer's results for the wall differ from those written by hand.
Seen seen(const LampOnFloor& world, const glm::dvec3& offset_m = glm::dvec3(0.0)) {
    AnalyticScene scene;
    scene.offset_m = offset_m;
    world.build(scene);
    const ReferenceTracer tracer = scene.tracer();
    const PrimaryHits hits = tracer.trace_primary(LampOnFloor::camera(scene, kWall_px));
    const LightTruth truth = tracer.trace_light(hits, scene.lamp(world.lamp_m), true);
    Seen seen;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        const bool lit = world.lights(hits.position_rel_m[i]);
        ++(lit ? seen.lit : seen.dark);
        seen.wrong += (truth.visibility[i] > 0.5f) != lit;
        seen.left_out += truth.scored[i] == 0 || truth.ambiguous[i] != 0;
    }
    return seen;
}

constexpr std::size_t kMany = kWall_px * kWall_px / 4;

TEST(LampOnFloor, LightsWhatIsOnItsSideAndLeavesTheOtherDark) {
    for (const glm::dvec3 offset_m : {glm::dvec3(0.0), glm::dvec3(1.0e3, -2.0e3, 500.0)})
        for (const double height_m : kLampHeights_m) {
            SCOPED_TRACE(height_m);
            const Seen found = seen({.lamp_m = {0.1, height_m, 0.2}}, offset_m);
            EXPECT_EQ(found.wrong, 0u);
            EXPECT_EQ(found.left_out, 0u) << "nothing here hangs on the last digits";
            EXPECT_GT(found.lit, kMany);
            EXPECT_GT(found.dark, kMany);
        }
}

TEST(LampOnFloor, InThePlaneOfAFloorThatFacesDownLightsWhatIsBelow) {
    const LampOnFloor below{.floor_faces_up = false};
    const Seen found = seen(below);
    EXPECT_EQ(found.wrong, 0u);
    EXPECT_EQ(found.left_out, 0u);
    EXPECT_TRUE(below.lights({0.0, -1.0, -3.0}));
    EXPECT_FALSE(below.lights({0.0, 1.0, -3.0}));
}

TEST(LampOnFloor, BesideAFloorInItsPlaneItIsDarkenedByNothingOfIt) {
    for (const double height_m : {0.0, 1e-9, -1e-9}) {
        const Seen found = seen({.lamp_m = {2.6, height_m, 0.3}});
        EXPECT_EQ(found.wrong, 0u) << height_m;
        EXPECT_GT(found.lit, 2 * kMany) << height_m;
    }
}

/// Checks that the floor is what separates the two sides.
TEST(LampOnFloor, WithoutTheFloorLightsBothSides) {
    AnalyticScene scene;
    const LampOnFloor world;
    world.build(scene);
    scene.snapshot.instances[0].casts = scene.snapshot.instances[1].casts = false;
    const ReferenceTracer tracer = scene.tracer();
    const auto lit =
        tracer.visibility(tracer.trace_primary(LampOnFloor::camera(scene, kWall_px)), scene.lamp(world.lamp_m));
    EXPECT_EQ(std::count(lit.begin(), lit.end(), 1.0f), kWall_px * kWall_px);
}

}  // namespace
}  // namespace gnomon::oracle
