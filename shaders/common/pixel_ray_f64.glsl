// Line that a pixel's centre sees, in double.
#include "common/camera_block.glsl"

// Line from `origin` on, one metre along the view for each unit of t.
struct PixelRay {
    dvec3 origin, along;
};

PixelRay pixel_ray(ivec2 pixel) {
    dvec2 ndc = (dvec2(pixel) + 0.5) / dvec2(camera.unproject.zw) * 2.0 - 1.0 + dvec2(camera.lens.xy);
    dvec3 lateral = dvec3(camera.right.xyz) * (ndc.x * double(camera.right.w)) + dvec3(camera.up.xyz) * (ndc.y * double(camera.up.w));
    dvec3 ahead = -dvec3(camera.back.xyz);
    return camera.back.w > 0.5 ? PixelRay(lateral, ahead) : PixelRay(dvec3(0.0), lateral + ahead);
}
