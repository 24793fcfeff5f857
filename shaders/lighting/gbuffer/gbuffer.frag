// Fills the surface buffers, and starts the picture with what requires no light pass: ambient and emitted light. UNLIT:
// the colour as it is.
#include "common/instances.glsl"
#include "common/camera_block.glsl"
#include "common/material.glsl"
#include "common/octahedral.glsl"
#include "lighting/gbuffer/triangle_normals.glsl"
#include "lighting/lights/own_light.glsl"
layout(location = kPositionVarying) in vec3 fragment_position_ca;
layout(location = kNormalVarying) in vec3 fragment_normal;
layout(location = kUvVarying) in vec2 fragment_uv;
layout(location = kItemVarying) flat in uvec2 fragment_item;
layout(location = 0) out vec4 colour_out;
layout(location = 1) out vec4 normals_out;
layout(location = 2) out vec4 material_out;
layout(location = 3) out vec4 picture_out;
#ifdef WRITE_PLACES   // for lights by rays
#include "lighting/gbuffer/visible_triangle.glsl"
layout(location = kCornerVarying) flat in uint corner;
layout(location = 4) out uvec4 place_out;
void write_place(uint triangle) {
    float interpolated_m = -dot(fragment_position_ca, camera.back.xyz);
    place_out = packed_place(SurfacePlace(interpolated_m, corner, fragment_item.x, triangle));
}
#else
void write_place(uint triangle) {}
#endif

void main() {
    vec4 colour = material_colour(fragment_uv);
    if (cut_out(fragment_uv)) discard;
    InstanceRecord instance = instance_record(fragment_item.x);
    uint triangle = fragment_item.y + uint(gl_PrimitiveID);
    vec3 geometric = geometric_normal(instance, triangle, fragment_position_ca);
    vec3 shading = shading_normal(fragment_normal, geometric);
    colour_out = vec4(colour.rgb, 1.0);
    normals_out = vec4(octahedral_from_unit(shading), octahedral_from_unit(geometric));
    material_out = vec4(material.metallic, material.roughness, received_layers(instance) / 255.0, material.emissive.w);
    picture_out = vec4(own_light(colour.rgb, shading), kUnlit ? 2.0 : 1.0);
    write_place(triangle);
}
