// From a point to where it is seen from: all the way to a camera, a unit toward an orthographic one.
#include "common/camera_block.glsl"

vec3 to_camera(vec3 position_ca) { return camera.back.w > 0.5 ? camera.back.xyz : -position_ca; }
