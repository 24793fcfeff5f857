// Returns the way from a point to the camera, metres; toward an orthographic one a unit vector.
#include "common/camera_block.glsl"

vec3 to_camera(vec3 position_ca) { return camera.back.w > 0.5 ? camera.back.xyz : -position_ca; }
