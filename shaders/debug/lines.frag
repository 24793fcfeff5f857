// Lines in the world, fainter where surfaces hide them.
#include "common/bindings.glsl"
layout(binding = kSurfaceDepthUnit) uniform sampler2D surface_depth;
flat in vec3 line_colour;
layout(location = 0) out vec4 colour_out;
const float kHidden = 0.25;      // what is left of a hidden line
const float kOnSurface = 1e-3;   // boxes touch what they hold: lines this share of the distance behind a surface lie on
                                 // it

void main() {
    float surface = texelFetch(surface_depth, ivec2(gl_FragCoord.xy), 0).r;   // reversed, near over distance
    colour_out = vec4(line_colour, surface > gl_FragCoord.z * (1.0 + kOnSurface) ? kHidden : 1.0);
}
