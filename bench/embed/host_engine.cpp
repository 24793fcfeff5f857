#include "bench/embed/host_engine.h"

#include <epoxy/gl.h>

#include <array>
#include <glm/gtc/matrix_inverse.hpp>

namespace gnomon::bench {
namespace {

constexpr int kWorldFromClip = 2, kCount = 3, kLights = 4;
constexpr int kIndices = kLights + static_cast<int>(kMostHostLights);

constexpr const char* kSurfaceVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv_in;
layout(location = 0) uniform mat4 view_from_mesh[2];   // 0: to clip space; 1: from the camera, world axes
out vec3 place;
out vec2 uv;
void main() {
    uv = uv_in;
    place = (view_from_mesh[1] * vec4(position, 1.0)).xyz;
    gl_Position = view_from_mesh[0] * vec4(position, 1.0);
})";

constexpr const char* kSurfaceFragment = R"(#version 450 core
in vec3 place;
in vec2 uv;
layout(location = 2) uniform float cutoff;   // 0: nothing is cut out
layout(binding = 0) uniform sampler2D mask;
layout(location = 0) out vec4 normal;
void main() {
    if (cutoff > 0.0 && texture(mask, uv).r < cutoff) discard;
    vec3 across = cross(dFdx(place), dFdy(place));
    normal = vec4(normalize(dot(across, place) > 0.0 ? -across : across), 0.0);
})";

constexpr const char* kEveryPixel = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); })";

// As a deferred renderer lights: the share of each light times its cosine.
constexpr const char* kLighting = R"(
layout(binding = 0) uniform sampler2D depths;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2DArray shadow_mask;
layout(location = 2) uniform mat4 world_from_clip;   // relative to the camera
layout(location = 3) uniform int count;
layout(location = 4) uniform vec4 lights[8];
layout(location = 12) uniform int indices[8];
layout(location = 0) out float lit;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    lit = 0.0;
    if (depth == 0.0) return;
    vec4 place = world_from_clip * vec4(2.0 * gl_FragCoord.xy / vec2(textureSize(depths, 0)) - 1.0, depth, 1.0);
    vec3 position = place.xyz / place.w, normal = texelFetch(normals, pixel, 0).xyz;
    int i = 0;
    do {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - position;
        lit += SHADOW(indices[i]) * max(dot(normal, normalize(way)), 0.0);
    } while (++i < count);
})";

const char* shadow_of(HostShadows shadows) {
    switch (shadows) {
        case HostShadows::none:
            return "#define SHADOW(i) 1.0\n";
        case HostShadows::mask:
            return "#define SHADOW(i) texelFetch(shadow_mask, ivec3(pixel, i), 0).r\n";
        case HostShadows::lookup:
            return "#define SHADOW(i) gnomon_uniform_visibility(i, position, normal)\n";
    }
    return "";
}

std::string log_of(GLuint program) {
    std::array<char, 1024> text{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(text.size()), nullptr, text.data());
    return text.data();
}

Result<unsigned> linked(const char* vertex, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    for (const auto& [kind, text] :
         {std::pair(GL_VERTEX_SHADER, vertex), std::pair(GL_FRAGMENT_SHADER, fragment.c_str())}) {
        const GLuint shader = glCreateShader(static_cast<GLenum>(kind));
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    Error error{"the engine's shader does not link: " + log_of(program), "", "", "bench.program"};
    glDeleteProgram(program);
    return error;
}

template <class T>
GLuint buffer_of(const std::vector<T>& values) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), 0);
    return buffer;
}

GLuint texture_of(GLenum format, glm::uvec2 size_px) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, static_cast<GLsizei>(size_px.x), static_cast<GLsizei>(size_px.y));
    return texture;
}

void begin_pass(GLuint framebuffer, glm::uvec2 size_px) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(size_px.x), static_cast<GLsizei>(size_px.y));
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    for (const GLenum state : {GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND, GL_DEPTH_TEST}) glDisable(state);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace

