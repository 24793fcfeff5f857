#include "systems/extract/snapshot.h"

#include <algorithm>

namespace gnomon {

const PoseItem* pose_of(const SceneSnapshot& scene, std::uint32_t mesh) {
    const auto at = std::lower_bound(scene.poses.begin(), scene.poses.end(), mesh,
                                     [](const PoseItem& pose, std::uint32_t wanted) { return pose.mesh < wanted; });
    return at != scene.poses.end() && at->mesh == mesh ? &*at : nullptr;
}

}  // namespace gnomon
