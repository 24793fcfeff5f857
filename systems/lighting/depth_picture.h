#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/gl/handles.h"

namespace gnomon::lighting {

/// How another renderer's picture maps places to pixels and depths.
struct PictureLens {
    bool orthographic = false;
    glm::dvec2 half{1.0};   // half extents: tangents (perspective) or metres (orthographic)
    glm::dvec2 shift{0.0};  // from the view's axis to the picture's middle, in half extents
    /// Distance along the view of a depth d, metres: scale / (d + offset) (perspective) or scale * d + offset
    /// (orthographic).
    double scale = 1.0, offset = 0.0;
    double near_m = 0.0, far_m = 0.0;  // range of distances; far_m may be infinite for perspective
    bool reversed = false;             // larger depths are nearer
};

/// How a depth buffer rounds. `step`: half a step of a fixed-point format; 0: floating point.
struct DepthRounding {
    double step = 0.0;
};

/// Components of a normal texture. none: normals are derived from the depths.
enum class NormalRange : std::uint8_t { none, plus_minus_one, zero_to_one };

/// Picture of another renderer.
struct DepthPicture {
    glm::uvec2 size_px{0, 0};
    PictureLens lens;
    DepthRounding rounding;
    gl::TextureHandle depth{};
    gl::TextureHandle normals{};  // {0}: NormalRange::none
    NormalRange range = NormalRange::none;
    bool view_space = false;  // normals have the camera's axes, not the world's
    std::uint8_t receive_layers = 0xff;
    bool shows_only_added = false;  // nothing but the snapshot's instances is seen
    /// Places of samples in a pixel, from its middle, pixels. Empty: the textures are not multisampled.
    std::vector<glm::dvec2> samples = {};
};

}  // namespace gnomon::lighting
