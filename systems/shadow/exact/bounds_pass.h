#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/exact/bounds_items.h"
#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"

namespace gnomon::shadow {

/// Recorder of the last pass of views with BoundsMaps::bounds (docs/explanation/exact_proof.md). Per texel, it finds
/// the nearest place where a surface may end. It also finds a bound on the difference between a surface's depths and
/// that in the texel's middle. The DepthPass draws the first two passes, nearest and second depths. Programs, surfaces
/// and buffers are made on first use.
class BoundsPass {
public:
    /// Options for tests: without margins, to show that they are needed; with quads alone, to show that points cover
    /// the same.
    struct Options {
        bool with_margins = true, with_points = true;
    };
    explicit BoundsPass(gl::Device& device) : BoundsPass(device, Options{}) {}
    BoundsPass(gl::Device& device, const Options& options);
    ~BoundsPass();
    BoundsPass(const BoundsPass&) = delete;
    BoundsPass& operator=(const BoundsPass&) = delete;

    /// Gathers what drawn views need, and makes room for it. A light that cannot have it loses its maps. Call before
    /// record(), once the meshes are bent (GpuScene::update).
    void prepare(const PassInputs& in, const LightAccounts& accounts);
    void record(const PassInputs& in, const PassOutputs& out);

    /// Frees all except programs. Call it when no light has such views.
    void release();

    std::uint64_t bytes() const { return items_.bytes() + view_records_.bytes(); }
    std::uint64_t host_bytes() const { return surfaces_.bytes(); }

private:
    /// Number of programs: one per BoundsItems::Kind for large items, then one for small items.
    static constexpr std::size_t kPrograms = 2 * std::size_t{BoundsItems::kinds};
    struct View {
        std::size_t view = 0;
        std::uint32_t first[kPrograms] = {}, count[kPrograms] = {};  // items
    };
    struct Program {
        gl::ProgramHandle program{};
        Retry retry;
    };
    bool program(std::size_t which);
    bool programs_ready(const View& view);
    View gather(const PassInputs& in, std::size_t view);
    void record_view(const PassInputs& in, const View& view, std::uint32_t offset, gl::CommandList& list,
                     LightReport& report);

    gl::Device& device_;
    bool with_margins_;
    CasterTopologies surfaces_;
    BoundsGatherer gatherer_;
    GrowingBuffer items_, view_records_;
    Program programs_[kPrograms];
    std::uint64_t frame_ = 0;
    // One frame's; storage is reused.
    std::vector<View> views_;
    std::vector<BoundsItem> item_scratch_;
    BoundsItems view_scratch_;
    std::vector<std::byte> record_scratch_;
};

}  // namespace gnomon::shadow
