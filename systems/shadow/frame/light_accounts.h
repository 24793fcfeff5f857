#pragma once
#include <span>

#include "systems/shadow/frame/light_status.h"

namespace gnomon::shadow {

/// Status and CPU time per light, to which every stage adds.
struct LightAccounts {
    std::span<LightStatus> statuses;  // one per light
    std::span<double> cpu_us;         // one per light, microseconds; empty: lights are not timed
};

}  // namespace gnomon::shadow
