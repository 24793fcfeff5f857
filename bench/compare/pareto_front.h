#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::bench {

/// What a choice is off by, and what it takes; the less of either the better.
struct ErrorAndCost {
    double error = 0.0, cost = 0.0;
};

/// Costs that differ by less are the same: what a median of rounds on a busy machine still wavers by.
inline constexpr double kCostNoise = 0.05;

/// Which choices are the best at some cost: 1 for those that no other one beats, with less error for no more cost than
/// kCostNoise above theirs, or with the same error for less than kCostNoise below. Quadratic.
std::vector<std::uint8_t> on_front(std::span<const ErrorAndCost> choices);

}  // namespace gnomon::bench
