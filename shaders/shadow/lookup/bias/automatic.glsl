// Smallest offset that keeps a plane from shadowing itself, in closed form, per projection. Derivation and sources:
// docs/explanation/bias.md. Depth is reversed: an offset toward the light adds.
#include "common/float_rounding.glsl"

// Slope above which the offset moves the receiver along its normal instead of along the light: bounded where the
// tangent is not. Both shift a plane equally. They differ at contacts (depth) and at silhouettes (normal).
const float kSteepTangent = 4.0;

// Error of reversed perspective depth in D32F, relative: half a quantum (1u of depth) and the projection's rounding
// (6u).
const float kRelativeRounding = 7.0 * kUnitRoundoff;

// Largest share by which a texel's growth counts. Beyond it a texel is half as wide as the receiver is far, and the map
// resolves nothing.
const float kMostGrowth = 0.5;

struct Bias {
    float along_normal_m;   // distance that the receiver is moved along its normal first, metres
    float depth;            // what is then added to its reversed depth
};

// Returns how far off its plane a receiver seems to a filter that carries the plane to the texels around it, metres.
// They lie up to a texel away along u and v. The normal's own error is the cause. lateral: |n_u|, |n_v|; cosine: of the
// angle between normal and light.
float carried_error_m(vec2 texel_m, vec2 lateral, float cosine) {
    float least_cosine = max(cosine - kNormalError_rad, kNormalError_rad);
    return kNormalError_rad * dot(texel_m, 1.0 + (lateral + kNormalError_rad) / least_cosine);
}

// Tests take a share of an offset, to show that less is not enough.
#ifdef SHADOW_BIAS_SHARE
float taken(float offset) { return SHADOW_BIAS_SHARE * offset; }
#else
float taken(float offset) { return offset; }
#endif
Bias taken_bias(Bias bias) {
    bias.along_normal_m = taken(bias.along_normal_m);
    bias.depth = taken(bias.depth);
    return bias;
}

// Returns a lamp's distance from the plane that a filter carries to the texels around the receiver, metres.
// Only errors of the receiver's place and of its depth are in it: they change the plane's depths in proportion. What
// snapping and the normal's error need is the same everywhere on the plane. It lifts the receiver alone. Where a lamp
// grazes the plane it may exceed the lamp's distance, and a plane beyond the lamp falls the wrong way.
// plane_m: from the receiver's own plane; distance_m: from the receiver; error_m: how far that may be off its plane.
float carried_plane_m(float plane_m, float distance_m, float error_m) {
    return max(plane_m - taken(kRelativeRounding * plane_m + error_m), kNormalError_rad * distance_m);
}

// Returns the bias in an orthographic map. n_map: normal in the map's axes (u, v, toward the light). error_m: how far
// the receiver may be off its plane.
Bias orthographic_bias(ViewRecord view, vec3 n_map, float reach_texel, float error_m) {
    vec2 texel_m = vec2(view.axis_u.w, view.axis_v.w);
    vec2 lateral = abs(n_map.xy) + kNormalError_rad;
    float across_m = (reach_texel + kRasterSnap_texel) * dot(lateral, texel_m) + error_m;
    float cosine = n_map.z - kNormalError_rad;
    bool steep = !(length(lateral) <= kSteepTangent * cosine);
    float range_m = view.axis_back.w;
    Bias bias;
    bias.along_normal_m = steep ? across_m : 0.0;
    bias.depth = view.numeric.x + (steep ? 0.0 : across_m / (cosine * range_m));
    return taken_bias(bias);
}

// Returns the bias in a perspective map. Depth alpha + beta / z is affine in the map's coordinates on any plane, so the
// slope term is exact.
// position_map: from the light, in the map's axes (u, v, toward the light); its -z is the distance along the axis.
// tangents: |n_map.xy|, or a bound on them where the footprint reaches a neighbouring face.
// leaving: how much farther along the face's axis a metre along the normal takes the receiver, 0 if nearer. Its texel
// grows with it.
Bias perspective_bias(ViewRecord view, vec3 n_map, vec2 tangents, float leaving, vec3 position_map, float reach_texel,
                      float error_m) {
    vec2 texel_tan = vec2(view.axis_u.w, view.axis_v.w);
    float z_m = -position_map.z;
    vec2 lateral = tangents + kNormalError_rad;
    float spread = (reach_texel + kRasterSnap_texel) * dot(lateral, texel_tan);
    float across_m = spread * z_m + error_m;
    float distance_m = length(position_map);
    // Least distance of the light from the true plane: its distance from the receiver's own plane exceeds that by
    // error_m at most.
    float plane_m = -dot(n_map, position_map) - kNormalError_rad * distance_m - error_m;
    bool steep = !(sqrt(max(distance_m * distance_m - plane_m * plane_m, 0.0)) <= kSteepTangent * plane_m);
    float beta = view.axis_back.w;
    float depth = view.numeric.z + beta / z_m;
    Bias bias;
    bias.along_normal_m = steep ? across_m / (1.0 - min(spread * leaving, kMostGrowth)) : 0.0;
    bias.depth = view.numeric.x + kRelativeRounding * depth +
                 (steep ? 0.0 : beta * across_m / (z_m * plane_m));
    return taken_bias(bias);
}
