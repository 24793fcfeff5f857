#pragma once
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/frame/engine_draw.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"
#include "systems/shadow/passes/depth_draws.h"

namespace gnomon::shadow {

/// Recorder of depth passes, and what they need on the device. Programs are made on first use.
class DepthPass {
public:
    explicit DepthPass(gl::Device& device);
    ~DepthPass();
    DepthPass(const DepthPass&) = delete;
    DepthPass& operator=(const DepthPass&) = delete;

    /// Makes programs and buffers for the views that are drawn, and gathers their draws. A light with views that cannot
    /// be drawn loses its maps. Call before record(), with the same inputs.
    void prepare(const PassInputs& in, const LightAccounts& accounts);

    /// Records the depth passes in order (stage 7, first half). There is one pass per drawn view, or one for all views
    /// of a light with plans that name a whole map.
    void record(const PassInputs& in, const PassOutputs& out);

    /// Returns the draws of the last record() that the engine makes before its list.
    std::span<const EngineDraw> engine_draws() const { return engine_draws_; }

private:
    /// Variant of the depth program that a pass uses; each exists for opaque and for masked casters.
    struct DepthVariant {
        CubeRoute route = CubeRoute::six_passes;
        bool triangles = false;  // writes which triangle each texel shows
        bool sheets = false;     // conservative map: no masked casters, and both faces
        bool peel = false;       // second depths: triangles behind the first ones
        bool coloured = false;   // the scene's vertices have colours, with an alpha that counts in masks
    };
    /// Views [first, end) of one light that one pass draws (if they are drawn), and what they draw: static casters
    /// before moving ones.
    struct Pass {
        std::size_t first = 0, end = 0;
        bool layered = false;
        std::uint32_t views = 0, uniform_offset = 0;
        IndexRange still, moving;  // batches of draws_; without triangles in the map and a copy, still has all
        std::uint64_t saved_triangles = 0;  // by proxies
    };
    static std::size_t which(const DepthVariant& way, bool masked);
    DepthVariant variant_of(const PassInputs& in, std::size_t v) const;
    bool is_layered(const PassInputs& in, std::size_t v) const;
    bool program(const DepthVariant& way, bool masked);
    Reason ready(const PassInputs& in, const DepthVariant& way, std::span<const std::uint32_t> casters);
    void gather(const PassInputs& in, const LightAccounts& accounts);
    void gather_casters(const PassInputs& in, Pass& pass);
    void end_group(Pass& pass, IndexRange& group);
    void gather_uniforms(const DrawnViews& drawn, Pass& pass);
    DepthDraws::Casters merge_layers(const PassInputs& in, const Pass& pass, bool moving);
    bool reserve_buffers();
    void append_uniforms(const ShadowView& view, std::uint32_t triangle_bits, std::size_t at);
    void begin(const PassInputs& in, const Pass& pass, gl::CommandList& list);
    void list_engine_draws(const PassInputs& in, const Pass& pass, LightReport& report);
    void begin_pass(const PassInputs& in, const Pass& pass, bool clear, gl::CommandList& list);
    gl::BindMeshes meshes_of(const GpuScene& gpu, const EngineMesh* engine) const;
    void begin_pass_into(gl::TargetHandle target, const PassInputs& in, const Pass& pass, bool clear,
                         gl::CommandList& list);
    void draw(const PassInputs& in, const Pass& pass, const DepthVariant& way, IndexRange batches,
              gl::CommandList& list, LightReport& report);
    void peel(const PassInputs& in, const Pass& pass, gl::CommandList& list, LightReport& report);
    void set_state(const PassInputs& in, const Pass& pass, const DepthVariant& way, const DepthDraws::Batch& batch,
                   gl::CommandList& list);

    /// Room for the uniforms of all faces of a cube, by face.
    static constexpr std::size_t kFaces = 6;

    gl::Device& device_;
    /// Number of programs. Plain ones: three routes, opaque or masked, with or without triangles, and the peeling one.
    /// The others: masked with colours, by the same routes.
    static constexpr std::size_t kPlainPrograms = 13, kPrograms = 25;
    gl::ProgramHandle programs_[kPrograms]{};
    Retry retries_[kPrograms];
    std::uint64_t frame_ = 0;
    GrowingBuffer items_, records_, views_;
    Retry records_retry_;
    bool wants_records_ = false;           // one command may make several of this frame's draws
    bool has_records_ = false;             // their records are to be uploaded
    std::vector<std::uint32_t> separate_;  // lights without a layered program, by rising index
    std::vector<Pass> passes_;
    DepthDraws draws_;
    std::vector<std::uint32_t> caster_scratch_, layer_scratch_, mesh_scratch_;  // one each per caster of a
                                                                                // layered pass
    std::vector<std::byte> view_scratch_;
    std::vector<EngineDraw> engine_draws_;
    gl::PipelineState pipeline_;  // state of the pass being recorded
    gl::BindMeshes bound_;        // meshes bound in that pass
};

}  // namespace gnomon::shadow
