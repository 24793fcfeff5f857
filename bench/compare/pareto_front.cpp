#include "bench/compare/pareto_front.h"

#include <algorithm>

namespace gnomon::bench {

std::vector<std::uint8_t> on_front(std::span<const ErrorAndCost> choices) {
    std::vector<std::uint8_t> best;
    for (const ErrorAndCost& one : choices)
        best.push_back(std::none_of(choices.begin(), choices.end(), [&](const ErrorAndCost& other) {
            if (other.error < one.error) return other.cost <= one.cost * (1.0 + kCostNoise);
            return other.error == one.error && other.cost < one.cost * (1.0 - kCostNoise);
        }));
    return best;
}

}  // namespace gnomon::bench
