#pragma once
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// From where to where along its view a camera looks, metres; near < far.
struct ViewRange {
    double near_m = 0.0, far_m = 0.0;
    bool operator==(const ViewRange&) const = default;
};

/// The part of an orthographic camera's range in which something stands that it may see; all of it where nothing does.
/// Such a view spreads its depths evenly over its range: over kilometres of nothing a float's steps are wider than what
/// stands there, and places rebuilt from them as far off. The range ends on steps of an eighth of what it holds, or
/// less, so that what moves a little changes nothing.
ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& orthographic_camera);
/// The same in memory that the caller keeps, for every frame; its content is of no use.
ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& orthographic_camera,
                     std::vector<glm::dvec3>& corners_ws_m);

}  // namespace gnomon
