#include "sample_game/support/scene/node_motion.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace gnomon::game {
namespace {

using Motion = assets::Node::Motion;

const Transform kRest{.translation_m = {1.0, 2.0, 3.0},
                      .rotation = glm::angleAxis(0.5 * glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0))};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Motion, SpinTurnsOncePerPeriodCounterClockwise) {
    const Motion spin{.kind = "spin", .axis = {0.0, 2.0, 0.0}, .period_s = 4.0};
    const Transform quarter = moved({}, spin, 1.0);
    expect_near(quarter.rotation * glm::dvec3(1.0, 0.0, 0.0), {0.0, 0.0, -1.0});
    expect_near(moved({}, spin, 4.0).rotation * glm::dvec3(1.0, 0.0, 0.0), {1.0, 0.0, 0.0});
    EXPECT_EQ(quarter.translation_m, glm::dvec3(0.0));
}

TEST(Motion, SwingReachesItsAmplitudeAfterAQuarterPeriodOnBothSides) {
    const Motion swing{.kind = "swing", .axis = {1.0, 0.0, 0.0}, .amplitude = 0.3, .period_s = 2.0};
    expect_near(moved({}, swing, 0.5).rotation * glm::dvec3(0.0, 1.0, 0.0), {0.0, std::cos(0.3), std::sin(0.3)});
    expect_near(moved({}, swing, 1.5).rotation * glm::dvec3(0.0, 1.0, 0.0), {0.0, std::cos(0.3), -std::sin(0.3)});
}

TEST(Motion, SlideMovesAlongTheNodesOwnAxis) {
    const Motion slide{.kind = "slide", .axis = {1.0, 0.0, 0.0}, .amplitude = 2.0, .period_s = 1.0};
    expect_near(moved(kRest, slide, 0.25).translation_m, {1.0, 2.0, 1.0});  // +x of a node turned to -z
    expect_near(moved(kRest, slide, 0.5).translation_m, kRest.translation_m);
}

TEST(Motion, PhaseIsCountedInTurns) {
    Motion swing{.kind = "swing", .axis = {1.0, 0.0, 0.0}, .amplitude = 0.3, .period_s = 2.0, .phase = 0.25};
    const glm::dquat with_phase = moved({}, swing, 0.0).rotation;
    swing.phase = 0.0;
    const glm::dquat later = moved({}, swing, 0.5).rotation;
    EXPECT_NEAR(glm::dot(with_phase, later), 1.0, 1e-12);
}

TEST(Motion, NonsenseStandsStill) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const Motion rows[] = {{},
                           {.kind = "dance", .amplitude = 1.0},
                           {.kind = "spin", .axis = {0.0, 0.0, 0.0}},
                           {.kind = "spin", .axis = {nan, 0.0, 1.0}},
                           {.kind = "spin", .period_s = 0.0},
                           {.kind = "spin", .period_s = -1.0},
                           {.kind = "spin", .phase = inf},
                           {.kind = "slide", .amplitude = nan}};
    for (const Motion& row : rows) {
        const Transform now = moved(kRest, row, 0.7);
        EXPECT_EQ(now.translation_m, kRest.translation_m) << row.kind;
        EXPECT_EQ(now.rotation, kRest.rotation) << row.kind;
    }
}

TEST(Motion, OnlyMovingEntitiesAreLoggedAsChanged) {
    ecs::Registry registry;
    const ecs::Entity still = registry.create(), moving = registry.create(), dead = registry.create();
    for (const ecs::Entity e : {still, moving, dead}) registry.emplace<Transform>(e);
    ecs::ChangeCursor cursor;
    registry.changes<Transform>(cursor);
    const Motion spin{.kind = "spin", .period_s = 1.0};
    const std::vector<MovingEntity> list{{moving, {}, spin}, {dead, {}, spin}};
    registry.destroy(dead);
    registry.changes<Transform>(cursor);
    apply_motion(list, 0.3, registry);
    const ecs::Changes changes = registry.changes<Transform>(cursor);
    ASSERT_EQ(changes.entries.size(), 1u);
    EXPECT_EQ(changes.entries[0], (ecs::Change{moving, ecs::ChangeKind::changed}));
}

}  // namespace
}  // namespace gnomon::game