HostEngine::HostEngine(const HostScene& scene, glm::uvec2 size_px) : size_px_(size_px), parts_(scene.parts) {
    for (const HostMesh& host : scene.meshes) {
        Mesh& mesh = meshes_.emplace_back();
        mesh.vertices = buffer_of(host.positions_m);
        mesh.indices = buffer_of(host.indices);
        mesh.count = static_cast<int>(host.indices.size());
        glCreateVertexArrays(1, &mesh.array);
        const auto attribute = [&](GLuint at, GLuint buffer, GLint components) {
            glEnableVertexArrayAttrib(mesh.array, at);
            glVertexArrayAttribFormat(mesh.array, at, components, GL_FLOAT, GL_FALSE, 0);
            glVertexArrayAttribBinding(mesh.array, at, at);
            glVertexArrayVertexBuffer(mesh.array, at, buffer, 0, components * static_cast<GLsizei>(sizeof(float)));
        };
        attribute(0, mesh.vertices, 3);
        glVertexArrayElementBuffer(mesh.array, mesh.indices);
        if (host.uvs.empty()) continue;
        mesh.uvs = buffer_of(host.uvs);
        attribute(1, mesh.uvs, 2);
        mesh.mask = texture_of(GL_R8, host.mask_px);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(mesh.mask, 0, 0, 0, static_cast<GLsizei>(host.mask_px.x),
                            static_cast<GLsizei>(host.mask_px.y), GL_RED, GL_UNSIGNED_BYTE, host.alpha.data());
        glTextureParameteri(mesh.mask, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        mesh.cutoff = host.cutoff;
    }
    depth_ = texture_of(GL_DEPTH_COMPONENT32F, size_px);
    normals_ = texture_of(GL_RGBA16F, size_px);
    lit_ = texture_of(GL_R32F, size_px);
    glCreateFramebuffers(1, &surfaces_);
    glNamedFramebufferTexture(surfaces_, GL_DEPTH_ATTACHMENT, depth_, 0);
    glNamedFramebufferTexture(surfaces_, GL_COLOR_ATTACHMENT0, normals_, 0);
    glCreateFramebuffers(1, &picture_);
    glNamedFramebufferTexture(picture_, GL_COLOR_ATTACHMENT0, lit_, 0);
    glCreateVertexArrays(1, &no_vertices_);
    if (const auto program = linked(kSurfaceVertex, kSurfaceFragment)) surface_program_ = program.value();
}

HostEngine::~HostEngine() {
    for (const Mesh& mesh : meshes_) {
        const std::array buffers{mesh.vertices, mesh.uvs, mesh.indices};
        glDeleteBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
        glDeleteTextures(1, &mesh.mask);
        glDeleteVertexArrays(1, &mesh.array);
    }
    const std::array textures{depth_, normals_, lit_};
    glDeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
    const std::array framebuffers{surfaces_, picture_};
    glDeleteFramebuffers(static_cast<GLsizei>(framebuffers.size()), framebuffers.data());
    glDeleteVertexArrays(1, &no_vertices_);
    glDeleteProgram(surface_program_);
}

Result<unsigned> HostEngine::make_shader(HostShadows shadows, const std::string& lookups) {
    return linked(kEveryPixel, "#version 450 core\n" + lookups + shadow_of(shadows) + kLighting);
}

void HostEngine::free_shader(unsigned program) {
    glUseProgram(0);  // a deleted program that is in use could not be bound again
    glDeleteProgram(program);
}

void HostEngine::draw_surfaces(const HostCamera& camera) const {
    begin_pass(surfaces_, size_px_);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    const float far = 0.0f;
    const std::array<float, 4> none{};
    glClearNamedFramebufferfv(surfaces_, GL_DEPTH, 0, &far);
    glClearNamedFramebufferfv(surfaces_, GL_COLOR, 0, none.data());
    glUseProgram(surface_program_);
    const glm::dmat4 axes(glm::dmat3(camera.world_from_view));
    const glm::dmat4 view_from_world = glm::affineInverse(camera.world_from_view);
    glBindSampler(0, 0);
    for (const HostPart& part : parts_) {
        const Mesh& mesh = meshes_[part.mesh];
        const glm::dmat4 view_from_mesh = view_from_world * part.world_from_mesh;
        const std::array matrices{glm::mat4(camera.clip_from_view * view_from_mesh), glm::mat4(axes * view_from_mesh)};
        glUniformMatrix4fv(0, 2, GL_FALSE, &matrices[0][0][0]);
        glUniform1f(2, mesh.cutoff);
        glBindTextureUnit(0, mesh.mask);
        glBindVertexArray(mesh.array);
        glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
    }
}

void HostEngine::draw_lights(unsigned program, const HostCamera& camera, std::span<const HostLight> lights,
                             unsigned mask) const {
    begin_pass(picture_, size_px_);
    glUseProgram(program);
    const std::array textures{depth_, normals_, mask};
    for (GLuint unit = 0; unit < textures.size(); ++unit) {
        glBindTextureUnit(unit, textures[unit]);
        glBindSampler(unit, 0);
    }
    const glm::dmat4 axes(glm::dmat3(camera.world_from_view));
    const glm::mat4 world_from_clip(axes * glm::inverse(camera.clip_from_view));
    glUniformMatrix4fv(kWorldFromClip, 1, GL_FALSE, &world_from_clip[0][0]);
    glUniform1i(kCount, static_cast<GLint>(lights.size()));
    for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
        const HostLight& light = lights[static_cast<std::size_t>(i)];
        glUniform4fv(kLights + i, 1, &light.place[0]);
        glUniform1i(kIndices + i, light.index);
    }
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> HostEngine::read_lit() const {
    std::vector<float> values(std::size_t{size_px_.x} * size_px_.y);
    glGetTextureImage(lit_, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    return values;
}

}  // namespace gnomon::bench
