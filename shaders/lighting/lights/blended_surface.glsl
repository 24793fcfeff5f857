// Blended surface as a fragment shows it.
#include "common/instances.glsl"
#include "common/camera_block.glsl"
#include "common/material.glsl"
#include "common/float_rounding.glsl"
#include "lighting/gbuffer/triangle_normals.glsl"
layout(location = kPositionVarying) in vec3 fragment_position_ca;
layout(location = kNormalVarying) in vec3 fragment_normal;
layout(location = kUvVarying) in vec2 fragment_uv;
layout(location = kItemVarying) flat in uvec2 fragment_item;
layout(location = 0) out vec4 colour_out;

struct BlendedSurface {
    vec4 colour;
    InstanceRecord instance;
    uint triangle;
    vec3 geometric_normal, shading_normal;
};

BlendedSurface blended_surface() {
    BlendedSurface surface;
    surface.colour = material_colour(fragment_uv);
    surface.instance = instance_record(fragment_item.x);
    surface.triangle = fragment_item.y + uint(gl_PrimitiveID);
    surface.geometric_normal = geometric_normal(surface.instance, surface.triangle, fragment_position_ca);
    surface.shading_normal = shading_normal(fragment_normal, surface.geometric_normal);
    return surface;
}
