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

/// For views with BoundsMaps::bounds the last of their passes: per texel the nearest place where a sheet may end, and
/// by how much a sheet may depart from its depth in the texel's middle (docs/exact.md). The first two, nearest and
/// second depths, are the DepthRecorder's. Programs, surfaces and buffers are made when first called for.
class SheetRecorder {
public:
    /// For tests: without margins, to show that they are needed; with quads alone, to show that points cover the same.
    struct Options {
        bool with_margins = true, with_points = true;
    };
    explicit SheetRecorder(gl::Device& device) : SheetRecorder(device, Options{}) {}
    SheetRecorder(gl::Device& device, const Options& options);
    ~SheetRecorder();
    SheetRecorder(const SheetRecorder&) = delete;
    SheetRecorder& operator=(const SheetRecorder&) = delete;

    /// Finds what views that are drawn need, and makes room for it. A light that cannot have it loses its maps. Call
    /// before record(), once the meshes are bent (GpuScene::update).
    void prepare(const PassInputs& in, const LightAccounts& accounts);
    void record(const PassInputs& in, const PassOutputs& out);

    /// No light has such views any more: frees all but programs.
    void release();

    std::uint64_t bytes() const { return items_.bytes() + view_records_.bytes(); }
    std::uint64_t host_bytes() const { return surfaces_.bytes(); }

private:
    /// By SheetItems::Kind, first the large ones, then the small ones.
    static constexpr std::size_t kPrograms = 2 * std::size_t{SheetItems::kinds};
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
    CasterSurfaces surfaces_;
    SheetGatherer gatherer_;
    GrowingBuffer items_, view_records_;
    Program programs_[kPrograms];
    std::uint64_t frame_ = 0;
    // One frame's; storage is reused.
    std::vector<View> views_;
    std::vector<SheetItem> item_scratch_;
    SheetItems view_scratch_;
    std::vector<std::byte> record_scratch_;
};

}  // namespace gnomon::shadow
