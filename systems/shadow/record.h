#pragma once
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// What depth passes need on the device. Programs are made when first called for.
class DepthRecorder {
public:
    explicit DepthRecorder(gl::Device& device);
    ~DepthRecorder();
    DepthRecorder(const DepthRecorder&) = delete;
    DepthRecorder& operator=(const DepthRecorder&) = delete;

    /// Makes programs and buffers for the views that are not reused; a view that cannot be drawn loses its slot,
    /// its light's sets[i].skip says why. Call before record().
    void prepare(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame);

    /// Stage 7, first half: one pass per view that is not reused, in order; counts go to the report, times to
    /// frame.cpu_us.
    void record(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame, gl::CommandList& list,
                FrameReport& report);

private:
    struct DrawItem {
        std::uint32_t instance, first_triangle;
    };
    bool program(bool masked);
    Reason ready(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters);
    void draw_view(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const ShadowView& view,
                   gl::CommandList& list, LightReport& report);
    gl::PipelineState opaque_state(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowView& view,
                                   std::span<const std::uint32_t> run) const;
    void draw_run(const GpuScene& gpu, std::uint32_t mesh, const gl::PipelineState& opaque, std::uint32_t count,
                  gl::CommandList& list, LightReport& report);

    gl::Device& device_;
    gl::ProgramHandle programs_[2]{};  // opaque, masked
    Retry retries_[2];
    std::uint64_t frame_ = 0;
    GrowingBuffer items_, views_;
    std::vector<DrawItem> item_scratch_;
    std::vector<std::byte> view_scratch_;
    std::uint32_t next_item_ = 0;
    gl::PipelineState pipeline_;  // of the pass being recorded
};

}  // namespace gnomon::shadow
