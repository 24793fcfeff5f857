#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/assets.h"
#include "gnomon/frame.h"
#include "gnomon/registry.h"
#include "gnomon/result.h"
#include "systems/debug/debug_view.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/frame/shadow_settings.h"
#include "systems/timed_lights.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

class Jobs;

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
namespace picture {
class EdgeSmoothing;
class PictureChanges;
class PictureSamples;
}  // namespace picture

/// Sequence of a frame as a list of calls: transforms, snapshot, shadows, lighting, submit. What gnomon::Frame is made
/// of, on any device, and with all that it decided in view.
class FrameSystem {
public:
    /// Creates a frame. `device` and `library` must outlive it. Between frames meshes may come to the library and go
    /// (MeshLibrary::add(), replace(), remove()). `fit_history`: of the frame to continue after a lost
    /// context; pictures then continue bit for bit. `jobs`: threads that share many lights, and outlive the frame;
    /// null: the calling one does all. Errors: "gpu.scene".
    static Result<std::unique_ptr<FrameSystem>> create(gl::Device& device, const assets::MeshLibrary& library,
                                                       const shadow::History& fit_history = {}, Jobs* jobs = nullptr);
    ~FrameSystem();

    /// Runs one frame of `world` for its first active camera. Never throws; failures are in report(). Reads the world's
    /// changes with its own cursors, independent of other readers.
    void run(ecs::Registry& world, const FrameSettings& settings);

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const FrameReport& report() const { return report_; }
    const gl::CommandList& commands() const { return commands_; }  // last frame
    /// Returns the fit history of all lights. It needs no device and outlives one.
    const shadow::History& fit_history() const;
    /// Returns what lighting measured for the shadows of the next frame.
    const shadow::LightingFeedback& feedback() const { return feedback_; }

    /// Reads the last frame's picture: viewport_px, 4 bytes sRGB per pixel, top row first. Returns false if there is
    /// none.
    bool read_picture(std::vector<std::uint8_t>& rgba);

    /// Returns the target of read_picture(): draw overlays into it after run(), in a list of your own. {0}: no picture
    /// was drawn.
    gl::TargetHandle picture_target() const;
    gl::TextureHandle picture_texture() const;  // its texture

    /// Returns the labels of the last frame's debug view; empty without one.
    const std::vector<debug::Label>& debug_labels() const;

    /// Reads the visibility of light `light` (index into snapshot().lights) in the last frame: a float per pixel,
    /// bottom row first. 1: lit. 0: shadowed, facing away or out of range. -1: no surface. Returns false if there is
    /// none.
    bool read_visibility(std::uint32_t light, std::vector<float>& values);
    /// Reads the colour that translucent casters let through of light `light` to each pixel's surface, in the same
    /// order. 1: all, also where there is no surface. Returns false if there is none.
    bool read_tint(std::uint32_t light, std::vector<glm::vec4>& values);

private:
    FrameSystem(gl::Device& device, const assets::MeshLibrary& library, const shadow::History& fit_history, Jobs* jobs,
                GpuScene scene);
    std::optional<double> most_exposure(const FrameSettings& settings);
    const shadow::ShadowFrame& update_shadows(const FrameSettings& settings);
    bool record_picture(const shadow::ShadowFrame& shadows, const FrameSettings& settings, bool frozen);
    void finish_picture(const shadow::ShadowFrame& shadows, const FrameSettings& settings);

    gl::Device& device_;
    const assets::MeshLibrary& library_;
    TransformSystem transforms_;
    Extractor extractor_;
    GpuScene gpu_scene_;
    SceneSnapshot snapshot_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    std::unique_ptr<lighting::LightingSystem> lighting_;
    std::unique_ptr<picture::PictureChanges> changes_;
    std::unique_ptr<picture::PictureSamples> samples_;
    std::unique_ptr<picture::EdgeSmoothing> smoothing_;
    std::unique_ptr<debug::DebugPainter> debug_;
    std::optional<std::vector<ConsumerItem>> frozen_;  // cameras that shadows are fitted to
    std::vector<ConsumerItem> pictures_;               // drawing cameras meanwhile
    shadow::LightingFeedback feedback_;                // result of earlier frames, input of the next one
    shadow::LightingOutcome outcome_;                  // what became of lights in this frame's pictures
    TimedLights timed_lights_;
    FrameReport report_;
    gl::CommandList commands_;
    std::vector<shadow::LookupFailure> shown_failures_;  // its lights' failures
    bool has_picture_ = false;
};

}  // namespace gnomon
