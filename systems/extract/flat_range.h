#pragma once
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Range of a camera along its view, metres; near < far.
struct ViewRange {
    double near_m = 0.0, far_m = 0.0;
    bool operator==(const ViewRange&) const = default;
};

/// Computes the part of an orthographic camera's range with anything visible; the whole range if there is nothing.
/// Depths of such a view are spread evenly over its range. Over kilometres of empty space a float's steps are wider
/// than the objects, as is the error of reconstructed positions. The range ends on steps of an eighth of its content or
/// less, so that small movements change nothing.
ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& orthographic_camera);
/// Computes the same with the caller's scratch memory, to avoid allocation per frame.
ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& orthographic_camera,
                     std::vector<glm::dvec3>& corners_ws_m);

}  // namespace gnomon
