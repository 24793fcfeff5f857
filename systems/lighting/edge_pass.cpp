#include "systems/lighting/edge_pass.h"

namespace gnomon::lighting {
namespace {

constexpr float kUnreached = -1.0f;  // as in shaders/lighting/edges/middle_state.glsl

}  // namespace

bool EdgePass::provide(bool wanted, glm::uvec2 size_px) {
    if (is_there() && (!wanted || size_px != size_px_)) release();
    if (!wanted || is_there()) return true;
    const auto make = [&](const char* label, gl::Format format) {
        return device_.create_texture({label, gl::TextureKind::flat, format, size_px.x, size_px.y, 1, 1}, {}).handle;
    };
    shares_ = make("lit shares", gl::Format::r32f);
    if (shares_) depth_ = make("lit shares, depth", gl::Format::d32f);
    if (depth_) target_ = device_.create_target({"lit shares", {{shares_, -1}}, {depth_, -1}}).handle;
    if (target_) marks_target_ = device_.create_target({"lit shares, marks", {}, {depth_, -1}}).handle;
    if (!marks_target_) release();
    size_px_ = size_px;
    return is_there();
}

gl::Rect EdgePass::viewport() const {
    return {0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
}

void EdgePass::begin(const Part& part, bool first, gl::CommandList& list) const {
    if (first) list.add(gl::CopyTexture{part.surfaces, depth_, 0, part.area});
    list.add(gl::BeginPass{target_, viewport(), false, 0.0f, first, {kUnreached, 0.0f, 0.0f, 0.0f}});
}

void EdgePass::release() {
    device_.destroy(marks_target_);
    device_.destroy(target_);
    device_.destroy(shares_);
    device_.destroy(depth_);
    marks_target_ = target_ = {};
    shares_ = depth_ = {};
}

}  // namespace gnomon::lighting
