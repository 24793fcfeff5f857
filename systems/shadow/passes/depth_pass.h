#pragma once
#include <span>
#include <utility>
#include <vector>

#include "engine/gl/device.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/frame/engine_draw.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"

namespace gnomon::shadow {

/// Recorder of depth passes, and what they need on the device. Programs are made on first use.
class DepthPass {
public:
    explicit DepthPass(gl::Device& device);
    ~DepthPass();
    DepthPass(const DepthPass&) = delete;
    DepthPass& operator=(const DepthPass&) = delete;

    /// Makes programs and buffers for the views that are drawn. A light with views that cannot be drawn loses its maps.
    /// Call before record().
    void prepare(const PassInputs& in, const LightAccounts& accounts);

    /// Records the depth passes in order (stage 7, first half). There is one pass per drawn view, or one for all views
    /// of a light with plans that name a whole map.
    void record(const PassInputs& in, const PassOutputs& out);

    /// Returns the draws of the last record() that the engine makes before its list.
    std::span<const EngineDraw> engine_draws() const { return engine_draws_; }

private:
    struct DrawItem {
        std::uint32_t instance;
        std::uint32_t place;  // layer, and above its three bits the first triangle of the draw
    };
    /// Variant of the depth program that a pass uses; each exists for opaque and for masked casters.
    struct DepthVariant {
        CubeRoute route = CubeRoute::six_passes;
        bool triangles = false;  // writes which triangle each texel shows
        bool sheets = false;     // conservative map: no masked casters, and both faces
        bool peel = false;       // second depths: triangles behind the first ones
        bool coloured = false;   // the scene's vertices have colours, with an alpha that counts in masks
    };
    /// Static casters, or moving ones: never both in one draw.
    struct Group {
        IndexRange casters;            // into caster_scratch_ and layer_scratch_
        std::uint32_t first_item = 0;  // an item per caster; with triangles, one per caster and draw of its mesh
    };
    /// Views [first, end) of one light that one pass draws (if they are drawn), and what they draw.
    struct Pass {
        std::size_t first = 0, end = 0;
        bool layered = false;
        std::uint32_t views = 0, uniform_offset = 0;
        Group still, moving;
    };
    /// Instances of one mesh that are drawn alike.
    struct MeshRun {
        std::uint32_t mesh, first_item, count;
        std::uint32_t items_per_draw;  // between the items of one draw and those of the next
    };
    static std::size_t which(const DepthVariant& way, bool masked);
    DepthVariant variant_of(const PassInputs& in, std::size_t v) const;
    bool is_layered(const PassInputs& in, std::size_t v) const;
    bool program(const DepthVariant& way, bool masked);
    Reason ready(const PassInputs& in, const DepthVariant& way, std::span<const std::uint32_t> casters);
    std::size_t item_count(const PassInputs& in, std::size_t v) const;
    void gather(const PassInputs& in);
    void append_items(const PassInputs& in, bool triangles, Group& group);
    void gather_uniforms(const DrawnViews& drawn, Pass& pass);
    Group gather_view(const SceneSnapshot& scene, std::span<const std::uint32_t> casters);
    Group gather_layers(const PassInputs& in, const Pass& pass, bool moving);
    void append_uniforms(const ShadowView& view, std::size_t at);
    void begin(const PassInputs& in, const Pass& pass, gl::CommandList& list);
    void list_engine_draws(const PassInputs& in, const Pass& pass, LightReport& report);
    void begin_pass(const PassInputs& in, const Pass& pass, bool clear, gl::CommandList& list);
    gl::BindMeshes meshes_of(const GpuScene& gpu, const EngineMesh* engine) const;
    void begin_pass_into(gl::TargetHandle target, const PassInputs& in, const Pass& pass, bool clear,
                         gl::CommandList& list);
    void draw(const PassInputs& in, const Pass& pass, const DepthVariant& way, const Group& group,
              gl::CommandList& list, LightReport& report);
    void peel(const PassInputs& in, const Pass& pass, gl::CommandList& list, LightReport& report);
    gl::PipelineState opaque_state(const GpuScene& gpu, const ShadowView& view, const LightItem& light,
                                   const InstanceItem& item) const;
    void draw_run(const GpuScene& gpu, const MeshRun& meshes, const gl::PipelineState& opaque, gl::CommandList& list,
                  LightReport& report);

    /// Room for the uniforms of all faces of a cube, by face.
    static constexpr std::size_t kFaces = 6;
    /// Bits of DrawItem::place for the layer.
    static constexpr std::uint32_t kLayerBits = 3;
    /// First triangle of draws with unknown triangles; twin in shaders/shadow/passes/depth/shown_triangle.glsl.
    static constexpr std::uint32_t kNoTriangle = ~0u >> kLayerBits;

    gl::Device& device_;
    /// Number of programs. Plain ones: three routes, opaque or masked, with or without triangles, and the peeling one.
    /// The others: masked with colours, by the same routes.
    static constexpr std::size_t kPlainPrograms = 13, kPrograms = 25;
    gl::ProgramHandle programs_[kPrograms]{};
    Retry retries_[kPrograms];
    std::uint64_t frame_ = 0;
    GrowingBuffer items_, views_;
    std::vector<std::uint32_t> separate_;  // lights without a layered program, by rising index
    std::vector<Pass> passes_;
    std::vector<std::uint32_t> caster_scratch_;  // indices into the scene's instances, one per item
    std::vector<DrawItem> item_scratch_;
    std::vector<std::uint32_t> layer_scratch_;                           // one per caster_scratch_
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pair_scratch_;  // instance, layer
    std::vector<std::byte> view_scratch_;
    std::vector<EngineDraw> engine_draws_;
    gl::PipelineState pipeline_;  // state of the pass being recorded
    gl::BindMeshes bound_;        // meshes bound in that pass
    DepthVariant variant_;        // variant of that pass
};

}  // namespace gnomon::shadow
