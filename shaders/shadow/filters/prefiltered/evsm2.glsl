// Variance shadow map of exponentially warped distances: what lies far behind the nearest caster counts the less
// (Lauritzen and McCool 2008).
#include "shadow/passes/prefilter/chebyshev.glsl"
#include "shadow/passes/prefilter/exponential_warp.glsl"

vec4 moments_of(float share, vec4 settings) {
    float w = warped(share, settings.x);
    return vec4(w, w * w, 0.0, 0.0);
}

float moments_lit(vec4 moments, float share, vec4 settings) {
    float w = warped(share, settings.x);
    return share_not_before(moments.x, moments.y, w, settings.z * w * w);
}
