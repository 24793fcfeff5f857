#pragma once
#include <cstddef>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "engine/gl/device.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"
#include "systems/shadow/request/prefilter_settings.h"

namespace gnomon::shadow {

/// Matches MomentBlock in shaders/shadow/passes/prefilter/prefilter_block.glsl (std140).
struct MomentRecord {
    glm::vec4 settings{0.0f};
    glm::vec4 range{0.0f};
    glm::ivec4 place{0};
    glm::vec4 axis_u{0.0f}, axis_v{0.0f}, axis_back{0.0f};
    glm::vec4 weights[kMomentWeights / 4];
};
static_assert(sizeof(MomentRecord) == std::size_t{6} * 16 + kMomentWeights * 4);

/// Describes how a view of a map with these settings is made. `faces`: a bit per face of a cube that is drawn.
MomentRecord moment_record(const MapSettings& map, const ShadowView& view, std::int32_t faces);

/// Makes prefiltered maps of depth maps: two passes per view, one if nothing is blurred; mipmaps if asked for. Programs
/// are made when first called for.
class MomentRecorder {
public:
    explicit MomentRecorder(gl::Device& device) : device_(device), records_(device, "shadow moment records") {}
    ~MomentRecorder();
    MomentRecorder(const MomentRecorder&) = delete;
    MomentRecorder& operator=(const MomentRecorder&) = delete;

    /// Makes programs and buffers for the prefiltered maps that are made anew. A light that cannot have the programs
    /// loses these maps, one that cannot have the buffer all of its maps. Call before record().
    void prepare(const PassInputs& in, const LightAccounts& accounts);

    /// Records the passes, after those that draw the depths.
    void record(const PassInputs& in, const PassOutputs& out);

    /// What a pass reads: a depth map of this projection, or what the first pass left.
    enum class Source : std::uint8_t { orthographic, perspective, cube, scratch };
    /// {0}: not to be had. Of Source::scratch the filter is empty.
    gl::ProgramHandle program(std::string_view filter_file, Source source);

private:
    struct Program {
        std::string_view filter_file;  // of the second pass: none
        Source source = Source::scratch;
        gl::ProgramHandle program{};
        Retry retry;
    };
    static Source source_of(const ShadowView& view);
    bool ready(const DrawnViews& drawn, std::size_t view);
    void record_view(const PassInputs& in, std::size_t view, std::uint32_t offset, gl::CommandList& list);

    gl::Device& device_;
    GrowingBuffer records_;
    std::vector<Program> programs_;
    std::vector<std::byte> record_scratch_;
    std::uint64_t frame_ = 0;
};

}  // namespace gnomon::shadow
