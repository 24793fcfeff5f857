// Part of a pixel's line that lies in a box of fog, before the surface that the pixel shows.
#include "common/bindings.glsl"
#include "common/view_distance.glsl"
#include "common/pixel_ray.glsl"
layout(binding = kSurfaceDepthUnit) uniform sampler2D surface_depth;

// C++ twin: FogRecord in systems/lighting/fog_record.h.
layout(std140, binding = kFogBlock) uniform FogBlock {
    vec4 to_box[3];   // a coordinate in the box, -1 to 1, each: of a direction (xyz), and of the camera's anchor (w)
    vec4 taken;       // rgb: albedo; w: extinction, per metre
    vec4 marks;       // x: anisotropy; y: offset of noise, 0 to 1; z: its shadow layers, as an integer, 0: no shadows
} fog;

// Way through fog, metres along a unit vector. Empty unless from_m < to_m.
struct FogWay {
    vec3 origin, along;
    float from_m, to_m;
};

vec3 box_direction(vec3 v) { return vec3(dot(fog.to_box[0].xyz, v), dot(fog.to_box[1].xyz, v), dot(fog.to_box[2].xyz, v)); }

vec3 box_place(vec3 position_ca) { return box_direction(position_ca) + vec3(fog.to_box[0].w, fog.to_box[1].w, fog.to_box[2].w); }

// Returns the distances at which a line enters and leaves the box. The first is the larger one where it passes by.
vec2 box_span(vec3 origin, vec3 along) {
    const float kParallel = 1e-20;   // stands for 0, which has no inverse
    vec3 place = box_place(origin), way = box_direction(along);
    way = mix(way, vec3(kParallel), lessThan(abs(way), vec3(kParallel)));
    vec3 low = (-1.0 - place) / way, high = (1.0 - place) / way;
    vec3 enters = min(low, high), leaves = max(low, high);
    return vec2(max(max(enters.x, enters.y), enters.z), min(min(leaves.x, leaves.y), leaves.z));
}

FogWay fog_way(ivec2 pixel) {
    PixelLine line = pixel_line(pixel);
    float per_depth = length(line.along);   // metres along the line for each along the view
    vec3 along = line.along / per_depth;
    vec2 span = box_span(line.origin, along);
    float depth = texelFetch(surface_depth, pixel, 0).r;
    if (depth > 0.0) span.y = min(span.y, view_distance(depth) * per_depth);
    return FogWay(line.origin, along, max(span.x, 0.0), span.y);
}
