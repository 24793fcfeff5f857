#include "engine/math/bounds_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iostream>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <string>

#include "engine/math/frustum.h"
#include "tests/unit/allocation_counter.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::math {
namespace {

class Boxes {
public:
    explicit Boxes(std::uint64_t seed) : random_(seed) {}
    Aabb box(double reach, double size) {
        const glm::dvec3 centre = vector(reach), half = glm::abs(vector(size));
        return {centre - half, centre + half};
    }
    std::vector<Aabb> boxes(std::size_t count) {
        std::vector<Aabb> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(box(100.0, 1.0));
        return all;
    }
    glm::dvec3 vector(double reach) {
        std::uniform_real_distribution<double> number(-reach, reach);
        return {number(random_), number(random_), number(random_)};
    }

private:
    std::mt19937_64 random_;
};

void build(BoundsTree& tree, const std::vector<Aabb>& boxes) {
    tree.build(static_cast<std::uint32_t>(boxes.size()), [&](std::uint32_t i) { return boxes[i]; });
}

/// Returns the function, of the kind that BoundsTree::visit() takes, that classifies a box's overlap with `volume`.
auto touching(const Aabb& volume) {
    return [volume](const Aabb& box) {
        if (!overlaps(volume, box)) return Overlap::outside;
        return merged(volume, box) == volume ? Overlap::inside : Overlap::partial;
    };
}

std::vector<std::uint32_t> found(const BoundsTree& tree, const Aabb& volume) {
    std::vector<std::uint32_t> items;
    tree.visit(touching(volume), [&](std::uint32_t i) { items.push_back(i); });
    std::sort(items.begin(), items.end());
    return items;
}

std::vector<std::uint32_t> wanted(const std::vector<Aabb>& boxes, const Aabb& volume) {
    std::vector<std::uint32_t> items;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (overlaps(volume, boxes[i])) items.push_back(i);
    return items;
}

TEST(BoundsTree, FindsWhatLookingAtEveryBoxFinds) {
    Boxes random(print_seed());
    for (const std::size_t count : {0u, 1u, 2u, 4u, 5u, 17u, 300u}) {
        const std::vector<Aabb> boxes = random.boxes(count);
        BoundsTree tree;
        build(tree, boxes);
        EXPECT_EQ(tree.size(), count);
        for (int round = 0; round < 200; ++round) {
            const Aabb volume = random.box(120.0, 60.0);
            EXPECT_EQ(found(tree, volume), wanted(boxes, volume));
        }
    }
}

TEST(BoundsTree, FindsTheSameAfterAnyMovesAsATreeBuiltAnew) {
    Boxes random(print_seed());
    for (const std::size_t moves : {1u, 5u, 400u}) {
        std::vector<Aabb> boxes = random.boxes(400);
        BoundsTree tree;
        build(tree, boxes);
        for (int round = 0; round < 60; ++round) {
            for (std::size_t k = 0; k < moves; ++k) {
                const std::size_t i = (k * 37 + static_cast<std::size_t>(round) * 11) % boxes.size();
                boxes[i] = random.box(100.0 + round, 1.0 + round % 7);
                tree.move(static_cast<std::uint32_t>(i), boxes[i]);
            }
            tree.refit();
            const Aabb volume = random.box(120.0, 60.0);
            ASSERT_EQ(found(tree, volume), wanted(boxes, volume)) << moves << " moves, round " << round;
        }
    }
}

TEST(BoundsTree, AMoveThatIsNotRefittedIsAMistakeTheseTestsNotice) {
    Boxes random(3);
    std::vector<Aabb> boxes = random.boxes(100);
    BoundsTree tree;
    build(tree, boxes);
    boxes[7] = {glm::dvec3(500.0), glm::dvec3(501.0)};
    tree.move(7, boxes[7]);
    EXPECT_NE(found(tree, boxes[7]), wanted(boxes, boxes[7]));
    tree.refit();
    EXPECT_EQ(found(tree, boxes[7]), wanted(boxes, boxes[7]));
}

/// Counts the boxes that a search looks at.
std::size_t cost(const BoundsTree& tree, const Aabb& volume) {
    std::size_t looks = 0;
    const auto classify = touching(volume);
    tree.visit(
        [&](const Aabb& box) {
            ++looks;
            return classify(box);
        },
        [](std::uint32_t) {});
    return looks;
}

TEST(BoundsTree, LooksAtFewBoxes) {
    Boxes random(5);
    BoundsTree tree;
    build(tree, random.boxes(100000));
    EXPECT_LT(cost(tree, {glm::dvec3(0.0), glm::dvec3(2.0)}), 300u);
    EXPECT_EQ(cost(tree, {glm::dvec3(-200.0), glm::dvec3(200.0)}), 1u) << "all inside: one look at the root";
    EXPECT_EQ(cost(tree, {glm::dvec3(300.0), glm::dvec3(301.0)}), 1u);
}

TEST(BoundsTree, IsBuiltAgainWhenMovesHaveMadeItLoose) {
    Boxes random(6);
    std::vector<Aabb> boxes = random.boxes(2000);
    BoundsTree tree, fresh;
    build(tree, boxes);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) tree.move(i, boxes[i] = random.box(100.0, 1.0));
    tree.refit();
    build(fresh, boxes);
    const Aabb volume{glm::dvec3(0.0), glm::dvec3(20.0)};
    EXPECT_EQ(cost(tree, volume), cost(fresh, volume));
}

