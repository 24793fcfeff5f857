#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "systems/extract/instances.h"
#include "systems/extract/lights_and_cameras.h"
#include "systems/extract/poses.h"
#include "systems/extract/snapshot.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

/// Applies the registry's change lists to a SceneSnapshot. It is the only reader of the registry between the transform
/// system and the picture. For another ECS, fill the snapshot yourself and leave this class out.
class Extractor {
public:
    /// Updates the snapshot. `viewport_px`: size of the picture, both > 0. Meshes are indices in `library`. The cost is
    /// proportional to the changes: written components are updated in place. Added or removed instances cost a look at
    /// each other one. A quarter of the scene at once is listed again, as are lights and cameras. An unchanged scene
    /// costs nothing. `lacking`: meshes that the device does not have (GpuScene::lacking_meshes()); their instances are
    /// dropped.
    void update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                glm::uvec2 viewport_px, SceneSnapshot& snapshot, std::span<const std::uint32_t> lacking = {});

private:
    struct Cursors {
        ecs::ChangeCursor world, mesh, caster, fog, light, shadow, tuning, camera, name, skin, weights;
    };
    /// Lists to rebuild.
    struct Lists {
        bool instances = false, views = false;  // views: lights and cameras
    };
    struct Touched {
        bool any = false;
        Lists leaves;
    };
    template <class T>
    bool read_changes(ecs::Registry& registry, ecs::ChangeCursor& cursor, std::vector<ecs::Entity>* written,
                      std::vector<ecs::Entity>* came_or_went);
    Lists read_all(ecs::Registry& registry);
    void list_views(const ecs::Registry& registry, const TransformReport& transforms, SceneSnapshot& snapshot);
    Touched touch(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);
    LightsAndCameras::Effect touch_views(const ecs::Registry& registry, SceneSnapshot& snapshot);

    Cursors cursors_;
    PoseExtractor poses_;
    LightsAndCameras views_;
    InstanceExtractor instances_;
    /// Changes since the last frame, possibly repeated: mesh, fog or place gained or lost; place or pose; visibility or
    /// casting; fog; lights and cameras; names.
    std::vector<ecs::Entity> came_, moved_, shown_, fogged_, edited_, named_;
    std::vector<QuarantinedEntity> quarantined_;  // as last seen
    std::vector<glm::dvec3> corners_ws_m_;        // scratch
    glm::uvec2 viewport_px_{0, 0};
    bool started_ = false;
};

}  // namespace gnomon
