#pragma once
#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/pass_inputs.h"
#include "systems/shadow/frame/tint_assignment.h"

namespace gnomon::shadow {

/// Matches TransmissionBlock in shaders/shadow/passes/tint/surface_transmittance.glsl (std140).
struct TransmissionRecord {
    glm::vec4 through{0.0f};  // rgb: Material::transmission; w: 1: alpha is the covered share
};

/// Recorder of the layers of translucent casters. A view has a pass per layer that finds its depths, a pass that
/// gathers them, and a pass that sums absorbances. Nothing exists on the device until a view has such casters.
class TintPass {
public:
    explicit TintPass(gl::Device& device);
    ~TintPass();
    TintPass(const TintPass&) = delete;
    TintPass& operator=(const TintPass&) = delete;

    /// Makes programs, buffers and scratch depths for the layers to be drawn. Lights without them lose their layers
    /// (Reason::tint_failed). Call before record().
    void prepare(const PassInputs& in, std::span<const TintAssignment> tints, std::span<LightStatus> statuses);
    /// Records the passes of all layers to be drawn.
    void record(const PassInputs& in, std::span<const TintAssignment> tints, const PassOutputs& out);
    /// Frees what the passes need, where no light has layers.
    void release();
    /// Returns the bytes of depths that the passes share.
    std::uint64_t scratch_bytes() const;

private:
    enum Step : std::size_t { kFirst, kBehind, kGather, kAbsorb, kSteps };
    /// One draw of a translucent surface.
    struct Draw {
        std::uint32_t material = 0;
        std::uint32_t first_index = 0, index_count = 0, first_item = 0, item_count = 0;
        std::int32_t base_vertex = 0;
        std::uint32_t record_offset = 0;  // place of its TransmissionRecord
    };
    struct View {
        std::size_t v = 0;
        std::uint32_t record_offset = 0;        // place of its DepthViewRecord
        std::size_t first_draw = 0, draws = 0;  // into draws_
    };
    struct DrawItem {
        std::uint32_t instance, place;
    };
    bool program(Step step, bool coloured);
    bool provide_scratch(std::uint32_t edge_px);
    void gather(const PassInputs& in, std::span<const TintAssignment> tints);
    void gather_draws(const PassInputs& in, std::span<const std::uint32_t> casters);
    void begin(const PassInputs& in, const View& view, gl::TargetHandle target, bool depths, std::uint32_t edge_px,
               gl::CommandList& list) const;
    void draw(const PassInputs& in, const View& view, const gl::PipelineState& state, gl::CommandList& list,
              LightReport& report) const;
    void bind_layers(bool bound, gl::CommandList& list) const;
    void record_view(const PassInputs& in, const View& view, const TintAssignment& tint, gl::CommandList& list,
                     LightReport& report);

    gl::Device& device_;
    std::array<gl::ProgramHandle, kSteps> programs_{};
    Retry retry_;
    bool coloured_ = false;  // programs_ read colours of vertices
    std::uint64_t frame_ = 0;
    std::array<gl::TextureHandle, kTintLayers> scratch_{};
    std::array<gl::TargetHandle, kTintLayers> scratch_targets_{};
    std::uint32_t scratch_px_ = 0;
    GrowingBuffer items_, records_;
    std::vector<View> views_;
    std::vector<Draw> draws_;
    std::vector<DrawItem> item_scratch_;
    std::vector<std::byte> record_scratch_;
};

}  // namespace gnomon::shadow
