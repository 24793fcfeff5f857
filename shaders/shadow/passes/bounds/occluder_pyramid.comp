// One level of the occluder pyramid that sources with a size read: the nearest depths in squares of kEndsAcross²
// texels. CUBE: the texels are those of a cube's face. OF_LEVEL: squares of the level below stand for the texels.
#include "common/bindings.glsl"
#include "shadow/filters/exact/occluder_pyramid.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
// C++ twin: PyramidRecord in systems/shadow/exact/occluder_pyramid_pass.h.
layout(std140, binding = kPyramidBlock) uniform EndsBlock {
    vec4 axis_u, axis_v, axis_back;   // axes of a cube's face, as in face_axes()
    ivec4 from;                       // x: where the level below begins; y: its side; z: layer of the map
    ivec4 to;                         // x, y: the same of this level
    vec4 numbers;                     // x: tangent of a texel's side, 0: parallel light; y: alpha (see
                                      // bias/automatic.glsl); z: see ends_of_texel()
} ends;
layout(std430, binding = kPyramidBuffer) buffer SheetEndBuffer { vec2 sheet_ends[]; };

#ifdef OF_LEVEL
vec2 ends_at(ivec2 square) { return sheet_ends[ends.from.x + square.y * ends.from.y + square.x]; }
#else
#ifdef CUBE
layout(binding = kShadowMapUnit) uniform samplerCube shadow_map;
float first_at(ivec2 texel) {
    vec2 tangent = (vec2(texel) + 0.5) / float(ends.from.y) * 2.0 - 1.0;
    return textureLod(shadow_map, mat3(ends.axis_u.xyz, ends.axis_v.xyz, ends.axis_back.xyz) * vec3(tangent, -1.0), 0.0).x;
}
#else
layout(binding = kShadowMapUnit) uniform sampler2DArray shadow_map;
float first_at(ivec2 texel) { return texelFetch(shadow_map, ivec3(texel, ends.from.z), 0).x; }
#endif
layout(binding = kBoundsUnit) uniform sampler2DArray sheet_bounds;
vec2 ends_at(ivec2 texel) {
    vec2 bounds = texelFetch(sheet_bounds, ivec3(texel, ends.from.z), 0).xy;
    return ends_of_texel(first_at(texel), bounds, ends.numbers.x, ends.numbers.y, ends.numbers.z);
}
#endif

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(square, ivec2(ends.to.y)))) return;
    vec2 nearest = vec2(-1.0);
    for (int i = 0; i < kEndsAcross * kEndsAcross; ++i) {
        ivec2 at = square * kEndsAcross + ivec2(i % kEndsAcross, i / kEndsAcross);
        if (all(lessThan(at, ivec2(ends.from.y)))) nearest = max(nearest, ends_at(at));
    }
    sheet_ends[ends.to.x + square.y * ends.to.y + square.x] = nearest;
}
