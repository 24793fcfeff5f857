// First pass over a view of a prefiltered map: moments_of() its depths, blurred along u. Beyond the map's border its
// outermost texels go on; of a cube, what its neighbours show there. CUBE, PERSPECTIVE: the map that holds the depths.
#include "common/bindings.glsl"
#include "shadow/passes/prefilter/prefilter_block.glsl"
#include "shadow/passes/prefilter/linear_distance.glsl"
#define PREFILTER_PASS 1
#include "row.glsl"
layout(location = 0) out vec4 moments_out;

#ifdef CUBE
#include "shadow/lookup/cube_faces.glsl"
layout(binding = kPrefilterSourceUnit) uniform samplerCube depth_map;

bool was_drawn(vec3 direction) { return (moment.place.w >> face_of(direction) & 1) != 0; }

vec3 direction_to(vec2 tangent) {
    return mat3(moment.axis_u.xyz, moment.axis_v.xyz, moment.axis_back.xyz) * vec3(tangent, -1.0);
}

// Returns the share of the range at a texel. Where the neighbour was not drawn, nothing is seen there: this face goes
// on.
float share_at(ivec2 texel) {
    float size = float(textureSize(depth_map, 0).x);
    vec2 tangent = (vec2(texel) + 0.5) / size * 2.0 - 1.0;
    vec3 direction = direction_to(tangent);
    if (!was_drawn(direction)) direction = direction_to(clamp(tangent, 1.0 / size - 1.0, 1.0 - 1.0 / size));
    float depth = textureLod(depth_map, direction, 0.0).x;
    return depth > 0.0 ? perspective_share(depth, length(direction) / largest(direction), moment.range) : 1.0;
}
#else
layout(binding = kPrefilterSourceUnit) uniform sampler2DArray depth_map;

float share_at(ivec2 texel) {
    ivec2 inside = clamp(texel, ivec2(0), textureSize(depth_map, 0).xy - 1);
    float depth = texelFetch(depth_map, ivec3(inside, moment.place.x), 0).x;
#ifdef PERSPECTIVE
    return depth > 0.0 ? perspective_share(depth, 1.0, moment.range) : 1.0;
#else
    return orthographic_share(depth);
#endif
}
#endif

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) - ivec2(0, moment.place.z);
    vec4 sum = vec4(0.0);
    for (int i = -moment.place.y; i <= moment.place.y; ++i)
        sum += weight(abs(i)) * moments_of(share_at(texel + ivec2(i, 0)), moment.settings);
    moments_out = sum;
}
