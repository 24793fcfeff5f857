#include "sample_game/game/step_climbing.h"

#include <gmock/gmock.h>

#include <cmath>

#include "sample_game/game/stairs.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::game {
namespace {

TEST(Footing, OnLevelGroundTheFeetStayWhereTheyAreBitForBit) {
    for (const double height : {0.0, 0.1, -3.7, 1.0e6})
        EXPECT_EQ(stepped({height, 0.0}, height), (Footing{height, 0.0}));
}

TEST(Footing, AStepUpToTheLimitIsClimbedSmoothlyAndExactly) {
    Footing feet;
    double highest_move = 0.0;
    for (int i = 0; i < 10; ++i) {
        const Footing next = stepped(feet, kStepLimit_m);
        highest_move = std::max(highest_move, next.height_m - feet.height_m);
        EXPECT_EQ(next.fall_m_per_s, 0.0);
        feet = next;
    }
    EXPECT_EQ(feet.height_m, kStepLimit_m);
    EXPECT_LE(highest_move, kClimb_m_per_s * kStep_s + 1e-12);
    EXPECT_EQ(stepped({}, std::nextafter(kStepLimit_m, 1.0)).height_m, 0.0);  // that is a wall
}

TEST(Footing, AStepDownIsFollowedWithoutFalling) {
    Footing feet{kStepLimit_m, 0.0};
    for (int i = 0; i < 10; ++i) {
        feet = stepped(feet, 0.0);
        EXPECT_EQ(feet.fall_m_per_s, 0.0);
    }
    EXPECT_EQ(feet.height_m, 0.0);
}

TEST(Footing, FromALedgeTheFeetFallAsGravityHasItAndLand) {
    constexpr double kLedge_m = 1.44;
    Footing feet{kLedge_m, 0.0};
    int steps = 0;
    double last_m = kLedge_m;
    while (feet.height_m > 0.0 && steps < 1000) {
        feet = stepped(feet, 0.0);
        EXPECT_LE(feet.height_m, last_m);
        last_m = feet.height_m;
        ++steps;
    }
    EXPECT_NEAR(steps * kStep_s, std::sqrt(2.0 * kLedge_m / 9.81), 2.0 * kStep_s);
    EXPECT_EQ(feet, (Footing{0.0, 0.0}));
}

TEST(Footing, AFallGoesOnThroughTheLastStepsHeight) {
    const Footing feet = stepped({0.2, 4.0}, 0.0);
    EXPECT_GT(feet.fall_m_per_s, 4.0);
    EXPECT_LT(feet.height_m, 0.2 - 4.0 * kStep_s);
}

TEST(Stairs, TheCourtyardsFlightIsEightTreadsThatEachCanBeClimbed) {
    const auto scene = load_game_scene();
    ASSERT_TRUE(scene);
    const auto& meshes = scene.value().meshes;
    const auto mesh = std::find_if(meshes.begin(), meshes.end(), [](const auto& m) { return m.name == "stairs"; });
    ASSERT_NE(mesh, meshes.end());
    const std::vector<Solid> treads = treads_of(*mesh, 7);
    ASSERT_EQ(treads.size(), 8u);
    double below = 0.0;
    for (const Solid& tread : treads) {
        EXPECT_EQ(tread.node, 7u);
        EXPECT_NEAR(tread.max_m.y - below, 0.18, 1e-6);
        EXPECT_LT(tread.max_m.y - below, kStepLimit_m);
        EXPECT_EQ(tread.min_m.y, mesh->bounds_ms.min.y);
        below = tread.max_m.y;
    }
    for (std::size_t i = 1; i < treads.size(); ++i) EXPECT_NEAR(treads[i].min_m.x, treads[i - 1].max_m.x, 1e-6);
}

TEST(Stairs, FacesThatLookDownOrAslantAreNoTreads) {
    assets::Mesh roof;
    for (const glm::vec3 p : {glm::vec3{0, 0, 0}, {0, 1, 1}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}, {0, 2, 1}})
        roof.vertices.push_back({.position_ms = p});
    roof.indices = {0, 1, 2, 3, 4, 5};  // one aslant, one level that looks down
    EXPECT_TRUE(treads_of(roof, 0).empty());
    roof.indices = {3, 5, 4};
    EXPECT_EQ(treads_of(roof, 0).size(), 1u);
    EXPECT_TRUE(treads_of({}, 0).empty());
}

}  // namespace
}  // namespace gnomon::game
