// Shadow catchers over the picture: black, with the share of its light that casters take as alpha.
#include "common/bindings.glsl"
layout(binding = kCaughtLightUnit) uniform sampler2D caught_light;   // see lighting/catchers/caught_sum.glsl
layout(location = 0) out vec4 colour_out;

void main() {
    vec2 caught = texelFetch(caught_light, ivec2(gl_FragCoord.xy), 0).rg;
    float share = caught.g > 0.0 ? clamp(caught.r / caught.g, 0.0, 1.0) : 0.0;   // no light: nothing to take
    colour_out = vec4(0.0, 0.0, 0.0, share);
}
