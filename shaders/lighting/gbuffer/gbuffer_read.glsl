// Surface buffers as the light passes read them.
#include "common/bindings.glsl"
#include "shadow/lookup/row_flags.glsl"
#include "common/view_distance.glsl"
#include "common/pixel_ray.glsl"
#include "common/view_vector.glsl"
#include "common/unit.glsl"
#include "common/octahedral.glsl"
#include "common/float_rounding.glsl"
layout(binding = kSurfaceDepthUnit) uniform sampler2D surface_depth;
layout(binding = kSurfaceColourUnit) uniform sampler2D surface_colour;
layout(binding = kSurfaceNormalUnit) uniform sampler2D surface_normals;     // shading normal, geometric normal
layout(binding = kSurfaceMaterialUnit) uniform sampler2D surface_material;    // metallic, roughness, shadow layers / 255, unlit
layout(binding = kSurfacePlaceUnit) uniform usampler2D surface_places;     // see lighting/gbuffer/visible_triangle.glsl

struct Surface {
    bool exists;
    vec3 position_ca;     // from the camera's anchor, metres
    vec3 to_viewer;
    vec3 shading_normal;
    vec3 geometric_normal;
    vec3 colour;
    float metallic, roughness;
    float shadow_layers;  // layers with shadows that fall on it, as an integer
    bool unlit;           // shows its colour in any light
    float error_m;        // how far position_ca may be off the true surface, metres
    uvec4 place;          // packed; for rays
};

vec3 surface_position(ivec2 pixel, float depth) { return position_seen_at(pixel, view_distance(depth)); }

// Returns how far a position rebuilt from depth may be off, metres. Rebuilding rounds. The rasteriser may have moved
// corners by half a sub-pixel step (2^-9 pixel) each way: by half its diagonal.
const float kHalfDiagonal = 0.70711;   // half-diagonal of a square with side 1
float surface_error_m(vec3 position_ca) {
    bool orthographic = camera.back.w > 0.5;
    float distance_m = length(position_ca);
    float pixel = 2.0 * camera.up.w / camera.unproject.w;
    float pixel_m = orthographic ? pixel : pixel * distance_m;
    float depth_m = orthographic ? kFlatRebuiltRelative * camera.unproject.y : 0.0;
    float imported_m = orthographic ? camera.lens.z : (camera.lens.z + camera.lens.w * distance_m) * distance_m;
    return kRebuiltRelative * distance_m + depth_m + pixel_m * (kHalfDiagonal * kRasterSnap_texel) + imported_m;
}

Surface read_surface(ivec2 pixel) {
    Surface s;
    float depth = texelFetch(surface_depth, pixel, 0).r;
    s.exists = depth > 0.0;
    s.position_ca = surface_position(pixel, depth);
    s.to_viewer = unit_or(to_camera(s.position_ca), camera.back.xyz);
    vec4 normals = texelFetch(surface_normals, pixel, 0);
    s.shading_normal = unit_from_octahedral(normals.xy);
    s.geometric_normal = unit_from_octahedral(normals.zw);
    s.colour = texelFetch(surface_colour, pixel, 0).rgb;
    vec4 m = texelFetch(surface_material, pixel, 0);
    s.metallic = m.r;
    s.roughness = m.g;
    s.shadow_layers = m.b * 255.0;
    s.unlit = m.a > 0.5;
    s.error_m = surface_error_m(s.position_ca);
    if (kAsksRays) s.place = texelFetch(surface_places, pixel, 0);
    return s;
}
