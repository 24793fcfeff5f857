#include "own_renderer.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"

using namespace gnomon;

SceneSnapshot stage_with(const std::vector<LightKind>& kinds, const LightShadow& shadow,
                         const assets::MeshLibrary& library) {
    SceneSnapshot scene;
    scene.version = 1;
    scene.consumers = {{.entity = {0, 1},
                        .name = "camera",
                        .position_ws_m = {0.0, kEyeHeight_m, 0.0},
                        .rotation_ws = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                        .projection = CameraProjection::orthographic,
                        .half_height_m = kHalfHeight_m,
                        .near_m = 0.1,
                        .far_m = 20.0,
                        .viewport_px = {kPicture_px, kPicture_px}}};
    const glm::dvec3 back = glm::normalize(glm::dvec3(-1.0, 1.0, 0.0)), up = {0.0, 0.0, 1.0};
    for (const LightKind kind : kinds)
        scene.lights.push_back({.entity = {10 + static_cast<std::uint32_t>(scene.lights.size()), 1},
                                .name = "light " + std::to_string(scene.lights.size()),
                                .kind = kind,
                                .position_ws_m = glm::dvec3(0.0, kBoxHeight_m, 0.0) + 100.0 * back,
                                .rotation_ws = {glm::cross(up, back), up, back},
                                .intensity = 50000.0f,
                                .outer_cone_rad = 0.1,
                                .has_shadow = true,
                                .shadow = shadow,
                                .version = 1});
    for (const std::uint32_t mesh : {kGroundMesh, kBoxMesh}) {
        InstanceItem item;
        item.entity = {2 + mesh, 1};
        item.mesh = item.gpu_slot = mesh;
        if (mesh == kBoxMesh) item.translation_ws_m = {0.0, kBoxHeight_m, 0.0};
        item.bounds_ws = math::transformed(library.meshes[mesh].bounds_ms, item.basis, item.translation_ws_m);
        item.casts = mesh == kBoxMesh;
        item.version = 1;
        scene.changed_instances.push_back(mesh);
        scene.instances.push_back(item);
    }
    scene.gpu_slot_count = 2;
    return scene;
}

// [program]
/// Returns the fragment shader for one light. row.glsl and its defines select the kind and the filter.
Result<std::string> fragment_for(const shadow::ShaderKey& row, const char* main_text) {
    const std::string row_text = shadow::row_glsl(row);
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", row_text});
    files.push_back({"mine/main.frag", main_text});
    return gl::expand_shader(files, "mine/main.frag", shadow::program_defines(row));
}
// [program]

namespace {

GLuint compiled(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) return shader;
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    std::fprintf(stderr, "%s\n", log.data());
    return 0;
}

}  // namespace

GLuint make_program(const char* vertex, const char* fragment) {
    const GLuint first = compiled(GL_VERTEX_SHADER, vertex), second = compiled(GL_FRAGMENT_SHADER, fragment);
    if (first == 0 || second == 0) return 0;
    const GLuint program = glCreateProgram();
    glAttachShader(program, first);
    glAttachShader(program, second);
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    return good == GL_TRUE ? program : 0;
}

GLuint make_buffer(std::size_t bytes) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}
