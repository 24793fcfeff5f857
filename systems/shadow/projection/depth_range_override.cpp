#include "systems/shadow/projection/depth_range_override.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

bool is_range(const ShadowTuning::Projection& tuning) {
    const auto usable = [](float end_m) { return end_m >= 0.0f && std::isfinite(end_m); };
    if (!usable(tuning.near_m) || !usable(tuning.far_m)) return false;
    return tuning.near_m == 0.0f || tuning.far_m == 0.0f || tuning.near_m < tuning.far_m;
}

void override_range(const ShadowDemand& demand, double& near_m, double& far_m) {
    if (demand.near_m > 0.0) near_m = demand.near_m;
    if (demand.far_m > 0.0) far_m = demand.far_m;
    if (near_m < far_m) return;
    if (demand.far_m > 0.0)
        near_m = 0.5 * demand.far_m;
    else if (demand.near_m > 0.0)
        far_m = 2.0 * demand.near_m;
}

PerspectiveRange overridden(const ShadowDemand& demand, PerspectiveRange fitted) {
    if (!(fitted.near_m < fitted.far_m)) return fitted;
    override_range(demand, fitted.near_m, fitted.far_m);
    fitted.near_m = std::max(fitted.near_m, fitted.far_m * kLeastNear);
    return fitted;
}

}  // namespace gnomon::shadow
