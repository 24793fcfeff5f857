#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/ecs/registry.h"

namespace gnomon::ecs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Position {
    double x = 0.0;
};
struct Colour {
    int rgb = 0;
};

constexpr ChangeKind kAdded = ChangeKind::added;
constexpr ChangeKind kChanged = ChangeKind::changed;
constexpr ChangeKind kRemoved = ChangeKind::removed;

class ChangeList : public ::testing::Test {
protected:
    std::vector<Change> read(ChangeCursor& cursor) {
        const Changes changes = registry_.changes<Position>(cursor);
        complete_ = changes.complete;
        return {changes.entries.begin(), changes.entries.end()};
    }
    Registry registry_;
    ChangeCursor cursor_;
    bool complete_ = false;
};

TEST_F(ChangeList, ATypeNeverUsedHasAnEmptyAndCompleteList) {
    EXPECT_THAT(read(cursor_), IsEmpty());
    EXPECT_TRUE(complete_);
}

TEST_F(ChangeList, EveryKindOfWriteIsListedInOrder) {
    const Entity a = registry_.create();
    const Entity b = registry_.create();
    registry_.emplace<Position>(a);
    registry_.emplace<Position>(b);
    registry_.patch<Position>(a, [](Position& p) { p.x = 1.0; });
    registry_.emplace<Position>(b, {2.0});
    registry_.remove<Position>(a);
    registry_.emplace<Position>(a);
    EXPECT_THAT(read(cursor_), ElementsAre(Change{a, kAdded}, Change{b, kAdded}, Change{a, kChanged},
                                           Change{b, kChanged}, Change{a, kRemoved}, Change{a, kAdded}));
    EXPECT_TRUE(complete_);
}

TEST_F(ChangeList, ReadingAndVainWritesListNothing) {
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    read(cursor_);
    registry_.get<Position>(e);
    registry_.each<Position>([](Entity, const Position&) {});
    registry_.remove<Colour>(e);
    registry_.destroy(kNull);
    const Entity bare = registry_.create();
    EXPECT_FALSE(registry_.patch<Position>(bare, [](Position&) { FAIL(); }));
    registry_.remove<Position>(bare);
    registry_.destroy(bare);
    EXPECT_THAT(read(cursor_), IsEmpty());
}

TEST_F(ChangeList, DestroyingListsARemovalOfEachComponentUnderTheOldId) {
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    registry_.emplace<Colour>(e);
    read(cursor_);
    registry_.destroy(e);
    registry_.destroy(e);
    const Entity fresh = registry_.create();
    registry_.emplace<Position>(fresh);
    EXPECT_THAT(read(cursor_), ElementsAre(Change{e, kRemoved}, Change{fresh, kAdded}));
    ChangeCursor colour;
    EXPECT_EQ(registry_.changes<Colour>(colour).entries.size(), 2u);
}

TEST_F(ChangeList, EachReaderHasItsOwnPlace) {
    ChangeCursor other;
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    EXPECT_EQ(read(cursor_).size(), 1u);
    EXPECT_THAT(read(cursor_), IsEmpty()) << "a second read must not repeat the first";
    registry_.patch<Position>(e, [](Position&) {});
    EXPECT_EQ(read(cursor_).size(), 1u);
    EXPECT_EQ(read(other).size(), 2u);
}

TEST_F(ChangeList, DiscardingAfterAllHaveReadLosesNothing) {
    const Entity e = registry_.create();
    for (int frame = 0; frame < 3; ++frame) {
        registry_.emplace<Position>(e);
        EXPECT_EQ(read(cursor_).size(), 1u);
        EXPECT_TRUE(complete_);
        registry_.discard_changes();
        EXPECT_THAT(read(cursor_), IsEmpty());
        EXPECT_TRUE(complete_);
    }
}

TEST_F(ChangeList, AReaderThatMissedDiscardedEntriesIsToldOnceAndThenCatchesUp) {
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    registry_.discard_changes();
    registry_.patch<Position>(e, [](Position&) {});
    EXPECT_THAT(read(cursor_), ElementsAre(Change{e, kChanged}));
    EXPECT_FALSE(complete_);
    registry_.patch<Position>(e, [](Position&) {});
    EXPECT_EQ(read(cursor_).size(), 1u);
    EXPECT_TRUE(complete_);
}

TEST_F(ChangeList, AReaderThatMissedOnlyDiscardedEntriesIsToldToo) {
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    registry_.discard_changes();
    EXPECT_THAT(read(cursor_), IsEmpty());
    EXPECT_FALSE(complete_);
}

TEST_F(ChangeList, WritesBetweenReadAndDiscardAreReportedAsLost) {
    const Entity e = registry_.create();
    registry_.emplace<Position>(e);
    read(cursor_);
    registry_.patch<Position>(e, [](Position&) {});
    registry_.discard_changes();
    read(cursor_);
    EXPECT_FALSE(complete_);
}

}  // namespace
}  // namespace gnomon::ecs