TEST(BoundsTree, OneThatFliesOffLeavesTheTreeAsItIs) {
    Boxes random(8);
    std::vector<Aabb> boxes = random.boxes(2000);
    BoundsTree tree;
    build(tree, boxes);
    const Aabb volume{glm::dvec3(0.0), glm::dvec3(20.0)};
    const std::size_t before = cost(tree, volume);
    tree.move(9, {glm::dvec3(1e8), glm::dvec3(1e8 + 1.0)});
    tree.refit();
    EXPECT_LE(cost(tree, volume), before + 30);
}

TEST(BoundsTree, EmptyBoxesAreNeverFoundAndMayComeBack) {
    std::vector<Aabb> boxes(9);
    boxes[3] = {glm::dvec3(0.0), glm::dvec3(1.0)};
    BoundsTree tree;
    build(tree, boxes);
    const Aabb everything{glm::dvec3(-1e9), glm::dvec3(1e9)};
    EXPECT_EQ(found(tree, everything), std::vector<std::uint32_t>{3});
    tree.move(3, {});
    tree.move(5, {glm::dvec3(7.0), glm::dvec3(7.0)});
    tree.refit();
    EXPECT_EQ(found(tree, everything), std::vector<std::uint32_t>{5});
}

TEST(BoundsTree, EqualBoxesAreTakenApartAllTheSame) {
    const std::vector<Aabb> boxes(1000, Aabb{glm::dvec3(1.0), glm::dvec3(2.0)});
    BoundsTree tree;
    build(tree, boxes);
    EXPECT_EQ(found(tree, boxes[0]).size(), boxes.size());
    EXPECT_TRUE(found(tree, {glm::dvec3(3.0), glm::dvec3(4.0)}).empty());
}

