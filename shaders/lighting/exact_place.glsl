// Where on a triangle a pixel's centre looks, in double. What the rasteriser interpolates is off by its snapping of vertices, which
// a slanted plane carries into depth, and by more than a float's rounding.
#include "shared/exact_pixel_ray.glsl"
#include "shared/exact_instances.glsl"

// Distance along the view at which the pixel's ray meets the plane of the triangle with this corner and normal, both of the model;
// what the rasteriser says where that is seen edge-on or is none.
double exact_distance(ivec2 pixel, InstanceRecord instance, vec3 corner_ms, vec3 normal_ms, float interpolated_m) {
    PixelRay ray = pixel_ray(pixel);
    dvec3 corner = exact_origin(instance, camera.anchor_high.xyz, camera.anchor_low.xyz) + exact_image(instance, corner_ms);
    dvec3 normal = exact_normal(instance, normal_ms);
    double distance_m = dot(normal, corner - ray.origin) / dot(normal, ray.along);
    const float kMostOff = 0.5;   // of the distance
    float off_m = abs(float(distance_m) - interpolated_m);
    return off_m <= kMostOff * interpolated_m ? distance_m : double(interpolated_m);
}
