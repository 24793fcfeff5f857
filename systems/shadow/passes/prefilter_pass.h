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

/// Recorder of the passes that make prefiltered maps from depth maps. There are two passes per view, one without a
/// blur, and mipmaps where the settings have them. Programs are made on first use.
class PrefilterPass {
public:
    explicit PrefilterPass(gl::Device& device) : device_(device), records_(device, "shadow moment records") {}
    ~PrefilterPass();
    PrefilterPass(const PrefilterPass&) = delete;
    PrefilterPass& operator=(const PrefilterPass&) = delete;

    /// Makes programs and buffers for the prefiltered maps to be made in this frame. A light loses these maps if its
    /// programs fail, and all of its maps if the buffer fails. Call before record().
    void prepare(const PassInputs& in, const LightAccounts& accounts);

    /// Records the passes. Call after the depth passes were recorded.
    void record(const PassInputs& in, const PassOutputs& out);

    /// What a pass reads: a depth map of this projection, or the first pass's result.
    enum class Source : std::uint8_t { orthographic, perspective, cube, scratch };
    /// Returns the program, compiling it if needed; {0}: unavailable. `filter_file` is empty for Source::scratch.
    gl::ProgramHandle program(std::string_view filter_file, Source source);

private:
    struct Program {
        std::string_view filter_file;  // empty for the second pass
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
