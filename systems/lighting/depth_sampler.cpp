#include "systems/lighting/depth_sampler.h"

#include <array>
#include <span>
#include <utility>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {
namespace {

constexpr std::uint64_t kBytes = sizeof(SampledDepths::pixels);
constexpr std::uint32_t kTile_px = 64;  // edge of a work group's tile: 16 invocations of 4 pixels

std::uint32_t tiles(std::uint32_t size_px) { return (size_px + kTile_px - 1) / kTile_px; }

}  // namespace

DepthSampler::~DepthSampler() {
    device_.destroy(program_);
    device_.destroy(bins_);
}

bool DepthSampler::prepare() {
    if (!program_) {
        auto source = gl::expand_shader(shader_files(), "lighting/post/depth_histogram.comp", {});
        if (!source) return false;
        program_ = device_.create_program({.label = "view distances", .compute = std::move(source).value()}).handle;
    }
    if (program_ && !bins_)
        bins_ = device_.create_buffer({"view distances", kBytes, gl::BufferUse::updated}, {}).handle;
    return bins_ && counts_.prepare();
}

void DepthSampler::record(const Picture& picture, gl::CommandList& list) {
    if (!retry_.due(++frames_)) return;
    failed_ = !prepare();
    if (failed_) return retry_.failed(frames_);
    if (!counts_.has_room()) return;
    list.add(gl::BeginGroup{"view distances"});
    list.add(gl::BeginTimer{kDepthTimer});
    list.add(gl::ClearBuffer{bins_, 0, kBytes});
    list.add(gl::BindUniforms{bindings::kCameraBlock, picture.uniforms, 0, sizeof(shadow::CameraRecord)});
    list.add(gl::BindTexture{bindings::kSurfaceDepthUnit, picture.depth, picture.sampler});
    list.add(gl::BindStorage{bindings::kDepthBinBuffer, bins_});
    list.add(gl::Dispatch{program_, tiles(picture.size_px.x), tiles(picture.size_px.y)});
    counts_.record(bins_, picture.camera, list);
    list.add(gl::EndTimer{kDepthTimer});
    list.add(gl::EndGroup{});
}

void DepthSampler::collect(SampledDepths& depths) {
    std::array<std::uint32_t, kDepthBins> pixels{};
    const ReadbackRing::News news = counts_.collect(std::as_writable_bytes(std::span(pixels)));
    if (news.state == ReadbackRing::State::came) depths = {news.camera, false, pixels};
    if (news.state == ReadbackRing::State::failed || failed_) depths = {.failed = true};
}

}  // namespace gnomon::lighting
