#include "common/camera_block.glsl"

// Depth d of a perspective view is (y / z) - x, of an orthographic one (x - z) / y.
float view_distance(float depth) {
    bool orthographic = camera.back.w > 0.5;
    return orthographic ? camera.unproject.x - depth * camera.unproject.y
                        : camera.unproject.y / (depth + camera.unproject.x);
}
