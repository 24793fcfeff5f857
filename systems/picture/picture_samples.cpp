#include "systems/picture/picture_samples.h"

#include <glm/vec4.hpp>
#include <span>
#include <string>

#include "systems/picture/sample_places.h"

namespace gnomon::picture {
namespace {

/// Uniform block; matches SampleBlock in shaders/picture/mean_of_samples.frag (std140).
struct SampleRecord {
    glm::vec4 samples{0.0f};
};

}  // namespace

PictureSamples::Draws PictureSamples::begin(bool unchanged, std::uint32_t most, glm::uvec2 size_px, bool transparent) {
    ++frame_;
    if (most <= 1 || transparent != static_cast<bool>(count_buffer_)) release();
    if (!unchanged || size_px != size_px_ || count_ > most) restart();
    if (!unchanged || most <= 1 || !provide(size_px, transparent))
        draws_ = Draws::alone;
    else
        draws_ = count_ < most ? Draws::sample : Draws::nothing;
    return draws_;
}

glm::dvec2 PictureSamples::place_px() const {
    return draws_ == Draws::sample ? sample_place_px(count_) : glm::dvec2(0.0);
}

void PictureSamples::record(const FinishedPicture& picture, gl::CommandList& list) {
    if (draws_ == Draws::alone) return;
    list.add(gl::BeginGroup{"samples"});
    if (draws_ == Draws::sample) {
        const bool first = count_++ == 0;
        record_pass({add_, picture.texture, sampler_, sum_target_, first ? gl::Blend::off : gl::Blend::add, false},
                    size_px_, list);
    }
    // The first sample is the picture as it is.
    if (count_ > 1) {
        const SampleRecord record{{static_cast<float>(count_), 0.0f, 0.0f, 0.0f}};
        if (count_buffer_) list.update(count_buffer_, 0, std::span<const SampleRecord>(&record, 1));
        record_pass({mean_, sum_, sampler_, picture.target, gl::Blend::off, false, count_buffer_, sizeof(record)},
                    size_px_, list);
    }
    list.add(gl::EndGroup{});
}

void PictureSamples::submitted(bool drawn) {
    if (!drawn) restart();
}

bool PictureSamples::provide(glm::uvec2 size_px, bool transparent) {
    if (sum_target_ && size_px == size_px_) return true;
    if (!retry_.due(frame_)) return false;
    release();
    const std::string define = "TRANSPARENT 1";
    const std::span<const std::string> defines(&define, transparent ? 1 : 0);
    if (!add_) add_ = make_program(device_, "add sample", "picture/add_sample.frag", defines);
    if (!mean_) mean_ = make_program(device_, "mean of samples", "picture/mean_of_samples.frag", defines);
    if (transparent) count_buffer_ = device_.create_buffer({"number of samples", sizeof(SampleRecord)}, {}).handle;
    if (!sampler_) sampler_ = device_.create_sampler({.label = "picture"}).handle;
    // A sum of many samples needs more than the 11 bits of halves.
    sum_ =
        device_.create_texture({"sum of samples", gl::TextureKind::flat, gl::Format::rgba32f, size_px.x, size_px.y}, {})
            .handle;
    if (sum_) sum_target_ = device_.create_target({"sum of samples", {{sum_, -1}}, {}}).handle;
    size_px_ = size_px;
    if (add_ && mean_ && sampler_ && sum_target_ && transparent == static_cast<bool>(count_buffer_)) return true;
    release();
    retry_.failed(frame_);
    return false;
}

void PictureSamples::release() {
    device_.destroy(sum_target_);
    device_.destroy(sum_);
    device_.destroy(add_);
    device_.destroy(mean_);
    device_.destroy(sampler_);
    device_.destroy(count_buffer_);
    count_buffer_ = {};
    sum_target_ = {};
    sum_ = {};
    add_ = mean_ = {};
    sampler_ = {};
    size_px_ = {0, 0};
    count_ = 0;
}

}  // namespace gnomon::picture
