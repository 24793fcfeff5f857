// Variance shadow map of two warps, e^(c s) and -e^(-c s): the lesser of both bounds. The second is tightest where the
// first is loosest: at casters just before the receiver with something far behind both (Lauritzen and McCool 2008).
#include "shadow/passes/prefilter/chebyshev.glsl"
#include "shadow/passes/prefilter/exponential_warp.glsl"

vec4 moments_of(float share, vec4 settings) {
    float w = warped(share, settings.x), v = -warped(share, -settings.y);
    return vec4(w, w * w, v, v * v);
}

float moments_lit(vec4 moments, float share, vec4 settings) {
    float w = warped(share, settings.x), v = -warped(share, -settings.y);
    return min(share_not_before(moments.x, moments.y, w, settings.z * w * w),
               share_not_before(moments.z, moments.w, v, settings.z * v * v));
}
