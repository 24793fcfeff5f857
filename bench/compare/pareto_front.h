#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::bench {

/// Error and cost of a choice; the less of either the better.
struct ErrorAndCost {
    double error = 0.0, cost = 0.0;
};

/// Costs that differ by less are the same: what a median of rounds on a busy machine still wavers by.
inline constexpr double kCostNoise = 0.05;

/// Returns 1 for each choice that is the best at some cost, 0 for a beaten one. Less error beats a choice at a cost of
/// up to kCostNoise above its own. The same error beats it at a cost of more than kCostNoise below. Quadratic.
std::vector<std::uint8_t> on_front(std::span<const ErrorAndCost> choices);

}  // namespace gnomon::bench
