#include "systems/lighting/catcher_pass.h"

namespace gnomon::lighting {

bool CatcherPass::provide(bool wanted, glm::uvec2 size_px) {
    if (target_ && (!wanted || size_px != size_px_)) release();
    if (!wanted || target_) return true;
    const auto make = [&](const char* label, gl::Format format) {
        return device_.create_texture({label, gl::TextureKind::flat, format, size_px.x, size_px.y, 1, 1}, {}).handle;
    };
    sums_ = make("caught light", gl::Format::rg32f);
    if (sums_) depth_ = make("caught light, depth", gl::Format::d32f);
    if (depth_) target_ = device_.create_target({"caught light", {{sums_, -1}}, {depth_, -1}}).handle;
    if (!target_) release();
    size_px_ = size_px;
    return static_cast<bool>(target_);
}

gl::Rect CatcherPass::viewport() const {
    return {0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
}

void CatcherPass::begin(gl::TextureHandle surface_depth, gl::CommandList& list) const {
    list.add(gl::CopyTexture{surface_depth, depth_, 0, viewport()});
    list.add(gl::BeginPass{target_, viewport(), false, 0.0f, false, {}});
}

void CatcherPass::begin_sums(gl::CommandList& list) const {
    list.add(gl::EndPass{});
    list.add(gl::BeginPass{target_, viewport(), false, 0.0f, true, {}});
}

void CatcherPass::release() {
    device_.destroy(target_);
    device_.destroy(sums_);
    device_.destroy(depth_);
    target_ = {};
    sums_ = depth_ = {};
}

}  // namespace gnomon::lighting
