#pragma once
#include <concepts>
#include <cstdint>
#include <limits>

#include "bench/glsl_on_cpu/glsl_types.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"

/// Samplers of shader_structs.inc: they look up maps of any origin as OpenGL's samplers do, a texel at a time.
namespace gnomon::bench::glsl {

inline constexpr uvec2 kShowsNone{0, 0xffffffffu};

/// Depths of a map, or of all faces of a cube, and the triangles that they show. column and row < size_px.
struct MapTexels {
    std::uint32_t size_px = 0;
    virtual double texel(int layer, std::uint32_t column, std::uint32_t row) const = 0;
    /// Returns instance and triangle, for rows that read them.
    virtual uvec2 triangle(int, std::uint32_t, std::uint32_t) const { return kShowsNone; }

protected:
    ~MapTexels() = default;
};

/// Record of the taps of one lookup.
struct Trace {
    std::uint8_t layers = 0;
    std::uint16_t taps = 0;
    double margin_texel = std::numeric_limits<double>::infinity();  // distance to the nearest change of a tap's result
};

/// Conversion of a difference of depth to texels of the map at that depth.
struct DepthScale {
    bool perspective = false;
    double texels_per_depth = 0.0;        // orthographic
    double alpha = 0.0, texel_tan = 1.0;  // perspective: depth = alpha + beta / z, a texel is texel_tan * z
    double texels(double depth, double gap) const {
        return gap * (perspective ? 1.0 / (std::max(depth - alpha, 1e-300) * texel_tan) : texels_per_depth);
    }
};

struct ShadowSampler {
    const MapTexels* map = nullptr;
    bool linear = false;
    DepthScale scales[shadow::kMaxViews];
    Trace* trace = nullptr;

    /// Returns the stored depth; 0 beyond the border.
    double stored(int layer, double column, double row) const {
        const double size = map->size_px;
        if (!(column >= 0.0 && column < size && row >= 0.0 && row < size)) return 0.0;
        return map->texel(layer, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    }
    double compare(double reference, double depth, int scale) const {
        const double gap_texel = scales[scale].texels(reference, std::abs(reference - depth));
        trace->margin_texel = std::min(trace->margin_texel, gap_texel);
        return reference >= depth ? 1.0 : 0.0;
    }
    void note_borders(const vec2& at_texel) const {
        for (int i = 0; i < 2; ++i)
            trace->margin_texel = std::min(trace->margin_texel, std::abs(at_texel[i] - std::round(at_texel[i])));
    }
};

struct sampler2DArrayShadow : ShadowSampler {};
struct samplerCubeShadow : ShadowSampler {};
struct sampler2DArrayDepths : ShadowSampler {};
struct samplerCubeDepths : ShadowSampler {};

struct TriangleSampler {
    const MapTexels* map = nullptr;
    Trace* trace = nullptr;
};
struct usampler2DArray : TriangleSampler {};
struct usamplerCube : TriangleSampler {};

template <class Sampler>
concept CubeSampler = std::same_as<Sampler, samplerCubeShadow> || std::same_as<Sampler, samplerCubeDepths>;

ivec2 textureSize(const CubeSampler auto& s, int) {
    const int size = static_cast<int>(s.map->size_px);
    return {size, size};
}

inline ivec3 textureSize(const ShadowSampler& s, int) {
    const int size = static_cast<int>(s.map->size_px);
    return {size, size, 1};
}

inline double texture(const sampler2DArrayShadow& s, const vec4& at) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 texel = at.xy_() * static_cast<double>(s.map->size_px);
    if (!s.linear) {
        s.note_borders(texel);
        return s.compare(at.w, s.stored(layer, floor(texel.x), floor(texel.y)), layer);
    }
    const vec2 low = floor(texel - 0.5), share = fract(texel - 0.5);
    const auto tap = [&](double x, double y) { return s.compare(at.w, s.stored(layer, low.x + x, low.y + y), layer); };
    return mix(mix(tap(0, 0), tap(1, 0), share.x), mix(tap(0, 1), tap(1, 1), share.x), share.y);
}

struct OnFace {
    std::uint32_t face = 0;
    vec2 texel;
};
inline OnFace on_face(const vec3& direction, double size) {
    const vec3 a = abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    OnFace at;
    at.face = static_cast<std::uint32_t>(2 * axis + (direction[axis] < 0.0 ? 1 : 0));
    const shadow::CubeFace& f = shadow::cube_face(at.face);
    const vec3 u(f.axis_u.x, f.axis_u.y, f.axis_u.z), v(f.axis_v.x, f.axis_v.y, f.axis_v.z);
    at.texel = (vec2(dot(direction, u), dot(direction, v)) / a[axis] * 0.5 + 0.5) * size;
    return at;
}

/// Returns a texel of a face. Beyond its edge it is the neighbour's texel in the same direction.
inline double stored_seamless(const samplerCubeShadow& s, std::uint32_t face, const vec2& texel) {
    const double size = s.map->size_px;
    const bool inside = texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size && texel.y < size;
    if (inside) return s.stored(static_cast<int>(face), texel.x, texel.y);
    const shadow::CubeFace& f = shadow::cube_face(face);
    const vec2 q = (texel + 0.5) / size * 2.0 - 1.0;
    const glm::dvec3 d = f.axis_u * q.x + f.axis_v * q.y - f.axis_back;
    const OnFace at = on_face({d.x, d.y, d.z}, size);
    const vec2 clamped = clamp(floor(at.texel), 0.0, size - 1.0);
    return s.stored(static_cast<int>(at.face), clamped.x, clamped.y);
}

inline double texture(const samplerCubeShadow& s, const vec4& at) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const double size = s.map->size_px;
    const OnFace face = on_face(at.xyz_(), size);
    if (!s.linear) {
        s.note_borders(face.texel);
        return s.compare(at.w, stored_seamless(s, face.face, clamp(floor(face.texel), 0.0, size - 1.0)), 0);
    }
    const vec2 low = floor(face.texel - 0.5), share = fract(face.texel - 0.5);
    const auto tap = [&](double x, double y) {
        return s.compare(at.w, stored_seamless(s, face.face, low + vec2(x, y)), 0);
    };
    return mix(mix(tap(0, 0), tap(1, 0), share.x), mix(tap(0, 1), tap(1, 1), share.x), share.y);
}

