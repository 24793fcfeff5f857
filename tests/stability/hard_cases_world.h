#pragma once
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "engine/gl/device_recording.h"
#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "gnomon/registry.h"
#include "sample_game/support/built_in_scenes/primitives.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"

namespace gnomon::hard {

inline const glm::dvec3 kDown{0.0, -1.0, 0.0}, kOrigin{0.0}, kSlant{0.4, -1.0, 0.3};

/// Entities of a hard case. Every length is multiplied by `scale`, then every place moved by `offset_m`: set both
/// first.
struct World {
    ecs::Registry registry;
    assets::MeshLibrary library;
    glm::uvec2 viewport_px{320, 180};
    double scale = 1.0;
    glm::dvec3 offset_m{0.0};
    std::vector<std::string> settings;  // KEY=VALUE, for every light that is made after

    World();
    std::uint32_t mesh(const game::Shape& shape, std::uint32_t material = 0);
    /// Adds the mesh of these triangles, each of three corners in a row.
    std::uint32_t triangles(const std::vector<glm::vec3>& corners);
    ecs::Entity place(std::uint32_t mesh, const Transform& transform = {}, bool casts = true);
    ecs::Entity box(const glm::dvec3& min, const glm::dvec3& max, const Transform& transform = {});
    /// Adds two triangles at height y = 0 of `at`, facing up. They cast nothing.
    ecs::Entity ground(double half_m, const glm::dvec3& at = kOrigin);

    ecs::Entity light(const Light& light, const glm::dvec3& at, const glm::dvec3& direction, const LightShadow& = {},
                      const ShadowTuning& = {});
    ecs::Entity sun(const glm::dvec3& direction, const LightShadow& shadow = {}, const ShadowTuning& tuning = {});
    ecs::Entity lamp(const glm::dvec3& at, double range_m = 0.0, const LightShadow& shadow = {},
                     const ShadowTuning& tuning = {});
    ecs::Entity spot(const glm::dvec3& at, const glm::dvec3& direction, double outer_rad, const LightShadow& = {});
    /// Adds a sun, a lamp and a spot above the origin.
    void three_lights();

    ecs::Entity camera(const glm::dvec3& at, const glm::dvec3& target, const Camera& camera = {});
    /// Adds a camera that looks at the origin from above and aside.
    ecs::Entity camera() { return camera({5.0, 6.0, 8.0}, kOrigin); }
    void move(ecs::Entity entity, const Transform& unscaled);
    Transform placed(Transform unscaled) const;
    /// Moves and turns every camera a little, as in one frame of a walk.
    void nudge_cameras();
};

glm::dquat looking_along(const glm::dvec3& direction);

/// The stages of a frame from the registry to the recorded depth passes, on a device that draws nothing.
class Stages {
public:
    explicit Stages(World& world);
    ~Stages();
    void run();

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const shadow::ShadowFrame& frame() const { return shadows_->frame(); }
    const FrameReport& report() const { return report_; }
    const gl::CommandList& commands() const { return commands_; }
    const gl::RecordingDevice& device() const { return device_; }
    const assets::MeshLibrary& library() const { return world_.library; }
    /// Returns the views of a light of the snapshot.
    std::vector<const shadow::ShadowView*> views(std::uint32_t light = 0) const;
    /// Counts the depth passes that this frame drew.
    std::size_t passes() const;

private:
    World& world_;
    gl::RecordingDevice device_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    std::unique_ptr<GpuScene> gpu_scene_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    FrameReport report_;
    gl::CommandList commands_;
};

}  // namespace gnomon::hard
