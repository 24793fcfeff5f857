// What fog takes of what is behind it, and what it scatters of the light from everywhere.
#include "lighting/fog/fog_way.glsl"
#include "lighting/lights/ambient.glsl"
layout(location = 0) out vec4 colour_out;

void main() {
    const float kInversePi = 0.318309886;
    FogWay way = fog_way(ivec2(gl_FragCoord.xy));
    if (!(way.from_m < way.to_m)) discard;
    float taken = 1.0 - exp(-fog.taken.w * (way.to_m - way.from_m));
    vec3 from_everywhere = 0.5 * kInversePi * (ambient.sky.rgb + ambient.ground.rgb);
    colour_out = vec4(fog.taken.rgb * from_everywhere, taken);
}
