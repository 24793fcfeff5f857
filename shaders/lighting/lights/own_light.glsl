// Picture of a surface without any light's pass: ambient and emitted light. UNLIT: its colour as it is.
#include "common/material.glsl"
#include "lighting/lights/ambient.glsl"
#include "lighting/post/picture_sum.glsl"
#include "lighting/post/tone_curve.glsl"
#ifdef UNLIT
const bool kUnlit = true;
#else
const bool kUnlit = false;
#endif

vec3 own_light(vec3 colour, vec3 shading_normal) {
    if (kUnlit) return ambient.ground.w * exposed_as(colour);
    return in_picture(ambient_light(colour, shading_normal) + material.emissive.rgb * ambient.sky.w);
}
