// Cubes, for filters that read results of comparing.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform samplerCubeShadow shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0)); }

// Returns the result of one comparison, `offset_texel` texels beside the receiver. A tap that leaves the face is
// compared by the depth of the face that it lands on.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    vec3 direction = point.position + offset_texel.x * point.step_u + offset_texel.y * point.step_v;
    if (!is_drawn(direction)) return 1.0;
    ViewRecord view = light.views[0];
    float depth = view.numeric.z + view.axis_back.w / largest(direction);
    // Depth where the tap's direction meets the plane.
    if (kManualBias && compares_on_plane())
        depth = view.numeric.z + max(dot(point.plane, direction), 0.0) * view.axis_back.w / largest(direction);
    return texture(shadow_map, vec4(direction, clamp(depth + point.bias_depth, 0.0, 1.0)));
}