/// Boxes by number, and a tree that follows what comes and goes.
class SplicedBoxes {
public:
    SplicedBoxes(std::size_t count, std::uint64_t seed) : random_(seed), numbers_(seed), boxes_(random_.boxes(count)) {
        build(tree, boxes_);
    }
    /// Takes out `removals` boxes and puts in `additions`, at random places of the order.
    void splice(std::size_t removals, std::size_t additions) {
        const std::vector<std::uint32_t> removed = numbers(removals, boxes_.size());
        for (std::size_t k = removed.size(); k-- > 0;)
            boxes_.erase(boxes_.begin() + static_cast<std::ptrdiff_t>(removed[k]));
        const std::vector<std::uint32_t> added = numbers(additions, boxes_.size() + additions);
        for (const std::uint32_t at : added)
            boxes_.insert(boxes_.begin() + static_cast<std::ptrdiff_t>(at), random_.box(100.0, 1.0));
        tree.splice(removed, added, [&](std::uint32_t i) { return boxes_[i]; });
    }
    void move_one() {
        if (boxes_.empty()) return;
        const std::uint32_t i = numbers(1, boxes_.size()).front();
        tree.move(i, boxes_[i] = random_.box(100.0, 1.0));
        tree.refit();
    }
    void expect_all_found(const std::string& when) {
        ASSERT_EQ(tree.size(), boxes_.size()) << when;
        for (int k = 0; k < 3; ++k) {
            const Aabb volume = random_.box(120.0, 60.0);
            ASSERT_EQ(found(tree, volume), wanted(boxes_, volume)) << when;
        }
        Aabb all;
        for (const Aabb& box : boxes_) all = merged(all, box);
        ASSERT_EQ(tree.box(), all) << when;
        const auto height = [](const Aabb& box) { return box.min.y; };
        double lowest = std::numeric_limits<double>::infinity();
        for (const Aabb& box : boxes_) lowest = std::min(lowest, height(box));
        ASSERT_EQ(
            tree.lowest(height, [&](std::uint32_t i, double least) { return std::min(least, height(boxes_[i])); }),
            lowest)
            << when;
    }
    BoundsTree tree;
    std::vector<Aabb>& boxes() { return boxes_; }

private:
    /// Draws distinct rising numbers below `bound`, at most `count`.
    std::vector<std::uint32_t> numbers(std::size_t count, std::size_t bound) {
        std::vector<std::uint32_t> all(bound), some;
        std::iota(all.begin(), all.end(), 0u);
        std::sample(all.begin(), all.end(), std::back_inserter(some), static_cast<std::ptrdiff_t>(count), numbers_);
        return some;
    }
    Boxes random_;
    std::mt19937_64 numbers_;
    std::vector<Aabb> boxes_;
};

TEST(BoundsTree, FindsWhatCameAndNotWhatWent) {
    for (const std::size_t count : {0u, 1u, 5u, 300u}) {
        SplicedBoxes world(count, print_seed());
        for (std::size_t round = 0; round < 120; ++round) {
            world.splice(round % 5, round % 7);
            world.expect_all_found("round " + std::to_string(round));
            world.move_one();
            world.expect_all_found("a move after round " + std::to_string(round));
        }
        world.splice(world.boxes().size(), 0);
        world.expect_all_found("all went");
        world.splice(0, 40);
        world.expect_all_found("others came");
    }
}

TEST(BoundsTree, AMoveBeforeASpliceIsNotLost) {
    SplicedBoxes world(200, 11);
    world.tree.move(7, world.boxes()[7] = {glm::dvec3(500.0), glm::dvec3(501.0)});
    world.splice(3, 3);
    world.expect_all_found("moved, then renumbered");
}

TEST(BoundsTree, WhatComesOneByOneCostsSearchesLittle) {
    SplicedBoxes world(20000, 12);
    for (int i = 0; i < 3000; ++i) world.splice(1, 1);
    BoundsTree fresh;
    build(fresh, world.boxes());
    const Aabb volume{glm::dvec3(0.0), glm::dvec3(60.0)};
    EXPECT_LT(cost(world.tree, volume), 2 * cost(fresh, volume)) << "trees that fall in size by halves";
}

TEST(BoundsTree, SplicesAllocateNothingOnceWarm) {
    SplicedBoxes world(2000, 13);
    const std::vector<std::uint32_t> some{3, 40, 999};
    const auto use = [&] { world.tree.splice(some, some, [&](std::uint32_t i) { return world.boxes()[i]; }); };
    for (int i = 0; i < 3000; ++i) use();
    const std::size_t before = allocation_count();
    for (int i = 0; i < 1000; ++i) use();
    EXPECT_EQ(allocation_count(), before);
}

TEST(BoundsTree, AllocatesNothingOnceItHasHeldAsMany) {
    Boxes random(9);
    std::vector<Aabb> boxes = random.boxes(500);
    const std::vector<Aabb> others = random.boxes(400);
    BoundsTree tree;
    const auto use = [&] {
        build(tree, boxes);
        for (std::uint32_t i = 0; i < others.size(); ++i) tree.move(i, others[i]);
        tree.refit();
        build(tree, others);
    };
    use();
    use();
    const std::size_t before = allocation_count();
    use();
    EXPECT_EQ(allocation_count(), before);
}

