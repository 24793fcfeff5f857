#pragma once
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "sample_game/support/truth_comparison.h"
#include "systems/report.h"

namespace gnomon::game {

/// The errors of a frozen frame, over its picture.
class ErrorLayer {
public:
    /// `device` must outlive it.
    explicit ErrorLayer(gl::Device& device) : device_(device) {}
    ~ErrorLayer() { device_.destroy(image_); }
    ErrorLayer(const ErrorLayer&) = delete;
    ErrorLayer& operator=(const ErrorLayer&) = delete;

    /// Into ImGui's background: tints, figures and what the colours mean, or how far the trace is. Nothing of a frame
    /// that is not frozen, whose memory is given back.
    void draw(const FrozenFrame& frozen, const FrameReport& report, glm::vec2 size_px);

private:
    void upload(const FrozenFrame& frozen);

    gl::Device& device_;
    gl::TextureHandle image_{};
    std::uint64_t version_ = 0;
};

}  // namespace gnomon::game
