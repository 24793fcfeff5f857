#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/core.h"
#include "systems/extract/snapshot.h"

namespace gnomon::core {

/// Numbers of inputs that the stages cannot work with.
struct Unusable {
    std::uint32_t cameras = 0, boxes = 0;
};

/// The caller's scene as the snapshot that the stages read. Storage is reused.
class SceneInput {
public:
    /// Brings the snapshot up to date. Lights and boxes keep their indices; what is unusable has no shadow, or is
    /// nowhere. Unusable cameras are left out.
    void take(const Scene& scene);

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const Unusable& unusable() const { return unusable_; }
    bool is_unusable(std::size_t light) const { return unusable_lights_[light] != 0; }
    /// Turns a mask of the snapshot's cameras into one of the caller's.
    std::uint32_t camera_mask(std::uint32_t consumer_mask) const;

private:
    void take_boxes(std::span<const Box> boxes);
    void take_cameras(std::span<const Camera> cameras);
    void take_lights(std::span<const Light> lights);

    SceneSnapshot snapshot_;
    Unusable unusable_;
    std::vector<std::uint8_t> unusable_lights_;
    std::vector<std::uint32_t> cameras_;  // by consumer: index into Scene::cameras
    std::vector<glm::dvec3> corners_ws_m_;
};

}  // namespace gnomon::core
