#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::bench {

/// Median and range of repeated measurements. A median alone hides noise.
struct Spread {
    double median = 0.0, min = 0.0, max = 0.0;
    std::size_t count = 0;  // 0: nothing was measured
};

inline Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
    return {median, values.front(), values.back(), values.size()};
}

}  // namespace gnomon::bench
