// Exponential shadow map: the mean of e^(c s) over the blurred texels, against the receiver's own (Annen et al. 2008).
// It is right where all texels are no farther from the light than the receiver.
#include "shadow/passes/prefilter/exponential_warp.glsl"

vec4 moments_of(float share, vec4 settings) { return vec4(warped(share, settings.x), 0.0, 0.0, 0.0); }

float moments_lit(vec4 moments, float share, vec4 settings) { return min(moments.x / warped(share, settings.x), 1.0); }
