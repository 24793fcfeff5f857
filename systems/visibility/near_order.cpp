#include "systems/visibility/near_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/math/aabb.h"

namespace gnomon::visibility {
namespace {

constexpr std::uint32_t kBitsPerAxis = 6, kDigitBits = 9, kDigits = 1u << kDigitBits;
constexpr double kCells = 1u << kBitsPerAxis;

/// Table from x to its bits with two zeros before each.
using SpreadTable = std::array<std::uint32_t, 1u << kBitsPerAxis>;
constexpr SpreadTable kSpread = [] {
    SpreadTable table{};
    for (std::uint32_t x = 0; x < table.size(); ++x)
        for (std::uint32_t i = 0; i < kBitsPerAxis; ++i) table[x] |= (x >> i & 1u) << (3 * i);
    return table;
}();

}  // namespace

std::span<const std::uint32_t> NearOrder::of(std::span<const Place> places) {
    const std::size_t count = places.size();
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    math::Aabb box;
    for (const Place& place : places) box = math::extended(box, place.at_ws_m);
    const glm::dvec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    if (count <= 16 || !(longest > 0.0) || !std::isfinite(longest)) return order_;
    const double per_m = kCells / longest;
    keys_.resize(count);
    sorted_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 cell = (places[i].at_ws_m - box.min) * per_m;
        const auto at = [](double c) {
            return kSpread[static_cast<std::size_t>(c > 0.0 ? std::min(c, kCells - 1.0) : 0.0)];
        };
        keys_[i] = at(cell.x) | at(cell.y) << 1 | at(cell.z) << 2;
    }
    for (const std::uint32_t shift : {0u, kDigitBits}) {
        std::array<std::uint32_t, kDigits> next{};
        for (const std::uint32_t key : keys_) ++next[key >> shift & (kDigits - 1)];
        std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
        for (const std::uint32_t i : order_) sorted_[next[keys_[i] >> shift & (kDigits - 1)]++] = i;
        order_.swap(sorted_);
    }
    return order_;
}

}  // namespace gnomon::visibility
