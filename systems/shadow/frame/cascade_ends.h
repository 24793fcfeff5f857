#pragma once
#include <array>

#include "gnomon/light.h"

namespace gnomon::shadow {

/// View distances from `lowest` to `highest`, metres.
struct DepthSpan {
    double lowest = 0.0, highest = 0.0;
};

/// View distances at which cascades end, metres: cascade i reaches from [i] to [i + 1].
using CascadeSplitDistances = std::array<double, kMaxCascades + 1>;

}  // namespace gnomon::shadow
