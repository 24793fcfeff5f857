#include "systems/lighting/depth_sampler.h"

#include <algorithm>

#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/types.h"

namespace gnomon::lighting {
namespace {

constexpr std::uint32_t kTile_px = 64;  // of a work group: 16 invocations of 4 pixels, to either side

std::uint32_t tiles(std::uint32_t size_px) { return (size_px + kTile_px - 1) / kTile_px; }

}  // namespace

DepthSampler::~DepthSampler() {
    device_.destroy(program_);
    device_.destroy(bins_);
    for (const Slot& slot : slots_) device_.destroy(slot.buffer);
}

bool DepthSampler::make_program() {
    if (program_) return true;
    auto source = gl::expand_shader(shader_files(), "shadow/depth_bins.comp", {});
    if (!source) return false;
    program_ = device_.create_program({.label = "view distances", .compute = std::move(source).value()}).handle;
    return static_cast<bool>(program_);
}

bool DepthSampler::make_buffer(gl::BufferHandle& buffer, const char* label, gl::BufferUse use) {
    if (!buffer) buffer = device_.create_buffer({label, sizeof(SampledDepths::pixels), use}, {}).handle;
    return static_cast<bool>(buffer);
}

bool DepthSampler::prepare() {
    bool ready = make_program() && make_buffer(bins_, "view distances", gl::BufferUse::updated);
    for (Slot& slot : slots_)
        ready = ready && make_buffer(slot.buffer, "view distances to read", gl::BufferUse::read_back);
    return ready;
}

void DepthSampler::record(const Picture& picture, gl::CommandList& list) {
    if (!retry_.due(++frames_)) return;
    failed_ = !prepare();
    if (failed_) return retry_.failed(frames_);
    const auto slot = std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return s.number == 0; });
    if (slot == slots_.end()) return;
    slot->camera = picture.camera;
    slot->number = ++pictures_;
    static constexpr std::array<std::uint32_t, kDepthBins> kNone{};
    list.add(gl::BeginGroup{"view distances"});
    list.add(gl::BeginTimer{kDepthTimer});
    list.update(bins_, 0, std::span<const std::uint32_t>(kNone));
    list.add(gl::BindUniforms{0, picture.uniforms, 0, sizeof(shadow::CameraRecord)});
    list.add(gl::BindTexture{0, picture.depth, picture.sampler});
    list.add(gl::BindStorage{0, bins_});
    list.add(gl::Dispatch{program_, tiles(picture.size_px.x), tiles(picture.size_px.y)});
    list.add(gl::CopyBuffer{bins_, slot->buffer});
    list.add(gl::EndTimer{kDepthTimer});
    list.add(gl::EndGroup{});
}

void DepthSampler::collect(SampledDepths& depths) {
    std::uint64_t newest = 0;
    std::array<std::uint32_t, kDepthBins> pixels{};
    for (Slot& slot : slots_) {
        if (slot.number == 0) continue;
        const gl::Readback state = device_.read_buffer(slot.buffer, std::as_writable_bytes(std::span(pixels)));
        if (state == gl::Readback::pending) continue;
        if (state == gl::Readback::failed) depths = {.failed = true};
        if (state == gl::Readback::done && slot.number > newest) {
            newest = slot.number;
            depths = {slot.camera, false, pixels};
        }
        slot.number = 0;
    }
    if (failed_) depths = {.failed = true};
}

}  // namespace gnomon::lighting
