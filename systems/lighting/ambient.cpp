#include "systems/lighting/ambient.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/aabb.h"
#include "systems/extract/light_facts.h"
#include "systems/lighting/picture_range.h"

namespace gnomon::lighting {
namespace {

/// Returns the median, the lower one for an even count. Reorders the values, at least one.
double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

double MidstFinder::middle_of(const SceneSnapshot& scene, int axis) {
    scratch_.clear();
    for (const InstanceItem& item : scene.instances)
        if (item.visible && !is_air(item)) scratch_.push_back(math::centre(item.bounds_ws)[axis]);
    return scratch_.empty() ? 0.0 : median(scratch_);
}

const Midst& MidstFinder::find(const SceneSnapshot& scene) {
    if (scene.version != 0 && scene.version == version_) return midst_;
    version_ = scene.version;
    midst_ = {};
    for (int axis = 0; axis < 3; ++axis) midst_.middle_ws_m[axis] = middle_of(scene, axis);
    scratch_.clear();
    for (const InstanceItem& item : scene.instances)
        if (item.visible && !is_air(item))
            scratch_.push_back(glm::distance(math::centre(item.bounds_ws), midst_.middle_ws_m) +
                               glm::length(math::half_extent(item.bounds_ws)));
    if (!scratch_.empty()) midst_.reach_m = median(scratch_);
    return midst_;
}

SceneLight scene_light(const SceneSnapshot& scene, const Midst& midst) {
    // A clear sky gives about a tenth of the sun's light, bluish.
    constexpr float kSkyShare = 0.1f;
    // Share of local lights' flux that returns from the scene. Walls around its midst reflect 30 % of what hits them
    // and spread it over their sphere. Their distance combines the scene's reach and the light's distance.
    constexpr double kReflected = 0.3;
    SceneLight sum;
    glm::dvec3 bounce_lux(0.0);
    for (const LightItem& light : scene.lights) {
        const LightFacts& facts = light_facts(light.kind);
        const double area_m2 = shown_area_m2(light);  // an area light's power is that of its brightest side
        const glm::dvec3 power = glm::dvec3(light.colour) * (static_cast<double>(light.intensity) * area_m2);
        const double strongest = std::max({power.r, power.g, power.b});
        if (facts.parallel) {
            sum.suns_lux += strongest;
            sum.sky_lux += light.colour * light.intensity * kSkyShare * glm::vec3(0.85f, 0.95f, 1.2f);
            continue;
        }
        const glm::dvec3 away_m = light.position_ws_m - midst.middle_ws_m;
        const double room_m2 = midst.reach_m * midst.reach_m + glm::dot(away_m, away_m);
        if (!(room_m2 > 0.0)) continue;  // nothing to light
        const double cone_share =
            facts.cone ? 0.5 * (1.0 - std::cos(static_cast<double>(light.outer_cone_rad))) : facts.flux_share;
        sum.lamps_lux += strongest / room_m2;
        bounce_lux += power * (kReflected * cone_share / room_m2);
    }
    sum.bounce_lux = glm::vec3(bounce_lux);
    return sum;
}

AmbientRecord ambient_for(const SceneLight& light, float per_radiance) {
    constexpr float kGroundShare = 0.2f;  // share of the sky's light that the ground returns
    const auto finite = [&](const glm::vec3& lux) {
        return glm::vec4(glm::min(lux * per_radiance, glm::vec3(kMostInPicture)), 0.0f);
    };
    return {finite(light.sky_lux + light.bounce_lux), finite(light.sky_lux * kGroundShare + light.bounce_lux)};
}

}  // namespace gnomon::lighting
