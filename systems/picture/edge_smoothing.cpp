#include "systems/picture/edge_smoothing.h"

namespace gnomon::picture {

void EdgeSmoothing::record(const FinishedPicture& picture, gl::CommandList& list) {
    ++frame_;
    if (!provide(picture.size_px)) return;
    list.add(gl::BeginGroup{"smooth edges"});
    list.add(gl::CopyTexture{picture.texture, copy_});
    record_pass({program_, copy_, sampler_, picture.target}, size_px_, list);
    list.add(gl::EndGroup{});
}

bool EdgeSmoothing::provide(glm::uvec2 size_px) {
    if (copy_ && size_px == size_px_) return true;
    if (!retry_.due(frame_)) return false;
    release();
    program_ = make_program(device_, "smooth edges", "picture/smooth_edges.frag");
    sampler_ = device_.create_sampler({.label = "picture"}).handle;
    copy_ = device_
                .create_texture(
                    {"picture to smooth", gl::TextureKind::flat, gl::Format::srgb8_a8, size_px.x, size_px.y}, {})
                .handle;
    size_px_ = size_px;
    if (program_ && sampler_ && copy_) return true;
    release();
    retry_.failed(frame_);
    return false;
}

void EdgeSmoothing::release() {
    device_.destroy(program_);
    device_.destroy(sampler_);
    device_.destroy(copy_);
    program_ = {};
    sampler_ = {};
    copy_ = {};
    size_px_ = {0, 0};
}

}  // namespace gnomon::picture