inline vec4 textureLod(const sampler2DArrayDepths& s, const vec3& at, double) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 texel = floor(at.xy_() * static_cast<double>(s.map->size_px));
    return {s.stored(layer, texel.x, texel.y), 0.0, 0.0, 0.0};
}

inline vec4 textureGather(const sampler2DArrayDepths& s, const vec3& at) {
    const int layer = static_cast<int>(at.z);
    s.trace->layers = static_cast<std::uint8_t>(s.trace->layers | (1u << layer));
    ++s.trace->taps;
    const vec2 corner = floor(at.xy_() * static_cast<double>(s.map->size_px) + 0.5);
    const auto tap = [&](double x, double y) { return s.stored(layer, corner.x + x, corner.y + y); };
    return {tap(-1.0, 0.0), tap(0.0, 0.0), tap(0.0, -1.0), tap(-1.0, -1.0)};
}

inline vec4 textureLod(const samplerCubeDepths& s, const vec3& at, double) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const OnFace face = on_face(at, s.map->size_px);
    const vec2 texel = clamp(floor(face.texel), 0.0, s.map->size_px - 1.0);
    return {s.stored(static_cast<int>(face.face), texel.x, texel.y), 0.0, 0.0, 0.0};
}

/// Gathers inside a face only: the shader needs no more.
inline vec4 textureGather(const samplerCubeDepths& s, const vec3& at) {
    s.trace->layers |= 1u;
    ++s.trace->taps;
    const OnFace face = on_face(at, s.map->size_px);
    const vec2 corner = floor(face.texel + 0.5);
    const auto tap = [&](double x, double y) {
        return s.stored(static_cast<int>(face.face), corner.x + x, corner.y + y);
    };
    return {tap(-1.0, 0.0), tap(0.0, 0.0), tap(0.0, -1.0), tap(-1.0, -1.0)};
}

/// Gathers a component of the four texels around a corner.
inline uvec4 gathered(const TriangleSampler& s, int layer, const vec2& corner, int component) {
    ++s.trace->taps;
    const auto tap = [&](double x, double y) {
        const uvec2 shown = s.map->triangle(layer, static_cast<uint>(corner.x + x), static_cast<uint>(corner.y + y));
        return component == 0 ? shown.x : shown.y;
    };
    return {tap(-1.0, 0.0), tap(0.0, 0.0), tap(0.0, -1.0), tap(-1.0, -1.0)};
}

/// Gathers inside the map only.
inline uvec4 textureGather(const usampler2DArray& s, const vec3& at, int component) {
    return gathered(s, static_cast<int>(at.z), floor(at.xy_() * static_cast<double>(s.map->size_px) + 0.5), component);
}

/// Gathers inside a face only.
inline uvec4 textureGather(const usamplerCube& s, const vec3& at, int component) {
    const OnFace face = on_face(at, s.map->size_px);
    return gathered(s, static_cast<int>(face.face), floor(face.texel + 0.5), component);
}

/// Returns what the texel shows; beyond the map, nothing.
inline uvec4 textureLod(const usampler2DArray& s, const vec3& at, double) {
    ++s.trace->taps;
    const vec2 texel = floor(at.xy_() * static_cast<double>(s.map->size_px));
    if (min(texel.x, texel.y) < 0.0 || max(texel.x, texel.y) >= s.map->size_px) return {};
    const uvec2 shown = s.map->triangle(static_cast<int>(at.z), static_cast<uint>(texel.x), static_cast<uint>(texel.y));
    return {shown.x, shown.y, 0, 0};
}

inline uvec4 textureLod(const usamplerCube& s, const vec3& at, double) {
    ++s.trace->taps;
    const OnFace face = on_face(at, s.map->size_px);
    const vec2 texel = clamp(floor(face.texel), 0.0, s.map->size_px - 1.0);
    const uvec2 shown =
        s.map->triangle(static_cast<int>(face.face), static_cast<uint>(texel.x), static_cast<uint>(texel.y));
    return {shown.x, shown.y, 0, 0};
}

}  // namespace gnomon::bench::glsl
