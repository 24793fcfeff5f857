#include "systems/shadow/frame/fit_history.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

LightItem light_of(std::uint32_t index) {
    LightItem light;
    light.entity = {index, 1};
    return light;
}

History history_of(std::initializer_list<std::uint32_t> lights) {
    History history;
    for (const std::uint32_t light : lights) history.lights.emplace_back().light = {light, 1};
    return history;
}

/// Returns the indices of the entries that were found, -1 for none.
std::vector<int> found_for(std::initializer_list<std::uint32_t> lights, const History& history) {
    std::vector<LightItem> items;
    for (const std::uint32_t light : lights) items.push_back(light_of(light));
    std::vector<const LightFitHistory*> found;
    find_histories(items, history, found);
    std::vector<int> indices;
    for (const LightFitHistory* entry : found)
        indices.push_back(entry ? static_cast<int>(entry - history.lights.data()) : -1);
    return indices;
}

TEST(FitHistory, IsFoundForEachLightInWhateverOrder) {
    const History history = history_of({3, 5, 9});
    EXPECT_EQ(found_for({3, 5, 9}, history), (std::vector{0, 1, 2}));
    EXPECT_EQ(found_for({1, 3, 4, 5, 9, 12}, history), (std::vector{-1, 0, -1, 1, 2, -1})) << "lights without maps";
    EXPECT_EQ(found_for({5, 9}, history), (std::vector{1, 2})) << "a light is gone";
    EXPECT_EQ(found_for({9, 3, 5}, history), (std::vector{2, 0, 1})) << "another order";
    EXPECT_EQ(found_for({9, 7}, history), (std::vector{2, -1}));
    EXPECT_EQ(found_for({3, 5}, {}), (std::vector{-1, -1}));
    EXPECT_TRUE(found_for({}, history).empty());
}

/// Compares the version, too: an index may be used again.
TEST(FitHistory, IsNotThatOfAnEarlierEntity) {
    std::vector<LightItem> items{light_of(3)};
    items[0].entity.version = 2;
    std::vector<const LightFitHistory*> found;
    find_histories(items, history_of({3}), found);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0], nullptr);
}

}  // namespace
}  // namespace gnomon::shadow
