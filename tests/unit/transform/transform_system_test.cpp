#include "systems/transform/transform_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <random>

#include "tests/unit/math/random_seed.h"

namespace gnomon {
namespace {

using ::testing::IsEmpty;

Transform at(double x, double y, double z, ecs::Entity parent = ecs::kNull) {
    Transform t;
    t.translation_m = {x, y, z};
    t.parent = parent;
    return t;
}

void expect_near(const glm::dvec3& got, const glm::dvec3& want, double tolerance = 1e-14) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(got[axis], want[axis], tolerance) << "axis " << axis;
}

glm::dvec3 map(const WorldTransform& w, const glm::dvec3& p) { return w.basis * p + w.translation_ws_m; }

struct World {
    ecs::Registry registry;
    TransformSystem system;

    ecs::Entity add(const Transform& t) {
        const ecs::Entity e = registry.create();
        registry.emplace<Transform>(e, t);
        return e;
    }
    const TransformReport& update() {
        const TransformReport& report = system.update(registry);
        registry.discard_changes();
        return report;
    }
    glm::dvec3 position(ecs::Entity e) const {
        const auto* world = registry.get<WorldTransform>(e);
        return world ? world->translation_ws_m : glm::dvec3(std::nan(""));
    }
};

TEST(TransformSystem, ARootIsPlacedByItsOwnScaleRotationAndTranslation) {
    World w;
    Transform t = at(10.0, 20.0, 30.0);
    t.scale = {2.0, 3.0, 4.0};
    t.rotation = glm::angleAxis(glm::half_pi<double>(), glm::dvec3(0.0, 0.0, 1.0));
    const ecs::Entity e = w.add(t);
    const TransformReport& report = w.update();
    EXPECT_EQ(report.evaluated, 1u);
    EXPECT_EQ(report.changed, 1u);
    EXPECT_THAT(report.quarantined, IsEmpty());
    ASSERT_TRUE(w.registry.has<WorldTransform>(e));
    expect_near(map(*w.registry.get<WorldTransform>(e), {1.0, 1.0, 1.0}), {10.0 - 3.0, 20.0 + 2.0, 30.0 + 4.0});
}

TEST(TransformSystem, AnIdentityKeepsItsTranslationBitForBit) {
    World w;
    const ecs::Entity e = w.add(at(1e8 + 0.1, -1e-300, 3.0));
    w.update();
    EXPECT_EQ(w.position(e), glm::dvec3(1e8 + 0.1, -1e-300, 3.0));
    EXPECT_EQ(w.registry.get<WorldTransform>(e)->basis, glm::dmat3(1.0));
}

TEST(TransformSystem, QuaternionsOfAnyLengthRotateAlike) {
    const glm::dquat unit = glm::angleAxis(0.7, glm::dvec3(0.6, 0.0, 0.8));
    for (const double length : {1e-200, 0.25, 3.0, 1e200}) {
        World w;
        Transform t = at(0.0, 0.0, 0.0);
        t.rotation = unit * length;
        const ecs::Entity e = w.add(t);
        w.update();
        ASSERT_TRUE(w.registry.has<WorldTransform>(e)) << length;
        const glm::dmat3& basis = w.registry.get<WorldTransform>(e)->basis;
        for (int column = 0; column < 3; ++column) expect_near(basis[column], glm::mat3_cast(unit)[column]);
    }
}

TEST(TransformSystem, AZeroScaleIsAllowed) {
    World w;
    Transform t = at(1.0, 2.0, 3.0);
    t.scale = {0.0, 0.0, 0.0};
    const ecs::Entity e = w.add(t);
    EXPECT_THAT(w.update().quarantined, IsEmpty());
    EXPECT_EQ(w.position(e), glm::dvec3(1.0, 2.0, 3.0));
}

TEST(TransformSystem, ChildrenFollowTheirParentsWhicheverCameFirst) {
    World w;
    const ecs::Entity grandchild = w.registry.create();
    const ecs::Entity parent = w.registry.create();
    const ecs::Entity child = w.registry.create();
    w.registry.emplace<Transform>(grandchild, at(0.0, 0.0, 1.0, child));
    Transform turned = at(100.0, 0.0, 0.0);
    turned.rotation = glm::angleAxis(glm::half_pi<double>(), glm::dvec3(0.0, 1.0, 0.0));
    turned.scale = glm::dvec3(2.0);
    w.registry.emplace<Transform>(child, at(0.0, 1.0, 0.0, parent));
    w.registry.emplace<Transform>(parent, turned);
    EXPECT_EQ(w.update().evaluated, 3u);
    expect_near(w.position(child), {100.0, 2.0, 0.0}, 1e-13);
    expect_near(w.position(grandchild), {102.0, 2.0, 0.0}, 1e-13);
}

TEST(TransformSystem, MovingAParentMovesItsDescendantsAndNobodyElse) {
    World w;
    const ecs::Entity parent = w.add(at(1.0, 0.0, 0.0));
    const ecs::Entity child = w.add(at(0.0, 1.0, 0.0, parent));
    const ecs::Entity grandchild = w.add(at(0.0, 0.0, 1.0, child));
    const ecs::Entity stranger = w.add(at(7.0, 7.0, 7.0));
    w.update();
    w.registry.patch<Transform>(parent, [](Transform& t) { t.translation_m.x = 5.0; });
    const TransformReport& report = w.update();
    EXPECT_EQ(report.evaluated, 3u);
    EXPECT_EQ(report.changed, 3u);
    EXPECT_EQ(w.position(grandchild), glm::dvec3(5.0, 1.0, 1.0));
    EXPECT_EQ(w.position(stranger), glm::dvec3(7.0));
}

TEST(TransformSystem, ReparentingMovesTheWholeBranch) {
    World w;
    const ecs::Entity left = w.add(at(-10.0, 0.0, 0.0));
    const ecs::Entity right = w.add(at(10.0, 0.0, 0.0));
    const ecs::Entity child = w.add(at(1.0, 0.0, 0.0, left));
    const ecs::Entity sibling = w.add(at(2.0, 0.0, 0.0, left));
    const ecs::Entity grandchild = w.add(at(0.5, 0.0, 0.0, child));
    w.update();
    EXPECT_EQ(w.position(grandchild).x, -8.5);
    w.registry.patch<Transform>(child, [&](Transform& t) { t.parent = right; });
    w.update();
    EXPECT_EQ(w.position(grandchild).x, 11.5);
    w.registry.patch<Transform>(left, [](Transform& t) { t.translation_m.x = -20.0; });
    EXPECT_EQ(w.update().evaluated, 2u) << "the child that left must not follow its old parent";
    EXPECT_EQ(w.position(sibling).x, -18.0);
    EXPECT_EQ(w.position(child).x, 11.0);
    w.registry.patch<Transform>(child, [](Transform& t) { t.parent = ecs::kNull; });
    w.update();
    EXPECT_EQ(w.position(child).x, 1.0);
}

TEST(TransformSystem, RemovingATransformRemovesThePlaceInTheWorld) {
    World w;
    const ecs::Entity e = w.add(at(1.0, 2.0, 3.0));
    w.update();
    w.registry.remove<Transform>(e);
    EXPECT_EQ(w.update().changed, 1u);
    EXPECT_FALSE(w.registry.has<WorldTransform>(e));
    w.registry.emplace<Transform>(e, at(4.0, 5.0, 6.0));
    w.update();
    EXPECT_EQ(w.position(e), glm::dvec3(4.0, 5.0, 6.0));
}

TEST(TransformSystem, AnEntityThatReusesAnIndexStartsAfresh) {
    World w;
    const ecs::Entity old = w.add(at(1.0, 0.0, 0.0));
    w.update();
    w.registry.destroy(old);
    const ecs::Entity fresh = w.add(at(2.0, 0.0, 0.0));
    ASSERT_EQ(fresh.index, old.index);
    w.update();
    EXPECT_FALSE(w.registry.has<WorldTransform>(old));
    EXPECT_EQ(w.position(fresh).x, 2.0);
}

TEST(TransformSystem, ALostChangeListIsMadeUpForByLookingAtEverything) {
    World w;
    const ecs::Entity parent = w.add(at(1.0, 0.0, 0.0));
    const ecs::Entity child = w.add(at(1.0, 0.0, 0.0, parent));
    const ecs::Entity doomed = w.add(at(9.0, 9.0, 9.0));
    w.update();
    w.registry.patch<Transform>(parent, [](Transform& t) { t.translation_m.x = 2.0; });
    w.registry.remove<Transform>(doomed);
    w.registry.discard_changes();
    const ecs::Entity late = w.add(at(3.0, 0.0, 0.0, child));
    w.registry.discard_changes();
    w.update();
    EXPECT_EQ(w.position(child).x, 3.0);
    EXPECT_EQ(w.position(late).x, 6.0);
    EXPECT_FALSE(w.registry.has<WorldTransform>(doomed));
}

TEST(TransformSystem, OneMeterAtAHundredThousandKilometresStaysAMeter) {
    World w;
    const ecs::Entity parent = w.add(at(1e8, -1e8, 1e8));
    const ecs::Entity child = w.add(at(1.0, 0.25, -0.5, parent));
    w.update();
    EXPECT_EQ(w.position(child) - w.position(parent), glm::dvec3(1.0, 0.25, -0.5));
}

/// Computes a place by its plain definition: recursion over parents, from scratch. Empty where the entity has no place.
std::optional<WorldTransform> by_recursion(const ecs::Registry& registry, ecs::Entity e, int depth = 0) {
    const Transform* t = registry.get<Transform>(e);
    if (!t || depth > 64 || !std::isfinite(t->translation_m.x)) return std::nullopt;
    WorldTransform local;
    const glm::dmat3 rotation = glm::mat3_cast(glm::normalize(t->rotation));
    for (int column = 0; column < 3; ++column) local.basis[column] = rotation[column] * t->scale[column];
    local.translation_ws_m = t->translation_m;
    if (t->parent == ecs::kNull) return local;
    const auto above = by_recursion(registry, t->parent, depth + 1);
    if (!above) return std::nullopt;
    return WorldTransform{above->basis * local.basis, above->basis * local.translation_ws_m + above->translation_ws_m};
}

TEST(TransformSystem, RandomEditsGiveWhatPlainRecursionGives) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    World w;
    std::vector<ecs::Entity> known;
    const auto any = [&] { return known.empty() ? ecs::kNull : known[random() % known.size()]; };
    const auto random_transform = [&] {
        Transform t = at(number(random), number(random), number(random), random() % 3 ? any() : ecs::kNull);
        t.rotation = {number(random), number(random), number(random), 1.5};
        t.scale = {number(random), number(random), number(random)};
        if (random() % 20 == 0) t.translation_m.x = std::nan("");
        return t;
    };
    std::size_t placed = 0, missing = 0;
    for (int round = 0; round < 600; ++round) {
        for (std::uint64_t edit = random() % 6; edit > 0; --edit) {
            const ecs::Entity e = any();
            switch (random() % 5) {
                case 0:
                    known.push_back(w.add(random_transform()));
                    break;
                case 1:
                    known.push_back(w.registry.create());
                    break;
                case 2:
                    if (known.size() > 30) w.registry.destroy(e);
                    break;  // stays known, as a dead parent
                case 3:
                    if (random() % 4 == 0) w.registry.remove<Transform>(e);
                    break;
                default:
                    if (w.registry.alive(e)) w.registry.emplace<Transform>(e, random_transform());
                    break;
            }
            if (known.size() > 60) known.erase(known.begin());
        }
        const TransformReport& report = random() % 10 ? w.update() : w.system.update(w.registry);
        std::size_t quarantined = 0;
        for (const ecs::Entity e : w.registry.entities_with<Transform>()) {
            const auto want = by_recursion(w.registry, e);
            const auto* got = w.registry.get<WorldTransform>(e);
            ASSERT_EQ(got != nullptr, want.has_value()) << "round " << round << " entity " << e.index;
            if (!got) ++quarantined;
            ++(got ? placed : missing);
            if (got) expect_near(got->translation_ws_m, want->translation_ws_m, 1e-12);
            if (got) expect_near(got->basis * glm::dvec3(1.0), want->basis * glm::dvec3(1.0), 1e-12);
        }
        ASSERT_EQ(report.quarantined.size(), quarantined) << "round " << round;
        ASSERT_EQ(w.registry.entities_with<WorldTransform>().size() + quarantined,
                  w.registry.entities_with<Transform>().size());
        for (const QuarantinedEntity& q : report.quarantined) {
            ASSERT_TRUE(w.registry.has<Transform>(q.entity)) << "round " << round;
            ASSERT_NE(q.fault, TransformFault::none);
            ASSERT_TRUE(w.registry.alive(q.cause)) << "round " << round;
        }
    }
    EXPECT_GT(placed, 1000u);
    EXPECT_GT(missing, 1000u);
}

}  // namespace
}  // namespace gnomon
