#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "gnomon/shadows.h"
#include "systems/embed/layered_scene.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/shadow_system.h"
#include "systems/timed_lights.h"

namespace gnomon::embed {

/// Views that see the same casters and receivers: they share maps, and nothing with other groups.
struct ViewGroup {
    ViewGroup(gl::Device& device, Jobs* jobs, const ViewLayers& layers) : shadows(device, {}, jobs), layered(layers) {}
    /// Returns the scene of the last ViewGroups::arrange().
    const SceneSnapshot& scene() const { return *seen; }

    shadow::ShadowSystem shadows;
    LayeredScene layered;
    const SceneSnapshot* seen = nullptr;
    std::vector<ConsumerItem> consumers;
    std::vector<std::uint32_t> views;  // view of each consumer
    FrameReport report;
    shadow::LightingOutcome outcome;
    TimedLights timed;
    std::optional<double> gpu_us;  // time of all that was last measured
    std::uint32_t idle_frames = 0;
};

/// Groups of a frame's views. Owns them, and keeps them for some frames without views.
class ViewGroups {
public:
    /// Creates no group yet. `shares_layers`: maps are layers of shared arrays (ShadowSystem).
    ViewGroups(gl::Device& device, Jobs* jobs, bool shares_layers)
        : device_(device), jobs_(jobs), shares_layers_(shares_layers) {}

    /// Sorts the cameras into groups. `views` and `layers`: one per camera. Without cameras the group of all casters
    /// runs, so that lights have a status. `keeps_idle`: groups without views keep their maps for kIdleFrames.
    void arrange(const SceneSnapshot& whole, std::span<const std::uint32_t> views, std::span<const ViewLayers> layers,
                 bool keeps_idle);
    /// Returns the groups that run in this frame; at least one after arrange().
    std::span<ViewGroup* const> active() const { return active_; }

    /// Returns what became of a light over all active groups.
    LightStatus status(std::uint32_t light) const;

    /// Calls of arrange() over which a group without views keeps its maps and programs.
    static constexpr std::uint32_t kIdleFrames = 120;

private:
    ViewGroup& group_of(const ViewLayers& layers);

    gl::Device& device_;
    Jobs* jobs_;
    bool shares_layers_;
    std::vector<std::unique_ptr<ViewGroup>> groups_;
    std::vector<ViewGroup*> active_;
    LayersInUse in_use_;
};

}  // namespace gnomon::embed
