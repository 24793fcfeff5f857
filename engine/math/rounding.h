#pragma once
#include <cmath>

namespace gnomon::math {

/// Returns the smallest float of at least `number`, for positive numbers.
inline float at_least(double number) {
    const auto rounded = static_cast<float>(number);
    return static_cast<double>(rounded) < number ? std::nextafter(rounded, INFINITY) : rounded;
}

}  // namespace gnomon::math
