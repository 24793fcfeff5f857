#include "systems/extract/placed_light.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "systems/extract/camera_view.h"

namespace gnomon {

LightItem placed(const Light& light, const WorldTransform& world) {
    LightItem item;
    item.kind = light.kind;
    item.position_ws_m = world.translation_ws_m;
    item.rotation_ws = orientation(world.basis);
    item.range_m = light.range_m;
    item.inner_cone_rad = light.inner_cone_rad;
    item.outer_cone_rad = std::min(static_cast<double>(light.outer_cone_rad), glm::half_pi<double>());
    item.source_radius_m = light.source_radius_m;
    item.sun_radius_rad = light.sun_radius_rad;
    item.width_m = light.width_m;
    item.height_m = light.height_m;
    return item;
}

}  // namespace gnomon
