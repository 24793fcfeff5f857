#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "systems/transform/transform_system.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Quarantine : public ::testing::Test {
protected:
    ecs::Entity add(double x, ecs::Entity parent = ecs::kNull) {
        const ecs::Entity e = registry_.create();
        Transform t;
        t.translation_m.x = x;
        t.parent = parent;
        registry_.emplace<Transform>(e, t);
        return e;
    }
    const std::vector<QuarantinedEntity>& update() {
        const auto& list = system_.update(registry_).quarantined;
        registry_.discard_changes();
        return list;
    }
    void reparent(ecs::Entity e, ecs::Entity parent) {
        registry_.patch<Transform>(e, [&](Transform& t) { t.parent = parent; });
    }
    bool placed(ecs::Entity e) const { return registry_.has<WorldTransform>(e); }
    double x(ecs::Entity e) const { return registry_.get<WorldTransform>(e)->translation_ws_m.x; }

    ecs::Registry registry_;
    TransformSystem system_;
};

struct BadTransform {
    const char* name;
    TransformFault fault;
    std::function<void(Transform&)> spoil;
};

class BadTransforms : public Quarantine, public ::testing::WithParamInterface<BadTransform> {};

TEST_P(BadTransforms, QuarantineTheirEntityAndItsBranchUntilMended) {
    const ecs::Entity healthy = add(1.0);
    const ecs::Entity sick = add(2.0, healthy);
    const ecs::Entity child = add(3.0, sick);
    EXPECT_THAT(update(), IsEmpty());
    const Transform good = *registry_.get<Transform>(sick);

    registry_.patch<Transform>(sick, GetParam().spoil);
    const TransformFault fault = GetParam().fault;
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{sick, fault, sick}, QuarantinedEntity{child, fault, sick}));
    EXPECT_TRUE(placed(healthy));
    EXPECT_FALSE(placed(sick));
    EXPECT_FALSE(placed(child));
    EXPECT_EQ(update().size(), 2u) << "the report keeps naming them while nothing changes";

    registry_.emplace<Transform>(sick, good);
    EXPECT_THAT(update(), IsEmpty());
    EXPECT_EQ(x(child), 6.0);
}

const BadTransform kRows[] = {
    {"nan_translation", TransformFault::not_finite, [](Transform& t) { t.translation_m.y = kNan; }},
    {"infinite_translation", TransformFault::not_finite, [](Transform& t) { t.translation_m.z = -kInfinity; }},
    {"nan_rotation", TransformFault::not_finite, [](Transform& t) { t.rotation.w = kNan; }},
    {"infinite_rotation", TransformFault::not_finite, [](Transform& t) { t.rotation.x = kInfinity; }},
    {"zero_rotation", TransformFault::zero_rotation, [](Transform& t) { t.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0); }},
    {"nan_scale", TransformFault::not_finite, [](Transform& t) { t.scale.x = kNan; }},
    {"infinite_scale", TransformFault::not_finite, [](Transform& t) { t.scale.y = kInfinity; }},
};

std::string row_name(const ::testing::TestParamInfo<BadTransform>& row) { return row.param.name; }

INSTANTIATE_TEST_SUITE_P(Hard, BadTransforms, ::testing::ValuesIn(kRows), row_name);

TEST_F(Quarantine, AProductThatOverflowsIsTheFaultOfTheEntityWhereItHappens) {
    const ecs::Entity parent = add(0.0);
    const ecs::Entity child = add(0.0, parent);
    registry_.patch<Transform>(parent, [](Transform& t) { t.scale = glm::dvec3(1e200); });
    registry_.patch<Transform>(child, [](Transform& t) { t.scale = glm::dvec3(1e200); });
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{child, TransformFault::not_finite, child}));
    EXPECT_TRUE(placed(parent));
    registry_.patch<Transform>(parent, [](Transform& t) { t.scale = glm::dvec3(1e-200); });
    EXPECT_THAT(update(), IsEmpty());
}

TEST_F(Quarantine, ADestroyedParentLeavesItsChildrenWithoutAPlace) {
    const ecs::Entity parent = add(1.0);
    const ecs::Entity child = add(2.0, parent);
    const ecs::Entity grandchild = add(3.0, child);
    update();
    registry_.destroy(parent);
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{child, TransformFault::parent_missing, child},
                                      QuarantinedEntity{grandchild, TransformFault::parent_missing, child}));
    EXPECT_FALSE(placed(child));
    reparent(child, ecs::kNull);
    EXPECT_THAT(update(), IsEmpty());
    EXPECT_EQ(x(grandchild), 5.0);
}

