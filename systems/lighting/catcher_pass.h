#pragma once
#include <glm/vec2.hpp>

#include "engine/gl/device.h"

namespace gnomon::lighting {

/// Light on the nearest shadow catchers of a picture, and their depth (shaders/lighting/catchers/caught_sum.glsl). Owns
/// its device objects. A picture without catchers has none.
class CatcherPass {
public:
    explicit CatcherPass(gl::Device& device) : device_(device) {}
    ~CatcherPass() { release(); }
    CatcherPass(const CatcherPass&) = delete;
    CatcherPass& operator=(const CatcherPass&) = delete;

    /// Creates or frees all, for pictures of that size. Returns false without room; catchers are then not drawn.
    bool provide(bool wanted, glm::uvec2 size_px);
    explicit operator bool() const { return static_cast<bool>(target_); }

    /// Records the start, with the depth of the surfaces: catchers behind them are not seen.
    void begin(gl::TextureHandle surface_depth, gl::CommandList& list) const;
    /// Records the start of the sums, over the depths that the draws since begin() left.
    void begin_sums(gl::CommandList& list) const;
    gl::TextureHandle sums() const { return sums_; }  // rg32f: floats, since thousands of lights may add up

private:
    gl::Rect viewport() const;
    void release();

    gl::Device& device_;
    glm::uvec2 size_px_{0, 0};
    gl::TextureHandle sums_{}, depth_{};
    gl::TargetHandle target_{};
};

}  // namespace gnomon::lighting
