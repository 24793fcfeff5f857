// What fog scatters of one light toward the camera, once: added to the picture. Places along the pixel's line are
// looked up in the light's map. On its way from the light and to the camera the fog takes some.
// SHADOW_TINT: as in lighting/lights/light.frag.
#include "lighting/fog/fog_way.glsl"
#include "common/float_rounding.glsl"
#include "shadow/lookup/row_flags.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/light_vector.glsl"
#include "shadow/lookup/visibility.glsl"
#include SHADOW_TINT
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/reflected_light.glsl"
#include "lighting/post/picture_sum.glsl"
layout(location = 0) out vec4 colour_out;

const int kPlaces = 16;           // looked up per pixel and light
const float kBeyond_m = 1e30;

// Returns the distances between which a line lies in a spot's cone. `to_lamp`: from the line's origin, metres.
vec2 cone_span(vec3 to_lamp, vec3 along) {
    float cosine = light.cone.x;
    if (!kIsSpot || cosine <= 0.0) return vec2(-kBeyond_m, kBeyond_m);
    // On the cone, the way to the lamp along its axis is cosine times that way: a t^2 + 2 b t + c = 0.
    float lamp_up = dot(to_lamp, light.to_light.xyz), way_up = dot(along, light.to_light.xyz), square = cosine * cosine;
    float a = way_up * way_up - square, b = square * dot(to_lamp, along) - lamp_up * way_up;
    float c = lamp_up * lamp_up - square * dot(to_lamp, to_lamp), rest = b * b - a * c;
    if (abs(a) < 1e-6) a = a < 0.0 ? -1e-6 : 1e-6;
    float root = sqrt(max(rest, 0.0)), one = (-b - root) / a, other = (-b + root) / a;
    vec2 ends = vec2(min(one, other), max(one, other));
    if (a > 0.0) return way_up > 0.0 ? vec2(-kBeyond_m, ends.x) : vec2(ends.y, kBeyond_m);
    bool below = lamp_up - 0.5 * (ends.x + ends.y) * way_up > 0.0;
    return rest > 0.0 && below ? ends : vec2(1.0, 0.0);
}

// Returns the part of the way on which the light may arrive.
vec2 lit_span(FogWay way) {
    vec2 span = vec2(way.from_m, way.to_m);
    if (kIsSun) return span;
    vec3 to_lamp = light.position.xyz - way.origin;
    float nearest_m = dot(to_lamp, way.along), range_m = light.position.w;
    if (range_m > 0.0) {
        float square = range_m * range_m - dot(to_lamp, to_lamp) + nearest_m * nearest_m;
        float half_m = square > 0.0 ? sqrt(square) : -1.0;
        span = vec2(max(span.x, nearest_m - half_m), min(span.y, nearest_m + half_m));
    }
    vec2 cone = cone_span(to_lamp, way.along);
    return vec2(max(span.x, cone.x), min(span.y, cone.y));
}

// Place on the way: its distance, and the length that it stands for, metres.
struct FogPlace {
    float at_m, stands_for_m;
};

// Returns the place at a share of the way, 0 to 1. Before a lamp, places have equal angles as the lamp sees them: most
// lie where most light is (equi-angular sampling: Kulla and Fajardo 2012).
FogPlace fog_place(FogWay way, vec2 span, float share) {
    float whole_m = span.y - span.x;
    if (kIsSun) return FogPlace(span.x + share * whole_m, whole_m);
    vec3 to_lamp = light.position.xyz - way.origin;
    float nearest_m = dot(to_lamp, way.along);
    float aside_m = max(length(to_lamp - way.along * nearest_m), 1e-3 * whole_m);
    float first = atan((span.x - nearest_m) / aside_m), last = atan((span.y - nearest_m) / aside_m);
    float ahead = tan(mix(first, last, share));
    return FogPlace(nearest_m + aside_m * ahead, (last - first) * aside_m * (1.0 + ahead * ahead));
}

// Returns what falls on a place, lux.
vec3 falling(LightSample incoming) {
#if LIGHT_AREA
    return incoming.radiance * falling_share(incoming, incoming.to_light);
#else
    return incoming.radiance;
#endif
}

// Returns the share that goes each way, per steradian (Henyey and Greenstein 1941). `cosine`: of the turn.
float phase(float cosine) {
    const float kInverseFourPi = 0.0795774715;
    float g = fog.marks.x, base = max(1.0 + g * g - 2.0 * g * cosine, 1e-6);
    return kInverseFourPi * (1.0 - g * g) / (base * sqrt(base));
}

// Returns the length of fog between a place and the light, metres.
float fog_to_light_m(vec3 position_ca, LightSample incoming) {
    float leaves_m = max(box_span(position_ca, incoming.to_light).y, 0.0);
    return kIsSun ? leaves_m : min(leaves_m, length(light.position.xyz - position_ca));
}

// Returns the light that arrives at a place, past casters and fog.
vec3 arriving(vec3 position_ca, LightSample incoming) {
    vec3 toward = toward_light(position_ca);
    toward /= max(length(toward), 1e-30);
    bool takes = takes_shadow(fog.marks.z);
    float visible = takes ? shadow_visibility(position_ca, toward, 0.0) : 1.0;
    vec3 arrives = visible * falling(incoming) * exp(-fog.taken.w * fog_to_light_m(position_ca, incoming));
    if (kTinted && takes && visible > 0.0) arrives *= shadow_tint(position_ca, toward, 0.0);
    return arrives;
}

void main() {
    FogWay way = fog_way(ivec2(gl_FragCoord.xy));
    vec2 span = lit_span(way);
    if (!(span.x < span.y)) discard;
    // Another start for each pixel, so that steps show as noise and not as bands (Jimenez 2014).
    float start = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + fog.marks.y);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kPlaces; ++i) {
        FogPlace place = fog_place(way, span, (float(i) + start) / float(kPlaces));
        vec3 position_ca = way.origin + way.along * place.at_m;
        LightSample incoming = light_at(position_ca);
        if (!incoming.reaches) continue;
        float leaves = exp(-fog.taken.w * max(place.at_m - way.from_m, 0.0));
        sum += arriving(position_ca, incoming) * (place.stands_for_m * leaves * phase(dot(incoming.to_light, way.along)));
    }
    colour_out = vec4(in_picture(sum * fog.taken.rgb * (fog.taken.w / float(kPlaces))), 0.0);
}
