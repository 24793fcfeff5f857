// Offsets that a user chooses instead of the automatic one, to compare with it. One function per mode of BiasMode
// (include/gnomon/shadow_tuning.h), and a line in manual_bias(). docs/explanation/bias.md explains each, with its
// source.
const int kConstantBias = 1;
const int kSlopeBias = 2;
const int kNormalOffsetBias = 3;
const int kReceiverPlaneBias = 4;
const int kTutorialConstantBias = 5;
const int kTutorialCosineBias = 6;
const int kTutorialTangentBias = 7;

struct BiasPlace {
    float cosine;        // cosine of the angle between the receiver's normal and the way to the light
    float texel_m;       // longer side of a texel, across the light at the receiver, metres
    float depth_per_m;   // reversed depth per metre toward the light
    float distance_m;    // from a point light, metres; 0: a flat map
    float beta_over_z;   // that part of a perspective depth
};

BiasPlace orthographic_place(ViewRecord view, float cosine, float range_m) {
    float w = range_m / view.axis_back.w;   // homogeneous w in a warped map; else 1
    return BiasPlace(cosine, max(view.axis_u.w, view.axis_v.w) * w, 1.0 / range_m, 0.0, 0.0);
}

// Returns the place of a receiver in a perspective map. position: from the light; z_m: its part along the view's axis.
BiasPlace perspective_place(ViewRecord view, vec3 normal, vec3 position, float z_m) {
    float cosine = -dot(normal, position) / length(position), beta = view.axis_back.w;
    return BiasPlace(cosine, max(view.axis_u.w, view.axis_v.w) * z_m, beta / (z_m * z_m), 0.0, beta / z_m);
}

float incidence_sine(BiasPlace at) { return sqrt(max(1.0 - at.cosine * at.cosine, 0.0)); }
// Returns the tangent of the angle of incidence, bounded by the normal's own error.
float incidence_tangent(BiasPlace at) { return incidence_sine(at) / max(at.cosine, kNormalError_rad); }

float constant_depth(BiasPlace at) { return light.bias.x * at.depth_per_m; }

// Returns a bias of `amount` as the tutorials mean it. In a flat map it is a share of the whole depth range. In a cube
// it is metres toward the light, since the tutorials store distances there.
Bias tutorial_bias(BiasPlace at, float amount) {
    if (at.distance_m == 0.0) return Bias(0.0, amount);
    return Bias(0.0, at.beta_over_z * amount / max(at.distance_m - amount, kUnitRoundoff * at.distance_m));
}

Bias constant_bias(BiasPlace at) { return Bias(0.0, constant_depth(at)); }

Bias slope_bias(BiasPlace at) {
    return Bias(0.0, constant_depth(at) + light.bias.z * at.texel_m * incidence_tangent(at) * at.depth_per_m);
}

Bias normal_offset_bias(BiasPlace at) {
    return Bias(light.bias.z * at.texel_m * incidence_sine(at), constant_depth(at));
}

// Returns the constant part; receiver_plane_margin() adds the rest where taps are compared.
Bias receiver_plane_bias(BiasPlace at) { return Bias(0.0, constant_depth(at)); }

// Returns LearnOpenGL's first bias. The next two functions return its second one and opengl-tutorial's.
Bias tutorial_constant_bias(BiasPlace at) { return tutorial_bias(at, 0.005); }

Bias tutorial_cosine_bias(BiasPlace at) { return tutorial_bias(at, max(0.05 * (1.0 - at.cosine), 0.005)); }

Bias tutorial_tangent_bias(BiasPlace at) {
    return tutorial_bias(at, clamp(0.005 * incidence_tangent(at), 0.0, 0.01));
}

Bias manual_bias(BiasPlace at) {
    at.cosine = clamp(at.cosine, 0.0, 1.0);
    switch (light.options.y) {
        case kSlopeBias: return slope_bias(at);
        case kNormalOffsetBias: return normal_offset_bias(at);
        case kReceiverPlaneBias: return receiver_plane_bias(at);
        case kTutorialConstantBias: return tutorial_constant_bias(at);
        case kTutorialCosineBias: return tutorial_cosine_bias(at);
        case kTutorialTangentBias: return tutorial_tangent_bias(at);
    }
    return constant_bias(at);
}

// Returns whether a tap is compared with the receiver's plane where the tap lies (Isidoro 2006). The texel that it
// reads has its middle elsewhere. So bias_texel texels of the plane's slope (reversed depth per texel) are added to all
// taps.
bool compares_on_plane() { return light.options.y == kReceiverPlaneBias; }

float receiver_plane_margin(vec2 slope) { return light.bias.z * (abs(slope.x) + abs(slope.y)); }
