#pragma once
#include <array>
#include <functional>
#include <memory>

#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/lighting/lighting_system.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

/// One world with shadows that are worked out twice in each frame: as usual, and with economy=off. Each way has maps, a
/// history and lighting of its own. Everything else is common to both.
class BothWays {
public:
    enum DepthVariant : std::size_t { kThrifty, kLavish, kWays };

    BothWays(gl::Device& device, const assets::MeshLibrary& library);

    /// What to look at after each submission. For every consumer in turn, first of one way, then of the other.
    struct Picture {
        DepthVariant way;
        const shadow::LightingInputs& inputs;
        const gl::CommandList& commands;  // as submitted: the first of a way holds its depth passes
    };
    void run(ecs::Registry& world, glm::uvec2 viewport_px, const std::function<void(const Picture&)>& look);

    /// Makes the thrifty way believe something else, to see that it would be noticed.
    std::function<void(SceneSnapshot&)> mislead;

    const SceneSnapshot& scene() const { return snapshot_; }
    const FrameReport& report(DepthVariant way) const { return sides_[way]->report; }
    const shadow::ShadowFrame& frame(DepthVariant way) const { return sides_[way]->shadows.frame(); }
    lighting::LightingSystem& lighting(DepthVariant way) { return sides_[way]->lighting; }
    const GpuScene& gpu() const { return *gpu_; }

private:
    struct Side {
        explicit Side(gl::Device& device) : shadows(device), lighting(device) {}
        shadow::ShadowSystem shadows;
        lighting::LightingSystem lighting;
        SceneSnapshot scene;
        FrameReport report;
        gl::CommandList commands;
    };
    void run_side(DepthVariant way, const std::function<void(const Picture&)>& look);

    gl::Device& device_;
    const assets::MeshLibrary& library_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    std::unique_ptr<GpuScene> gpu_;
    std::array<std::unique_ptr<Side>, kWays> sides_;
};

}  // namespace gnomon
