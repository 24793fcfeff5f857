#include "systems/lighting/jittered_camera.h"

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

}  // namespace gnomon::lighting
