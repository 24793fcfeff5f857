// Quad over as many rows as the list of rays fills.
#include "common/camera_block.glsl"
#include "lighting/trace/ray_list_layout.glsl"
#include "lighting/trace/ray_list.glsl"

void main() {
    ivec2 picture = ivec2(camera.unproject.zw);
    int width = list_width(picture), rows = list_rows(int(ray_count), width), all_rows = list_rows(picture.x * picture.y, width);
    bool is_right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4, is_above = gl_VertexID == 2 || gl_VertexID > 3;
    gl_Position = vec4(is_right ? 1.0 : -1.0, is_above ? 2.0 * float(rows) / float(all_rows) - 1.0 : -1.0, 0.0, 1.0);
}
