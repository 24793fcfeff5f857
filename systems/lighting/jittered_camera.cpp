#include "systems/lighting/jittered_camera.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/volumes.h"

namespace gnomon::lighting {

shadow::CameraRecord jittered(const shadow::CameraRecord& camera, const glm::dvec2& jitter_px) {
    shadow::CameraRecord record = camera;
    for (int axis = 0; axis < 2; ++axis) {
        const auto shift = static_cast<float>(2.0 * jitter_px[axis] / camera.unproject[2 + axis]);
        record.lens[axis] += shift;
        for (int column = 0; column < 4; ++column)
            record.clip_from_anchor[column][axis] -= shift * record.clip_from_anchor[column][3];
    }
    return record;
}

math::Frustum jittered_frustum(const ConsumerItem& consumer) {
    const double growth = 1.0 + 2.0 / static_cast<double>(std::min(consumer.viewport_px.x, consumer.viewport_px.y));
    ConsumerItem wider;  // without the name, which owns memory
    wider.position_ws_m = consumer.position_ws_m;
    wider.rotation_ws = consumer.rotation_ws;
    wider.projection = consumer.projection;
    wider.fov_y_rad = 2.0 * std::atan(growth * std::tan(0.5 * consumer.fov_y_rad));
    wider.half_height_m = growth * consumer.half_height_m;
    wider.near_m = consumer.near_m;
    wider.far_m = consumer.far_m;
    wider.viewport_px = consumer.viewport_px;
    return consumer_frustum(wider);
}

}  // namespace gnomon::lighting
