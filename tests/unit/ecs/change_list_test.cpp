#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gnomon/registry.h"
#include "tests/unit/allocation_counter.h"

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

class LateReaders : public ChangeList {
protected:
    void SetUp() override {
        for (std::size_t i = 0; i < kComponents; ++i) {
            entities_.push_back(registry_.create());
            registry_.emplace<Position>(entities_.back());
        }
        read(cursor_);
        read(late_);
    }
    void write(int count) {
        for (int i = 0; i < count; ++i) {
            const Entity e = entities_[static_cast<std::size_t>(next_++) % entities_.size()];
            registry_.patch<Position>(e, [](Position& p) { p.x += 1.0; });
        }
    }
    /// Number of components, all there from the start to the end.
    static constexpr std::size_t kComponents = 1000;
    std::vector<Entity> entities_;
    int next_ = 0;
    ChangeCursor late_;
};

TEST_F(LateReaders, FindAllThatOthersHaveReadMeanwhile) {
    std::size_t seen = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        write(20);
        EXPECT_EQ(read(cursor_).size(), 20u);
        EXPECT_TRUE(complete_);
        if (frame % 50 != 49) continue;
        const std::vector<Change> entries = read(late_);
        EXPECT_TRUE(complete_) << "as many as there are components are kept always; frame " << frame;
        EXPECT_EQ(entries.size(), kComponents);
        for (const Change& change : entries) EXPECT_EQ(change, (Change{entities_[seen++ % kComponents], kChanged}));
    }
    EXPECT_GT(seen, 0u);
}

TEST_F(LateReaders, AreToldToLookAfreshWhenTheyFellTooFarBehindAndThenGoOn) {
    for (int i = 0; i < 10; ++i) {
        write(1000);
        EXPECT_EQ(read(cursor_).size(), 1000u);
        EXPECT_TRUE(complete_) << "others are told nothing of it";
    }
    const std::vector<Change> rest = read(late_);
    EXPECT_FALSE(complete_);
    EXPECT_GE(rest.size(), kComponents);
    EXPECT_LE(rest.size(), 4 * kComponents) << "the log is bounded";
    write(7);
    EXPECT_EQ(read(late_).size(), 7u);
    EXPECT_TRUE(complete_);
}

TEST_F(LateReaders, AreNoneToWaitFor) {
    const std::size_t before = allocation_count();
    for (int frame = 0; frame < 1000; ++frame) {
        write(100);
        EXPECT_EQ(registry_.changes<Position>(cursor_).entries.size(), 100u);
    }
    EXPECT_EQ(allocation_count(), before) << "what nobody reads takes no memory";
    ChangeCursor another;
    EXPECT_LE(registry_.changes<Position>(another).entries.size(), 4 * kComponents);
}

TEST_F(LateReaders, OfManyComponentsThatGoAtOnceAreToldOfThemOrToLookAfresh) {
    for (const Entity e : entities_) registry_.destroy(e);
    const std::vector<Change> entries = read(late_);
    EXPECT_TRUE(!complete_ || entries.size() == kComponents);
    EXPECT_THAT(registry_.entities_with<Position>(), IsEmpty());
}

TEST_F(LateReaders, OfAListThatNobodyElseReadsFindItFromItsBeginning) {
    Registry fresh;
    const Entity e = fresh.create();
    fresh.emplace<Position>(e);
    for (std::size_t i = 1; i < kLeastKept; ++i) fresh.patch<Position>(e, [](Position&) {});
    ChangeCursor first;
    const Changes all = fresh.changes<Position>(first);
    EXPECT_EQ(all.entries.size(), kLeastKept);
    EXPECT_TRUE(all.complete);
}

}  // namespace
}  // namespace gnomon::ecs
