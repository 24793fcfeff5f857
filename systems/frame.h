#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/core/result.h"
#include "engine/ecs/registry.h"
#include "engine/gl/device.h"
#include "systems/debug/debug_view.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/timed_lights.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

namespace shadow {
class ShadowSystem;
struct ShadowFrame;
}  // namespace shadow
namespace debug {
class DebugPainter;
}
namespace lighting {
class LightingSystem;
}

struct FrameSettings {
    glm::uvec2 viewport_px{1280, 720};
    std::optional<float> exposure_ev;  // EV100; empty: automatic
    bool shadows = true;               // false: every light is treated as if its LightShadow were disabled
    bool present = false;              // copy the picture to the window at the end
    /// Wait at the end of a frame for what the GPU measures in it (CascadeSplits::sampled; automatic exposure, where
    /// lights are faint), so that every run draws the same pictures; else nothing is waited for, and measures arrive
    /// some frames later.
    bool repeatable = false;
    debug::Request debug = {};  // drawn over the picture; none by default
    /// Shadows stay fitted to the cameras as they were in the first frame that asked for it, while the picture follows
    /// its own. Lights and casters go on: shadows follow them, as those cameras need it.
    bool freeze_fits = false;
    /// What shadows may take; those that are seen least are given less until it holds (docs/economy.md, "Budgets").
    shadow::ShadowBudget shadow_budget = {};
    /// Lights whose shadows could not be seen in the picture cast none (docs/economy.md).
    bool leave_out_dim_lights = true;
    /// So many programs of lights are compiled in one frame at most. A light whose program has to wait is looked up
    /// with one tap meanwhile, and says so (filter_program_waits). The default waits for none.
    std::uint32_t programs_per_frame = ~0u;
};

/// The one way of a frame, as a list of calls: transforms, snapshot, shadows, lighting, submit.
/// Write your own instead if your engine has its own order: it is frame.cpp's run(), and nothing else hides here.
class Frame {
public:
    /// `device` and `library` must outlive the frame. `held_fits`: of the frame that this one goes on from, when its
    /// context was lost; the pictures then go on, too, to the bit. Errors: "gpu.scene".
    static Result<std::unique_ptr<Frame>> create(gl::Device& device, const assets::MeshLibrary& library,
                                                 const shadow::History& held_fits = {});
    ~Frame();

    /// Runs one frame of `world` for its first active camera. Never throws; failures are in report(). Reads the world's
    /// changes by cursors of its own: other readers find all of theirs.
    void run(ecs::Registry& world, const FrameSettings& settings);

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const FrameReport& report() const { return report_; }
    const gl::CommandList& commands() const { return commands_; }  // of the last frame
    /// What the lights' fits hold on to: it needs no device and survives one.
    const shadow::History& held_fits() const;

    /// The last frame's picture: viewport_px, 4 bytes sRGB per pixel, top row first. False: nothing to read.
    bool read_picture(std::vector<std::uint8_t>& rgba);

    /// What read_picture() reads: draw overlays into it, in a list of your own, after run(). {0}: no picture was drawn.
    gl::TargetHandle picture_target() const;

    /// What the debug view of the last frame has to say; empty without one.
    const std::vector<debug::Label>& debug_labels() const;

    /// Visibility of light `light` (index into snapshot().lights) in the last frame: viewport_px floats, bottom row
    /// first, with the meaning of --visibility in the README. False: nothing to read.
    bool read_visibility(std::uint32_t light, std::vector<float>& values);

private:
    Frame(gl::Device& device, const assets::MeshLibrary& library, const shadow::History& held_fits, GpuScene scene);
    std::optional<double> most_exposure(const FrameSettings& settings);
    const shadow::ShadowFrame& update_shadows(const FrameSettings& settings);
    void collect_timings(const std::vector<gl::Timing>& timings);

    gl::Device& device_;
    const assets::MeshLibrary& library_;
    TransformSystem transforms_;
    Extractor extractor_;
    GpuScene gpu_scene_;
    SceneSnapshot snapshot_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    std::unique_ptr<lighting::LightingSystem> lighting_;
    std::unique_ptr<debug::DebugPainter> debug_;
    std::optional<std::vector<ConsumerItem>> frozen_;  // the cameras that shadows are fitted to
    std::vector<ConsumerItem> pictures_;               // and those that draw, as they were
    TimedLights timed_lights_;
    FrameReport report_;
    gl::CommandList commands_;
    bool has_picture_ = false;
};

}  // namespace gnomon
