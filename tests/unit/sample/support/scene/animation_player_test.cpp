#include "sample_game/support/scene/animation_player.h"

#include <gmock/gmock.h>

#include "gnomon/components.h"

namespace gnomon::game {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

assets::AnimationChannel slide(std::int32_t node, float to_x, float until_s = 2.0f) {
    return {.node = node, .times_s = {0.0f, until_s}, .values = {0, 0, 0, to_x, 0, 0}};
}

class AnimationPlayer : public ::testing::Test {
protected:
    AnimationPlayer() {
        for (ecs::Entity& node : nodes) {
            node = registry.create();
            registry.emplace<Transform>(node);
        }
    }
    double x_of(std::size_t node) const { return registry.get<Transform>(nodes[node])->translation_m.x; }
    std::size_t changes() {
        const auto entries = registry.changes<Transform>(cursor).entries;
        return entries.size();
    }
    ecs::Registry registry;
    std::vector<ecs::Entity> nodes = std::vector<ecs::Entity>(2);
    ecs::ChangeCursor cursor;
    std::vector<assets::Animation> animations{{"walk", {slide(0, 2.0f)}},
                                              {"run", {slide(0, 8.0f), slide(1, 4.0f, 1.0f)}}};
};

TEST_F(AnimationPlayer, PlaysAllAnimationsAtOnceEachWithItsOwnLength) {
    const auto played = played_channels(animations, nodes);
    play(played, 1.0, registry);
    EXPECT_EQ(x_of(0), 1.0) << "the first of two that move the same";
    EXPECT_EQ(x_of(1), 4.0);
    play(played, 1.7, registry);
    EXPECT_EQ(x_of(1), 4.0) << "its animation is not over: the channel holds its last key";
    play(played, 2.5, registry);
    EXPECT_EQ(x_of(0), 0.5) << "begun anew";
}

TEST_F(AnimationPlayer, PlaysOneAloneIfThatIsAskedFor) {
    play(played_channels(animations, nodes, 1), 1.0, registry);
    EXPECT_EQ(x_of(0), 4.0);
}

TEST_F(AnimationPlayer, TouchesNothingThatStaysAsItIs) {
    const auto played = played_channels(animations, nodes);
    play(played, 0.25, registry);
    (void)changes();
    play(played, 0.25, registry);
    play(played, 4.25, registry);
    EXPECT_EQ(changes(), 0u);
    play(played, 0.5, registry);
    EXPECT_EQ(changes(), 2u);
}

TEST_F(AnimationPlayer, PassesOverWhatIsNoLongerThere) {
    const auto played = played_channels(animations, nodes);
    registry.destroy(nodes[0]);
    play(played, 0.25, registry);
    EXPECT_EQ(x_of(1), 1.0);
}

TEST_F(AnimationPlayer, MovesMorphWeights) {
    registry.emplace<MorphWeights>(nodes[0], {{0.0f, 0.0f}});
    const assets::AnimationChannel channel{.node = 0,
                                           .property = assets::AnimatedProperty::weights,
                                           .width = 2,
                                           .times_s = {0.0f, 1.0f},
                                           .values = {0, 1, 1, 0}};
    play(played_channels({{"smile", {channel}}}, nodes), 0.25, registry);
    EXPECT_THAT(registry.get<MorphWeights>(nodes[0])->weights, ElementsAre(0.25f, 0.75f));
}

TEST_F(AnimationPlayer, FindsAnAnimationByNameElseByNumberAndSaysWhatThereIs) {
    EXPECT_EQ(find_animation(animations, "run").value(), 1u);
    EXPECT_EQ(find_animation(animations, "0").value(), 0u);
    for (const char* unknown : {"jump", "2", "-1", ""}) {
        const auto found = find_animation(animations, unknown);
        ASSERT_FALSE(found);
        EXPECT_EQ(found.error().rule, "animation.unknown");
        EXPECT_THAT(found.error().message, ::testing::HasSubstr("walk, run"));
    }
    EXPECT_THAT(find_animation({}, "walk").error().message, ::testing::HasSubstr("none"));
}

}  // namespace
}  // namespace gnomon::game
