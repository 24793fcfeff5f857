// Place on a triangle's plane that a pixel's centre sees, in float, and how far off that may be. A map of sheets judges
// that place. What the rasteriser interpolates is too far off: lighting/gbuffer/surface_position_f64.glsl.
#include "common/pixel_ray.glsl"
#include "common/position_error.glsl"
#include "lighting/gbuffer/visible_triangle.glsl"

struct SeenPlace {
    vec3 position_ca;
    float error_m;      // how far off, in any direction, metres
};
const float kAnywhere_m = 1e30;

// Rounding, unit roundoffs.
// A number of normal_from_model(): the model's own, two of a cross product's, one of the product, two of the sums.
// A scalar product, and the difference that is multiplied.
// A number of pixel_line(): ndc, two products, sums.
const float kNormalUnits = 6.0, kProductUnits = 4.0, kLineUnits = 5.0;

// Returns the products that normal_from_model() adds, all as if they had one sign.
vec3 normal_products(InstanceRecord instance, vec3 normal_ms) {
    vec3 x = abs(instance.basis_x.xyz), y = abs(instance.basis_y.xyz), z = abs(instance.basis_z.xyz), n = abs(normal_ms);
    return (y.yzx * z.zxy + y.zxy * z.yzx) * n.x + (z.yzx * x.zxy + z.zxy * x.yzx) * n.y + (x.yzx * y.zxy + x.zxy * y.yzx) * n.z;
}

// Returns the place and its error. Each number counts by itself: axes of walls and grounds are often the world's, and
// what is 0 is not rounded.
SeenPlace seen_place(ivec2 pixel, SurfacePlace place) {
    InstanceRecord instance = instance_record(place.instance);
    vec3 normal_ms = triangle_normal(place.triangle).xyz, corner_ms = vertex_position(place.corner);
    vec3 normal = normal_from_model(instance, normal_ms);
    vec3 product_error = kUnitRoundoff * (kNormalUnits * normal_products(instance, normal_ms) + kProductUnits * abs(normal));
    PixelLine line = pixel_line(pixel);
    vec3 line_error = kLineUnits * kUnitRoundoff * pixel_line_sums(pixel);
    float nearing = dot(normal, line.along);
    float nearing_error = dot(product_error, abs(line.along)) + dot(abs(normal), line_error);
    vec3 ahead_m = position_from_anchor(instance, corner_ms, camera.anchor_high.xyz, camera.anchor_low.xyz) - line.origin;
    vec3 corner_error_m = placed_error_m(instance, corner_ms, camera.anchor_high.xyz, camera.anchor_low.xyz);
    if (camera.back.w > 0.5) corner_error_m += line_error;
    float ahead_error = dot(product_error, abs(ahead_m)) + dot(abs(normal), corner_error_m);
    float distance_m = dot(normal, ahead_m) / nearing;
    float error_m = (ahead_error + abs(distance_m) * nearing_error) / (abs(nearing) - nearing_error);
    bool is_known = error_m >= 0.0 && is_believed(distance_m, error_m, place.interpolated_m);
    float believed_m = is_known ? distance_m : place.interpolated_m;
    vec3 position_ca = line.origin + line.along * believed_m;
    float rounded_m = length(line_error) * max(believed_m, 1.0) + kRebuiltRelative * length(position_ca);
    return SeenPlace(position_ca, is_known ? min(error_m * length(line.along) + rounded_m, kAnywhere_m) : kAnywhere_m);
}
