#pragma once
#include <string>
#include <vector>

#include "engine/gl/device.h"
#include "systems/debug/debug_view.h"
#include "systems/extract/gpu_scene.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"

namespace gnomon::lighting {
class LightingSystem;
}

namespace gnomon::debug {

/// Draws debug views. Makes its device objects with the first request, and owns them.
class DebugPainter {
public:
    explicit DebugPainter(gl::Device& device)
        : device_(device), block_(device, "debug view"), lines_(device, "debug lines") {}
    ~DebugPainter();
    DebugPainter(const DebugPainter&) = delete;
    DebugPainter& operator=(const DebugPainter&) = delete;

    /// Inputs of a view, and the picture to draw over.
    struct Subject {
        const SceneSnapshot& scene;
        const shadow::ShadowFrame& frame;
        const GpuScene& gpu;
        lighting::LightingSystem& picture;
        const ConsumerItem* fitted = nullptr;  // camera that shadows are fitted to, if it is not the picture's
    };

    /// Records the requested view over the picture, and stores its labels. Records nothing without a view, or if the
    /// device cannot make its objects.
    void record(const Request& request, const Subject& subject, gl::CommandList& list);

    /// Returns the labels of the last record().
    const std::vector<Label>& labels() const { return labels_; }

private:
    struct Program {
        std::string_view fragment;
        gl::ProgramHandle handle{};
        Retry retry = {};
    };
    gl::ProgramHandle program(std::string_view vertex, std::string_view fragment);
    bool record_flat(const Drawing& drawing, const ViewRow& row, const gl::Rect& area, gl::TargetHandle target,
                     gl::CommandList& list);
    bool record_lines(const Drawing& drawing, const ViewRow& row, const gl::Rect& area,
                      const lighting::LightingSystem& picture, gl::CommandList& list);
    bool record_medium(const Drawing& drawing, const ViewRow& row, const gl::Rect& area, const Subject& subject,
                       gl::CommandList& list);

    gl::Device& device_;
    GrowingBuffer block_, lines_;
    gl::SamplerHandle raw_{};
    std::vector<Program> programs_;
    std::vector<Label> labels_;
    std::uint64_t records_ = 0;  // clock of the retries
};

}  // namespace gnomon::debug
