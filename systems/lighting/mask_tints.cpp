#include <algorithm>

#include "shaders/bindings.h"
#include "systems/lighting/mask_pass.h"

/// Colours that translucent casters let through, beside the mask.
namespace gnomon::lighting {
namespace {

/// Returns the light of a layer, if translucent casters tint it; else null.
const shadow::LightingLight* tinted(const MaskInputs& in, std::uint32_t layer) {
    if (in.layers[layer] >= in.inputs.lights.size()) return nullptr;
    const shadow::LightingLight& light = in.inputs.lights[in.layers[layer]];
    return light.row.tint == shadow::TintLookup::none ? nullptr : &light;
}

}  // namespace

/// Makes the texture while any light of the mask is tinted, and frees it otherwise. Without room there is none.
void MaskPass::provide_tints(const MaskInputs& in) {
    bool any = false;
    for (std::uint32_t layer = 0; layer < in.layers.size(); ++layer) any = any || tinted(in, layer);
    if (!any || tint_targets_.size() != targets_.size()) release_tints();
    if (!any || tints_) return;
    tints_ = device_
                 .create_texture({"shadow tints", gl::TextureKind::array, gl::Format::rgba8, size_px_.x, size_px_.y,
                                  static_cast<std::uint32_t>(targets_.size()), 1},
                                 {})
                 .handle;
    for (std::size_t i = 0; i < targets_.size() && tints_; ++i) {
        const auto target = device_.create_target({"shadow tints", {{tints_, static_cast<std::int32_t>(i)}}, {}});
        if (!target) return release_tints();
        tint_targets_.push_back(target.handle);
    }
}

/// Records the colour of each layer, over the surfaces of one sample.
void MaskPass::record_tints(const MaskInputs& in, std::uint32_t sample, gl::CommandList& list) {
    const std::size_t samples = targets_.size() / in.layers.size();
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
    for (std::uint32_t layer = 0; layer < in.layers.size(); ++layer) {
        list.add(
            gl::BeginPass{tint_targets_[layer * samples + sample], all, false, 0.0f, true, {1.0f, 1.0f, 1.0f, 1.0f}});
        const shadow::LightingLight* light = tinted(in, layer);
        const gl::ProgramHandle program =
            light ? programs_.row(kept_row(light->row), ShaderPass::tint) : gl::ProgramHandle{};
        if (program) {
            list.add(gl::SetPipeline{{.program = program}});
            LightProgram reads{.program = program};
            reads.tint = light->tint;
            bind_inputs(in, layer, sample, reads, list);
            list.add(gl::DrawTriangle{});
        }
        list.add(gl::EndPass{});
    }
}

void MaskPass::release_tints() {
    for (const gl::TargetHandle target : tint_targets_) device_.destroy(target);
    tint_targets_.clear();
    device_.destroy(tints_);
    tints_ = {};
}

}  // namespace gnomon::lighting
