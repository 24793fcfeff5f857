#include "systems/shadow/projection/depth_range_override.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

bool is_range(const ShadowTuning::Projection& tuning) {
    const auto usable = [](float end_m) { return end_m >= 0.0f && std::isfinite(end_m); };
    if (!usable(tuning.near_m) || !usable(tuning.far_m)) return false;
    return tuning.near_m == 0.0f || tuning.far_m == 0.0f || tuning.near_m < tuning.far_m;
}

void override_range(const ProjectionRequest& projection, double& near_m, double& far_m) {
    if (projection.near_m > 0.0) near_m = projection.near_m;
    if (projection.far_m > 0.0) far_m = projection.far_m;
    if (near_m < far_m) return;
    if (projection.far_m > 0.0)
        near_m = 0.5 * projection.far_m;
    else if (projection.near_m > 0.0)
        far_m = 2.0 * projection.near_m;
}

PerspectiveRange overridden(const ProjectionRequest& projection, PerspectiveRange fitted) {
    if (!(fitted.near_m < fitted.far_m)) return fitted;
    override_range(projection, fitted.near_m, fitted.far_m);
    fitted.near_m = std::max(fitted.near_m, fitted.far_m * kLeastNear);
    return fitted;
}

}  // namespace gnomon::shadow
