// Place on a triangle that a pixel's centre sees, in double. What the rasteriser interpolates is off by its snapping of
// vertices, which a slanted plane carries into depth, and by more than a float's rounding.
#include "common/pixel_ray_f64.glsl"
#include "common/instances_f64.glsl"
#include "lighting/gbuffer/visible_triangle.glsl"

const double kResidualStep = 5.83215702303235e-11lf;   // 2^-25 / 511

// Returns the normal of a triangle's plane in the model, right to 2^-35 along each axis: append_plane_normals() in
// systems/extract/gpu_scene.h. A float's normal would leave a place off its plane by as much as the next triangle bends
// away beside a terminator.
dvec3 plane_normal(uint triangle) {
    vec4 rounded = triangle_normal(triangle);
    int bits = int(texelFetch(normal_texels, int(triangle)).w);
    ivec3 residual = ivec3(bitfieldExtract(bits, 0, 10), bitfieldExtract(bits, 10, 10), bitfieldExtract(bits, 20, 10));
    return dvec3(rounded.xyz) + dvec3(residual) * kResidualStep;
}

// Returns where the pixel's ray meets the triangle's plane, from the camera's anchor, metres.
dvec3 exact_place(ivec2 pixel, SurfacePlace place) {
    InstanceRecord instance = instance_record(place.instance);
    PixelRay ray = pixel_ray(pixel);
    dvec3 corner_ca = exact_origin(instance, camera.anchor_high.xyz, camera.anchor_low.xyz) + exact_image(instance, vertex_position(place.corner));
    dvec3 normal = exact_normal(instance, plane_normal(place.triangle));
    double distance_m = dot(normal, corner_ca - ray.origin) / dot(normal, ray.along);
    if (!is_believed(float(distance_m), 0.0, place.interpolated_m)) distance_m = double(place.interpolated_m);
    return ray.origin + ray.along * distance_m;
}