/// Planes in any direction, some along the axes through corners of `of`, as walls and frusta are.
std::vector<Plane> planes_near(Boxes& random, const Aabb& of, std::size_t count) {
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3 normal = random.vector(1.0);
        if (i % 3 == 0) normal = {0.0, i % 2 == 0 ? 1.0 : -1.0, 0.0};
        planes.push_back({normal, -glm::dot(normal, i % 3 == 0 ? of.min : random.vector(60.0))});
    }
    return planes;
}

TEST(BoundsTree, TestsThatPartsInheritDecideAsAllTests) {
    Boxes random(print_seed());
    int cleared = 0, misled = 0;
    for (int round = 0; round < 20000; ++round) {
        const Aabb outer = random.box(100.0, 50.0);
        const std::vector<Plane> planes = planes_near(random, outer, 1 + static_cast<std::size_t>(round) % 8);
        OpenTests open = open_tests(planes.size());
        ASSERT_EQ(overlap(planes, outer, open), overlap(planes, outer));
        cleared += open != 0 && open != open_tests(planes.size()) ? 1 : 0;
        const glm::dvec3 a = glm::mix(outer.min, outer.max, glm::abs(random.vector(1.0)));
        const glm::dvec3 b = glm::mix(outer.min, outer.max, glm::abs(random.vector(1.0)));
        const Aabb inner{glm::min(a, b), glm::max(a, b)};
        OpenTests none = 0;
        misled += overlap(planes, inner, none) == overlap(planes, inner) ? 0 : 1;
        ASSERT_EQ(overlap(planes, inner, open), overlap(planes, inner)) << round;
    }
    EXPECT_GT(cleared, 1000);
    EXPECT_GT(misled, 1000) << "tests that are left out too early would not be noticed";
}

TEST(BoundsTree, ASearchWithInheritedTestsFindsTheSameItems) {
    Boxes random(print_seed());
    const std::vector<Aabb> boxes = random.boxes(3000);
    BoundsTree tree;
    build(tree, boxes);
    std::size_t tested = 0, tested_by_parts = 0, all = 0;
    for (int round = 0; round < 100; ++round) {
        const std::vector<Plane> planes = planes_near(random, boxes[static_cast<std::size_t>(round)], 3);
        std::vector<std::uint32_t> plain, inherited;
        tree.visit(
            [&](const Aabb& box) {
                tested += planes.size();
                return overlap(planes, box);
            },
            [&](std::uint32_t i) { plain.push_back(i); });
        tree.visit(
            open_tests(planes.size()),
            [&](const Aabb& box, OpenTests& open) {
                tested_by_parts += static_cast<std::size_t>(std::popcount(open));
                return overlap(planes, box, open);
            },
            [&](std::uint32_t i) { inherited.push_back(i); });
        ASSERT_EQ(inherited, plain);
        all += plain.size();
    }
    EXPECT_GT(all, 1000u);
    EXPECT_LT(tested_by_parts, tested) << "nothing is saved";
    std::cout << tested_by_parts << " tests of planes in place of " << tested << "\n";
}

TEST(BoundsTree, TheLowestItemByNumberIsTheLowestItem) {
    Boxes random(print_seed());
    const std::vector<Aabb> boxes = random.boxes(500);
    BoundsTree tree;
    build(tree, boxes);
    std::vector<Aabb> known(tree.numbers());
    std::size_t again = 0;
    for (int round = 0; round < 50; ++round) {
        const glm::dvec3 direction = random.vector(1.0);
        const auto height = [&](const Aabb& box) {
            return glm::dot(direction, centre(box)) - glm::dot(glm::abs(direction), half_extent(box));
        };
        const double usual =
            tree.lowest(height, [&](std::uint32_t i, double least) { return std::min(least, height(boxes[i])); });
        const double by_number = tree.lowest_by_number(
            [&](const Aabb& box, std::uint32_t number) {
                again += is_empty(known[number]) ? 0 : 1;
                EXPECT_TRUE(is_empty(known[number]) || known[number] == box) << "a number names two boxes";
                known[number] = box;
                return height(box);
            },
            [&](std::uint32_t i, double least, std::uint32_t number) {
                EXPECT_TRUE(known[number] == boxes[i]);
                return std::min(least, height(boxes[i]));
            });
        ASSERT_EQ(by_number, usual);
    }
    EXPECT_GT(again, 500u);
}

}  // namespace
}  // namespace gnomon::math
