#include "systems/lighting/exposure_meter.h"

#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/lighting/lighting_system.h"

namespace gnomon::lighting {

ExposureMeter::~ExposureMeter() {
    device_.destroy(program_);
    device_.destroy(scale_of_);
}

bool ExposureMeter::prepare() {
    if (!program_) {
        auto source = gl::expand_shader(shader_files(), "lighting/post/exposure.comp", {});
        if (!source) return false;
        program_ = device_.create_program({.label = "exposure", .compute = std::move(source).value()}).handle;
    }
    if (program_ && !scale_of_)
        scale_of_ = device_.create_buffer({"exposure", sizeof(float), gl::BufferUse::updated}, {}).handle;
    return scale_of_ && scales_.prepare();
}

void ExposureMeter::record(const Picture& picture, gl::CommandList& list) {
    if (!retry_.due(++frames_)) return;
    if (!prepare()) return retry_.failed(frames_);
    if (!scales_.has_room()) return;
    list.add(gl::BeginGroup{"exposure to read"});
    list.add(gl::BindTexture{bindings::kLuminanceUnit, picture.luminance, picture.sampler});
    list.add(
        gl::BindUniforms{bindings::kExposureBlock, picture.uniforms, picture.exposure_offset, sizeof(ExposureRecord)});
    list.add(gl::BindStorage{bindings::kExposureBuffer, scale_of_});
    list.add(gl::Dispatch{program_});
    scales_.record(scale_of_, picture.camera, list);
    list.add(gl::EndGroup{});
}

double ExposureMeter::bound(ecs::Entity camera) {
    float scale = 0.0f;
    const ReadbackRing::News news = scales_.collect(std::as_writable_bytes(std::span(&scale, 1)));
    if (news.state != ReadbackRing::State::nothing) measured_.reset();
    if (news.state == ReadbackRing::State::came && std::isfinite(scale) && scale > 0.0f) measured_ = scale;
    if (news.state == ReadbackRing::State::came) camera_ = news.camera;
    if (!measured_ || camera_ != camera) return std::numeric_limits<double>::infinity();
    constexpr double kStepsPerStop = 4.0, kMostTooLarge = 2.0;
    const double needed = *measured_ * kMostGrowth;
    if (!(needed <= last_ && last_ <= kMostTooLarge * needed))
        last_ = std::exp2(std::ceil(kStepsPerStop * std::log2(needed)) / kStepsPerStop);
    return last_;
}

}  // namespace gnomon::lighting
