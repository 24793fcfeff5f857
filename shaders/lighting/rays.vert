// As many rows of a picture as the list of rays fills.
#include "shared/camera_block.glsl"
#include "lighting/ray_list.glsl"

void main() {
    uint width = uint(camera.unproject.z), rows = (ray_count + width - 1u) / width;
    float top = 2.0 * float(rows) / camera.unproject.w - 1.0;
    bool is_right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4, is_above = gl_VertexID == 2 || gl_VertexID > 3;
    gl_Position = vec4(is_right ? 1.0 : -1.0, is_above ? top : -1.0, 0.0, 1.0);
}
