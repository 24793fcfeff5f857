#pragma once
#include <span>
#include <utility>
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

    /// Stage 7, first half: one pass per view that is not reused, in order, or one for all such views of a light whose
    /// slots name a whole map; counts go to the report, times to frame.cpu_us.
    void record(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame, gl::CommandList& list,
                FrameReport& report);

private:
    struct DrawItem {
        std::uint32_t instance, layer;
    };
    /// Views [first, end) of one light that one pass draws (those of them that are drawn), and what they draw.
    struct Pass {
        std::size_t first = 0, end = 0;
        bool layered = false;
        std::uint32_t views = 0, uniform_offset = 0;
        IndexRange casters;  // into caster_scratch_, and into the items
    };
    bool program(CubeRoute route, bool masked);
    Reason ready(const SceneSnapshot& scene, const GpuScene& gpu, CubeRoute route,
                 std::span<const std::uint32_t> casters);
    void gather(const SceneSnapshot& scene, const ShadowFrame& frame);
    void gather_view(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t view);
    void gather_layers(const SceneSnapshot& scene, const ShadowFrame& frame, Pass& pass);
    void append_uniforms(const ShadowView& view, std::size_t at);
    void begin(const SceneSnapshot& scene, const ShadowFrame& frame, const Pass& pass, gl::CommandList& list) const;
    void draw(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const Pass& pass,
              gl::CommandList& list, LightReport& report);
    gl::PipelineState opaque_state(const GpuScene& gpu, const ShadowView& view, const LightItem& light,
                                   const InstanceItem& item) const;
    void draw_run(const GpuScene& gpu, std::uint32_t mesh, const gl::PipelineState& opaque, std::uint32_t count,
                  gl::CommandList& list, LightReport& report);

    gl::Device& device_;
    static constexpr std::size_t kPrograms = 6;  // three ways to choose the layer, opaque and masked
    gl::ProgramHandle programs_[kPrograms]{};
    Retry retries_[kPrograms];
    std::uint64_t frame_ = 0;
    GrowingBuffer items_, views_;
    std::vector<Pass> passes_;
    std::vector<std::uint32_t> caster_scratch_;  // indices into the scene's instances, one per item
    std::vector<DrawItem> item_scratch_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> layer_scratch_;  // instance, layer
    std::vector<std::byte> view_scratch_;
    std::uint32_t next_item_ = 0;
    gl::PipelineState pipeline_;               // of the pass being recorded
    CubeRoute route_ = CubeRoute::six_passes;  // of that pass
};

}  // namespace gnomon::shadow
