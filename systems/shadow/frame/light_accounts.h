#pragma once
#include <span>

#include "systems/shadow/frame/light_status.h"

namespace gnomon::shadow {

/// What every stage adds to, light by light.
struct LightAccounts {
    std::span<LightStatus> statuses;  // one per light
    std::span<double> cpu_us;         // one per light, microseconds; empty: nobody counts
};

}  // namespace gnomon::shadow
