// A forward renderer of one's own: Gnomon draws the depth maps, the stranger's shader asks for visibility, through
// its own GL calls. Exit code 0: the ground is dark where it should be, for every kind of light.
#include <epoxy/gl.h>

#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "engine/gl/device_gl45.h"
#include "engine/gl/shader_source.h"
#include "ground_and_box.h"
#include "own_context.h"
#include "shaders/embedded.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"

namespace {

using namespace gnomon;

int fail(const std::string& what) {
    std::fprintf(stderr, "forward: %s\n", what.c_str());
    return 1;
}

// [vertex]
/// The ground, without buffers. A position is handed on relative to the camera, as Gnomon's include wants it.
constexpr const char* kVertex = R"(#version 450 core
uniform vec3 camera_ws;
out vec3 position_ca;
void main() {
    const vec2 corners[4] = vec2[](vec2(-2, -2), vec2(2, -2), vec2(-2, 2), vec2(2, 2));
    vec2 corner = corners[gl_VertexID];
    position_ca = vec3(corner.x, 0.0, -corner.y) - camera_ws;
    gl_Position = vec4(corner / 2.0, 0.5, 1.0);
}
)";
// [vertex]

// [fragment]
constexpr const char* kFragment = R"(
#include "row.glsl"
#include "shadow/light_block.glsl"
#include "shadow/visibility.glsl"
#include "lighting/light_at.glsl"
in vec3 position_ca;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = vec3(0.0, 1.0, 0.0);   // geometric, unit, facing the viewer
    float error_m = 1.0e-6 * length(position_ca);   // how well this position is known
    LightSample incoming = light_at(position_ca);
    float visible = incoming.reaches ? shadow_visibility(position_ca, normal, error_m) : 0.0;
    colour = vec4(vec3(visible), 1.0);
}
)";
// [fragment]

// [program]
/// The fragment shader for one light: which kind and which filter is said by row.glsl and its defines.
Result<std::string> fragment_for(const shadow::ProgramRow& row) {
    const bool shadowed = !row.filter_file.empty();
    const std::string row_text = shadowed ? "#include \"" + std::string(row.kind_file) + "\"\n#include \"" +
                                                std::string(row.filter_file) + "\"\n"
                                          : std::string{};
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", row_text});
    files.push_back({"mine/forward.frag", kFragment});
    std::vector<std::string> defines = {std::string(row.kind_define) + " 1"};
    if (shadowed) {
        defines.emplace_back("SHADOWED 1");
        defines.push_back("SHADOW_REACH_TEXEL " + std::to_string(row.reach_texel));
        if (row.depths) defines.emplace_back("SHADOW_DEPTHS 1");
        if (row.moments) defines.emplace_back("SHADOW_MOMENTS 1");
        if (row.fades) defines.emplace_back("SHADOW_FADES 1");
        if (row.manual_bias) defines.emplace_back("SHADOW_MANUAL_BIAS 1");
    }
    return gl::expand_shader(files, "mine/forward.frag", defines);
}
// [program]

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

GLuint linked(GLuint vertex, GLuint fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    return good == GL_TRUE ? program : 0;
}

// [draw]
/// Draws with light `light` as Gnomon published it. The block's binding is 1, the map's texture unit 4.
void draw(const gl::Device& device, GLuint program, GLuint light_buffer, const shadow::LightingLight& light,
          const glm::dvec3& camera_ws) {
    constexpr GLuint kLightBinding = 1, kMapUnit = 4;
    const glm::vec3 camera(camera_ws);
    glUseProgram(program);
    glUniform3f(glGetUniformLocation(program, "camera_ws"), camera.x, camera.y, camera.z);
    glNamedBufferSubData(light_buffer, 0, sizeof light.record, &light.record);
    glBindBufferBase(GL_UNIFORM_BUFFER, kLightBinding, light_buffer);
    glBindTextureUnit(kMapUnit, gl::gl_name(device, light.map));
    glBindSampler(kMapUnit, gl::gl_name(device, light.sampler));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}
// [draw]

SceneSnapshot stage_with(LightKind kind, const assets::MeshLibrary& library) {
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
    // Far away on the sun's line, a lamp's shadow lies where the sun's does.
    const glm::dvec3 lamp_m = glm::dvec3(0.0, kBoxHeight_m, 0.0) + 100.0 * back;
    scene.lights = {{.entity = {1, 1},
                     .name = "light",
                     .kind = kind,
                     .position_ws_m = lamp_m,
                     .rotation_ws = {glm::cross(up, back), up, back},
                     .intensity = 50000.0f,
                     .outer_cone_rad = 0.1,
                     .has_shadow = true,
                     .shadow = {.filter = ShadowFilter::sharp_4x4, .resolution_px = 2048},
                     .version = 1}};
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

int check(LightKind kind) {
    auto device = gl::make_gl45_device({});
    if (!device) return fail(to_line(device.error()));
    const assets::MeshLibrary library = ground_and_box();
    auto gpu_scene = GpuScene::create(*device.value(), library);
    if (!gpu_scene) return fail(to_line(gpu_scene.error()));
    const SceneSnapshot scene = stage_with(kind, library);

    // [shadows]
    shadow::ShadowSystem shadows(*device.value());
    gl::CommandList commands;
    FrameReport report;
    gpu_scene.value().update(scene, commands);
    const shadow::ShadowFrame& frame = shadows.update(scene, gpu_scene.value(), true, commands, report);
    const bool drawn = device.value()->submit(commands).failure == gl::Failure::none;
    shadows.commit(scene, drawn);
    const shadow::LightingLight& light = frame.inputs.front().lights.front();
    // [shadows]
    if (!drawn || !light.map) return fail("no depth map");

    const auto fragment = fragment_for(light.row);
    if (!fragment) return fail(to_line(fragment.error()));
    const GLuint program =
        linked(compiled(GL_VERTEX_SHADER, kVertex), compiled(GL_FRAGMENT_SHADER, fragment.value().c_str()));
    if (program == 0) return fail("the program does not link");
    GLuint target = 0, picture = 0, light_buffer = 0, layout = 0;
    glCreateRenderbuffers(1, &picture);
    glNamedRenderbufferStorage(picture, GL_RGBA8, kPicture_px, kPicture_px);
    glCreateFramebuffers(1, &target);
    glNamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture);
    glCreateBuffers(1, &light_buffer);
    glNamedBufferStorage(light_buffer, sizeof(shadow::LightRecord), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glCreateVertexArrays(1, &layout);

    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glBindVertexArray(layout);
    glViewport(0, 0, kPicture_px, kPicture_px);
    draw(*device.value(), program, light_buffer, light, scene.consumers.front().position_ws_m);
    std::array<unsigned char, kPicture_px * kPicture_px * 4> rgba{};
    glReadPixels(0, 0, kPicture_px, kPicture_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    const GLenum error = glGetError();
    const auto red = [&](int column) {
        return int{rgba[static_cast<std::size_t>((kMiddleRow * kPicture_px + column) * 4)]};
    };
    std::printf("%s: visibility %d in the shadow, %d in the light, of 255\n",
                std::string(light.row.kind_define).c_str(), red(kShadowedColumn), red(kLitColumn));
    if (error != GL_NO_ERROR) return fail("OpenGL reports an error");
    if (red(kShadowedColumn) != 0 || red(kLitColumn) != 255) return fail("the shadow is not where it belongs");
    return 0;
}

}  // namespace

int main() {
    const OwnContext context;
    if (!context) return fail("no OpenGL 4.5 context");
    return check(LightKind::directional) | check(LightKind::spot) | check(LightKind::point);
}
