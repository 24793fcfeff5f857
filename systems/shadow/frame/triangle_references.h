#pragma once
#include <cstdint>

#include "engine/gl/device.h"

namespace gnomon::shadow {

/// How a map's texels name the triangle that they show (shaders/shadow/filters/triangles/gathered_ids.glsl).
struct TriangleReferences {
    /// Bits of the triangle's number in a texel's one number, below the instance's. All set: no triangle.
    /// 0: a texel has two numbers, instance and triangle.
    std::uint32_t triangle_bits = 0;
    gl::Format format() const { return triangle_bits > 0 ? gl::Format::r32ui : gl::Format::rg32ui; }
    bool operator==(const TriangleReferences&) const = default;
};

}  // namespace gnomon::shadow
