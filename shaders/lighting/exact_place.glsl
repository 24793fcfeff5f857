// Where on a triangle a pixel's centre looks, in double. What the rasteriser interpolates is off by its snapping of vertices, which
// a slanted plane carries into depth, and by more than a float's rounding.
#include "shared/exact_pixel_ray.glsl"
#include "shared/exact_instances.glsl"

const double kResidualStep = 5.83215702303235e-11lf;   // 2^-25 / 511

// Of the model, right to 2^-35 along each axis: append_plane_normals() in systems/extract/gpu_scene.h. A float's normal would leave a
// place off its plane by as much as the next triangle bends away beside a terminator.
dvec3 plane_normal(uint triangle) {
    vec4 rounded = triangle_normal(triangle);
    int bits = int(texelFetch(normal_texels, int(triangle)).w);
    ivec3 residual = ivec3(bitfieldExtract(bits, 0, 10), bitfieldExtract(bits, 10, 10), bitfieldExtract(bits, 20, 10));
    return dvec3(rounded.xyz) + dvec3(residual) * kResidualStep;
}

// Distance along the view at which the pixel's ray meets the plane of a triangle, one of whose corners this is, of the model;
// what the rasteriser says where that is seen edge-on or is none.
double exact_distance(ivec2 pixel, InstanceRecord instance, vec3 corner_ms, uint triangle, float interpolated_m) {
    PixelRay ray = pixel_ray(pixel);
    dvec3 corner = exact_origin(instance, camera.anchor_high.xyz, camera.anchor_low.xyz) + exact_image(instance, corner_ms);
    dvec3 normal = exact_normal(instance, plane_normal(triangle));
    double distance_m = dot(normal, corner - ray.origin) / dot(normal, ray.along);
    const float kMostOff = 0.5;   // of the distance
    float off_m = abs(float(distance_m) - interpolated_m);
    return off_m <= kMostOff * interpolated_m ? distance_m : double(interpolated_m);
}
