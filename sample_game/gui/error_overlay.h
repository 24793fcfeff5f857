#pragma once
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "sample_game/support/truth_comparison.h"

namespace gnomon::game {

/// The errors of a frozen frame, over its picture.
class ErrorLayer {
public:
    /// Draws through `device`, which must outlive the layer.
    explicit ErrorLayer(gl::Device& device) : device_(device) {}
    ~ErrorLayer() { device_.destroy(image_); }
    ErrorLayer(const ErrorLayer&) = delete;
    ErrorLayer& operator=(const ErrorLayer&) = delete;

    /// Draws tints, figures and the meaning of the colours into ImGui's background, or the progress of the trace. Draws
    /// nothing and frees its memory if the frame is not frozen.
    void draw(const FrozenFrame& frozen, const FrameReport& report, glm::vec2 size_px);

private:
    void upload(const FrozenFrame& frozen);

    gl::Device& device_;
    gl::TextureHandle image_{};
    std::uint64_t version_ = 0;
};

}  // namespace gnomon::game
