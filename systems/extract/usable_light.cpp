#include "systems/extract/usable_light.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "systems/extract/light_facts.h"

namespace gnomon {

bool is_usable(const Light& light) {
    const bool numbers = std::isfinite(light.intensity) && light.intensity >= 0.0f && std::isfinite(light.range_m) &&
                         light.range_m >= 0.0f && light.colour.r >= 0.0f && light.colour.g >= 0.0f &&
                         light.colour.b >= 0.0f && std::isfinite(light.colour.r + light.colour.g + light.colour.b);
    // Shaders multiply both in float: an infinite product becomes NaN where no light arrives.
    if (!numbers || !std::isfinite(light.intensity * (light.colour.r + light.colour.g + light.colour.b))) return false;
    return !light_facts(light.kind).cone ||
           (light.outer_cone_rad > 0.0f && light.outer_cone_rad <= glm::half_pi<float>() * 1.000001f &&
            light.inner_cone_rad >= 0.0f && light.inner_cone_rad <= light.outer_cone_rad);
}

}  // namespace gnomon