TEST_F(Quarantine, AStrangerThatReusesADeadParentsIndexDoesNotAdoptTheChildren) {
    const ecs::Entity parent = add(1.0);
    const ecs::Entity child = add(2.0, parent);
    update();
    registry_.destroy(parent);
    const ecs::Entity stranger = add(50.0);
    ASSERT_EQ(stranger.index, parent.index);
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{child, TransformFault::parent_missing, child}));
    registry_.patch<Transform>(stranger, [](Transform& t) { t.translation_m.x = 60.0; });
    EXPECT_EQ(update().size(), 1u);
    EXPECT_FALSE(placed(child));
}

TEST_F(Quarantine, AParentWithoutTransformIsWaitedFor) {
    const ecs::Entity parent = registry_.create();
    const ecs::Entity child = add(2.0, parent);
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{child, TransformFault::parent_missing, child}));
    registry_.emplace<Transform>(parent);
    EXPECT_THAT(update(), IsEmpty());
    EXPECT_EQ(x(child), 2.0);
    registry_.remove<Transform>(parent);
    EXPECT_EQ(update().size(), 1u);
    EXPECT_FALSE(placed(child));
    EXPECT_FALSE(placed(parent));
}

TEST_F(Quarantine, AnEntityThatIsItsOwnParentIsACycle) {
    const ecs::Entity e = add(1.0);
    update();
    reparent(e, e);
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{e, TransformFault::parent_cycle, e}));
    reparent(e, ecs::kNull);
    EXPECT_THAT(update(), IsEmpty());
    EXPECT_EQ(x(e), 1.0);
}

TEST_F(Quarantine, ACycleTakesItsMembersAndTheirDescendantsAndNobodyElse) {
    const ecs::Entity a = add(1.0);
    const ecs::Entity b = add(1.0, a);
    const ecs::Entity c = add(1.0, b);
    const ecs::Entity hanger_on = add(1.0, b);
    const ecs::Entity bystander = add(1.0);
    update();
    reparent(a, c);
    EXPECT_THAT(update(), UnorderedElementsAre(QuarantinedEntity{a, TransformFault::parent_cycle, a},
                                               QuarantinedEntity{b, TransformFault::parent_cycle, b},
                                               QuarantinedEntity{c, TransformFault::parent_cycle, c},
                                               QuarantinedEntity{hanger_on, TransformFault::parent_cycle, b}));
    EXPECT_TRUE(placed(bystander));
    reparent(b, ecs::kNull);
    EXPECT_THAT(update(), IsEmpty());
    EXPECT_EQ(x(a), 3.0);
    EXPECT_EQ(x(hanger_on), 2.0);
}

TEST_F(Quarantine, ACycleFoundFromBelowIsTheSameCycle) {
    const ecs::Entity leaf = registry_.create();
    const ecs::Entity a = registry_.create();
    const ecs::Entity b = registry_.create();
    Transform t;
    t.parent = a;
    registry_.emplace<Transform>(leaf, t);
    registry_.emplace<Transform>(b, t);
    t.parent = b;
    registry_.emplace<Transform>(a, t);
    EXPECT_THAT(update(), ElementsAre(QuarantinedEntity{leaf, TransformFault::parent_cycle, a},
                                      QuarantinedEntity{a, TransformFault::parent_cycle, a},
                                      QuarantinedEntity{b, TransformFault::parent_cycle, b}));
}

TEST_F(Quarantine, DestroyingAQuarantinedEntityTakesItOffTheList) {
    const ecs::Entity sick = add(kNan);
    EXPECT_EQ(update().size(), 1u);
    registry_.destroy(sick);
    EXPECT_THAT(update(), IsEmpty());
}

TEST_F(Quarantine, EveryFaultHasItsOwnCode) {
    EXPECT_STREQ(fault_code(TransformFault::not_finite), "not_finite");
    EXPECT_STREQ(fault_code(TransformFault::zero_rotation), "zero_rotation");
    EXPECT_STREQ(fault_code(TransformFault::parent_missing), "parent_missing");
    EXPECT_STREQ(fault_code(TransformFault::parent_cycle), "parent_cycle");
}

}  // namespace
}  // namespace gnomon
