#include "common/camera_block.glsl"

// Returns the distance along the view of a reversed depth d, metres.
// Perspective: d = (y / z) - x. Orthographic: d = (x - z) / y.
float view_distance(float depth) {
    bool orthographic = camera.back.w > 0.5;
    return orthographic ? camera.unproject.x - depth * camera.unproject.y
                        : camera.unproject.y / (depth + camera.unproject.x);
}
