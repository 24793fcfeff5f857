#include "systems/shadow/filter_table.h"

#include <iterator>

namespace gnomon::shadow {
namespace {

// E is the distance from the receiver's map position to the farthest texel edge that takes part:
// one nearest tap 1/2; hardware 2x2 blends texels up to one away; 3x3 nearest taps 1 + 1/2.
constexpr FilterRow kRows[] = {
    {ShadowFilter::hard, "hard", "shadow/filters/hard.glsl", 1, 0.5f, false},
    {ShadowFilter::hardware_2x2, "hardware_2x2", "shadow/filters/hardware_2x2.glsl", 1, 1.0f, true},
    {ShadowFilter::pcf_3x3, "pcf_3x3", "shadow/filters/pcf_3x3.glsl", 9, 1.5f, false},
};
static_assert(std::size(kRows) == static_cast<std::size_t>(ShadowFilter::count));

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < std::size(kRows); ++i)
        if (static_cast<std::size_t>(kRows[i].id) != i) return false;
    return true;
}
static_assert(rows_are_in_order());

}  // namespace

std::span<const FilterRow> filter_table() { return kRows; }

const FilterRow& filter_row(ShadowFilter filter) {
    const auto index = static_cast<std::size_t>(filter);
    return kRows[index < std::size(kRows) ? index : 0];
}

const FilterRow* find_filter(std::string_view name) {
    for (const FilterRow& row : kRows)
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace gnomon::shadow
