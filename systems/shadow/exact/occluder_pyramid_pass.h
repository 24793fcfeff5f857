#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"
#include "systems/shadow/request/occluder_pyramid.h"

namespace gnomon::shadow {

/// Matches EndsBlock in shaders/shadow/passes/bounds/occluder_pyramid.comp (std140).
struct PyramidRecord {
    glm::vec4 axis_u{0.0f}, axis_v{0.0f}, axis_back{0.0f};
    glm::ivec4 from{0}, to{0};
    glm::vec4 numbers{0.0f};
};
static_assert(sizeof(PyramidRecord) == 96);

/// Recorder of the occluder pyramid, for views with BoundsMaps::ends. It runs after the BoundsPass's pass, with one
/// dispatch per level. Programs and buffers are made on first use.
class OccluderPyramidPass {
public:
    /// Sets the device. `with_margins`: as BoundsPass::Options.
    explicit OccluderPyramidPass(gl::Device& device, bool with_margins = true);
    ~OccluderPyramidPass();
    OccluderPyramidPass(const OccluderPyramidPass&) = delete;
    OccluderPyramidPass& operator=(const OccluderPyramidPass&) = delete;

    /// Makes programs and room for records. A light that cannot have them loses its maps. Call before record().
    void prepare(const PassInputs& in, const LightAccounts& accounts);
    /// Records the dispatches. Call after BoundsPass::record().
    void record(const PassInputs& in, const PassOutputs& out);

    /// Frees all except programs. Call it when no light has such views.
    void release() { records_.release(); }

private:
    enum class Source : std::uint8_t { map, cube, level, count };
    struct Program {
        gl::ProgramHandle program{};
        Retry retry;
    };
    static Source first_source(const ShadowView& view);
    bool program(Source source);
    void append_records(const DrawnViews& drawn, std::size_t view);
    void record_view(const PassInputs& in, std::size_t view, std::uint32_t& offset, gl::CommandList& list);

    gl::Device& device_;
    bool with_margins_;
    GrowingBuffer records_;
    Program programs_[static_cast<std::size_t>(Source::count)];
    std::uint64_t frame_ = 0;
    std::vector<std::byte> record_scratch_;
};

}  // namespace gnomon::shadow
