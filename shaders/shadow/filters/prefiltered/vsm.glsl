// Variance shadow map: mean and mean square of distances (Donnelly and Lauritzen 2006).
#include "shadow/passes/prefilter/chebyshev.glsl"

vec4 moments_of(float share, vec4 settings) { return vec4(share, share * share, 0.0, 0.0); }

float moments_lit(vec4 moments, float share, vec4 settings) {
    return share_not_before(moments.x, moments.y, share, settings.z);
}
