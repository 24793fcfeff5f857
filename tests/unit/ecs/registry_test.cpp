#include "gnomon/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <unordered_set>

namespace gnomon::ecs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

struct Health {
    int points = 0;
    bool operator==(const Health&) const = default;
};
struct Tag {
    std::string text;
};
struct Marker {};

TEST(Registry, ANewEntityIsAliveAndBare) {
    Registry r;
    const Entity e = r.create();
    EXPECT_TRUE(r.alive(e));
    EXPECT_EQ(r.alive_count(), 1u);
    EXPECT_FALSE(r.has<Health>(e));
    EXPECT_EQ(r.get<Health>(e), nullptr);
}

TEST(Registry, NullIsNeverAlive) {
    Registry r;
    EXPECT_FALSE(r.alive(kNull));
    r.create();
    EXPECT_FALSE(r.alive(kNull));
    EXPECT_EQ(r.get<Health>(kNull), nullptr);
    EXPECT_EQ(Entity{}, kNull);
    r.destroy(kNull);
    EXPECT_EQ(r.alive_count(), 1u);
}

TEST(Registry, AReusedIndexHasANewVersionAndTheStaleHandleReachesNothing) {
    Registry r;
    const Entity old = r.create();
    r.emplace<Health>(old, {7});
    r.destroy(old);
    EXPECT_FALSE(r.alive(old));
    const Entity fresh = r.create();
    ASSERT_EQ(fresh.index, old.index);
    EXPECT_NE(fresh, old);
    EXPECT_EQ(r.get<Health>(fresh), nullptr) << "components of the old entity must not be inherited";
    r.emplace<Health>(fresh, {1});
    EXPECT_EQ(r.get<Health>(old), nullptr);
    EXPECT_FALSE(r.has<Health>(old));
    EXPECT_FALSE(r.patch<Health>(old, [](Health& h) { h.points = 99; }));
    EXPECT_FALSE(r.remove<Health>(old));
    EXPECT_EQ(r.get<Health>(fresh)->points, 1);
}

TEST(Registry, DestroyingTwiceDoesNotHandTheIndexOutTwice) {
    Registry r;
    const Entity e = r.create();
    r.destroy(e);
    r.destroy(e);
    EXPECT_EQ(r.alive_count(), 0u);
    const Entity a = r.create();
    const Entity b = r.create();
    EXPECT_NE(a.index, b.index);
}

TEST(Registry, EmplaceReplacesAndKeepsOneComponent) {
    Registry r;
    const Entity e = r.create();
    r.emplace<Health>(e, {1});
    r.emplace<Health>(e, {2});
    EXPECT_EQ(r.get<Health>(e)->points, 2);
    EXPECT_EQ(r.entities_with<Health>().size(), 1u);
}

TEST(Registry, RemovalFromTheMiddleKeepsTheOthersReachable) {
    Registry r;
    Entity e[4];
    for (int i = 0; i < 4; ++i) {
        e[i] = r.create();
        r.emplace<Tag>(e[i], {std::string(40, static_cast<char>('a' + i))});
    }
    EXPECT_TRUE(r.remove<Tag>(e[1]));
    EXPECT_FALSE(r.remove<Tag>(e[1]));
    EXPECT_THAT(r.entities_with<Tag>(), UnorderedElementsAre(e[0], e[2], e[3]));
    for (const int i : {0, 2, 3}) EXPECT_EQ(r.get<Tag>(e[i])->text, std::string(40, static_cast<char>('a' + i)));
    EXPECT_TRUE(r.remove<Tag>(e[3]));
    EXPECT_TRUE(r.remove<Tag>(e[0]));
    EXPECT_TRUE(r.remove<Tag>(e[2]));
    EXPECT_THAT(r.entities_with<Tag>(), IsEmpty());
}

TEST(Registry, DestroyingReleasesWhatTheComponentsOwn) {
    Registry r;
    const auto owned = std::make_shared<int>(1);
    const Entity e = r.create();
    r.emplace<std::shared_ptr<int>>(e, owned);
    const Entity other = r.create();
    r.emplace<std::shared_ptr<int>>(other, owned);
    EXPECT_EQ(owned.use_count(), 3);
    r.destroy(e);
    EXPECT_EQ(owned.use_count(), 2);
}

TEST(Registry, ComponentTypesAreIndependent) {
    Registry r;
    const Entity e = r.create();
    r.emplace<Health>(e, {3});
    r.emplace<Marker>(e);
    r.remove<Marker>(e);
    EXPECT_EQ(r.get<Health>(e)->points, 3);
    EXPECT_FALSE(r.has<Marker>(e));
}

TEST(Registry, RegistriesAreIndependent) {
    Registry a, b;
    const Entity in_a = a.create();
    const Entity in_b = b.create();
    ASSERT_EQ(in_a, in_b);
    a.emplace<Health>(in_a, {1});
    EXPECT_FALSE(b.has<Health>(in_b));
}

TEST(Registry, EachVisitsExactlyTheEntitiesThatHaveAllComponents) {
    Registry r;
    const Entity both = r.create();
    const Entity first_only = r.create();
    const Entity second_only = r.create();
    const Entity both_again = r.create();
    r.emplace<Health>(both, {1});
    r.emplace<Health>(first_only, {2});
    r.emplace<Health>(both_again, {3});
    r.emplace<Tag>(both_again, {"z"});
    r.emplace<Tag>(second_only, {"x"});
    r.emplace<Tag>(both, {"y"});
    std::vector<Entity> seen;
    std::string text;
    r.each<Health, Tag>([&](Entity e, const Health& h, const Tag& t) {
        seen.push_back(e);
        text += std::to_string(h.points) + t.text;
    });
    EXPECT_THAT(seen, ElementsAre(both, both_again)) << "in the order of the first component's storage";
    EXPECT_EQ(text, "1y3z");
}

TEST(Registry, EachOverATypeNeverUsedVisitsNothing) {
    Registry r;
    struct Unheard {};
    const Entity e = r.create();
    r.emplace<Health>(e);
    int visits = 0;
    r.each<Unheard>([&](Entity, const Unheard&) { ++visits; });
    r.each<Health, Unheard>([&](Entity, const Health&, const Unheard&) { ++visits; });
    EXPECT_EQ(visits, 0);
    EXPECT_THAT(r.entities_with<Unheard>(), IsEmpty());
}

TEST(Registry, EachOverOneTypeVisitsInOrderOfAddition) {
    Registry r;
    const Entity a = r.create();
    const Entity b = r.create();
    r.emplace<Health>(b);
    r.emplace<Health>(a);
    std::vector<Entity> seen;
    r.each<Health>([&](Entity e, const Health&) { seen.push_back(e); });
    EXPECT_THAT(seen, ElementsAre(b, a));
}

TEST(Registry, EntitiesThatDifferInIndexOrVersionHashApart) {
    const std::unordered_set<Entity> set = {{1, 0}, {1, 1}, {2, 0}, kNull};
    EXPECT_EQ(set.size(), 4u);
    EXPECT_EQ(set.count({1, 1}), 1u);
    EXPECT_EQ(set.count({2, 1}), 0u);
}

#ifndef NDEBUG
TEST(RegistryDeathTest, EmplacingOnADeadEntityIsAProgrammingError) {
    Registry r;
    const Entity e = r.create();
    r.destroy(e);
    EXPECT_DEATH(r.emplace<Health>(e), "alive");
}
#endif

}  // namespace
}  // namespace gnomon::ecs
