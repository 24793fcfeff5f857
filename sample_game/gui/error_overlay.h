#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "gnomon/frame.h"
#include "sample_game/inside/truth_comparison.h"

namespace gnomon::game {

/// The errors of a frozen frame, over its picture. Needs a current context only while errors are shown.
class ErrorLayer {
public:
    ErrorLayer() = default;
    ~ErrorLayer() { forget(); }
    ErrorLayer(const ErrorLayer&) = delete;
    ErrorLayer& operator=(const ErrorLayer&) = delete;

    /// Draws tints, figures and the meaning of the colours into ImGui's background, or the progress of the trace. Draws
    /// nothing and frees its memory if the frame is not frozen.
    void draw(const FrozenFrame& frozen, const FrameReport& report, glm::vec2 size_px);

private:
    void upload(const FrozenFrame& frozen);
    void forget();

    unsigned image_ = 0;  // texture of the tints
    std::uint64_t version_ = 0;
};

}  // namespace gnomon::game
