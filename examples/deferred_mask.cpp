// Shadows in a deferred renderer with buffers of its own: reversed depths, normals and colours.
//
// The engine draws its surfaces once. Gnomon reads their depths and normals and gives a mask with a layer per light.
// One pass over the screen adds all lights up, a texel of the mask for each. Gnomon draws its maps from the engine's
// own buffers: no mesh is copied.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace {

constexpr int kLights = 4;
constexpr double kNear_m = 0.05;

// What the engine draws: placed boxes.
struct Thing {
    glm::dvec3 at_m{0.0}, size_m{1.0};
    glm::vec3 colour{0.7f};
    bool turns = false;
    gnomon::CasterId caster = {};

    glm::dmat4 place(double time_s) const {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), at_m);
        return glm::scale(glm::rotate(moved, turns ? 0.8 * time_s : 0.0, glm::dvec3(0.0, 1.0, 0.0)), size_m);
    }
};

struct Surfaces {
    GLuint framebuffer = 0, depth = 0, normals = 0, colours = 0;
    glm::uvec2 size_px{0, 0};
};

constexpr const char* kSurfaceVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform mat4 world_from_mesh;
out vec3 world_normal;
void main() {
    world_normal = inverse(transpose(mat3(world_from_mesh))) * normal;
    gl_Position = clip_from_world * (world_from_mesh * vec4(position, 1.0));
})";
constexpr const char* kSurfaceFragment = R"(#version 450 core
in vec3 world_normal;
layout(location = 2) uniform vec3 base_colour;
layout(location = 0) out vec4 colour_out;
layout(location = 1) out vec4 normal_out;
void main() {
    colour_out = vec4(base_colour, 1.0);
    normal_out = vec4(normalize(world_normal), 0.0);
})";
constexpr const char* kEveryPixel = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); })";
constexpr const char* kLighting = R"(#version 450 core
layout(location = 0) uniform mat4 world_from_clip;
layout(location = 1) uniform vec4 lights[4];    // xyz: position, or the way to the sun, where w is 0
layout(location = 5) uniform vec3 colours[4];
layout(binding = 0) uniform sampler2D surface_depth;
layout(binding = 1) uniform sampler2D surface_normal;
layout(binding = 2) uniform sampler2D surface_colour;
layout(binding = 3) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(surface_depth, pixel, 0).r;
    colour = vec4(0.05, 0.07, 0.1, 1.0);
    if (depth == 0.0) return;   // no surface: reversed depths end at 0
    vec4 rebuilt = world_from_clip * vec4(gl_FragCoord.xy / vec2(textureSize(surface_depth, 0)) * 2.0 - 1.0, depth, 1.0);
    vec3 place = rebuilt.xyz / rebuilt.w, normal = texelFetch(surface_normal, pixel, 0).xyz;
    vec3 sum = vec3(0.04);
    for (int i = 0; i < 4; ++i) {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - place;
        float falloff = lights[i].w == 0.0 ? 1.0 : 1.0 / (1.0 + dot(way, way));
        float visible = texelFetch(shadow_mask, ivec3(pixel, i), 0).r;
        sum += colours[i] * (visible * falloff * max(dot(normal, normalize(way)), 0.0));
    }
    colour.rgb = texelFetch(surface_colour, pixel, 0).rgb * sum;
})";

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

GLuint make_program(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    const GLenum kinds[] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
    const char* texts[] = {vertex, fragment};
    for (int i = 0; i < 2; ++i) {
        const GLuint shader = glCreateShader(kinds[i]);
        glShaderSource(shader, 1, &texts[i], nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    std::fprintf(stderr, "a shader does not compile here\n");
    std::exit(2);
}

GLuint make_texture(GLenum format, glm::uvec2 size_px) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, static_cast<GLsizei>(size_px.x), static_cast<GLsizei>(size_px.y));
    return texture;
}

// Makes the surface buffers of this size, if they have another.
void fit(Surfaces& surfaces, glm::uvec2 size_px) {
    if (surfaces.size_px == size_px) return;
    const GLuint old[] = {surfaces.depth, surfaces.normals, surfaces.colours};
    glDeleteTextures(3, old);
    glDeleteFramebuffers(1, &surfaces.framebuffer);
    surfaces.size_px = size_px;
    surfaces.depth = make_texture(GL_DEPTH_COMPONENT32F, size_px);
    surfaces.normals = make_texture(GL_RGBA16F, size_px);
    surfaces.colours = make_texture(GL_RGBA8, size_px);
    glCreateFramebuffers(1, &surfaces.framebuffer);
    glNamedFramebufferTexture(surfaces.framebuffer, GL_COLOR_ATTACHMENT0, surfaces.colours, 0);
    glNamedFramebufferTexture(surfaces.framebuffer, GL_COLOR_ATTACHMENT1, surfaces.normals, 0);
    glNamedFramebufferTexture(surfaces.framebuffer, GL_DEPTH_ATTACHMENT, surfaces.depth, 0);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(surfaces.framebuffer, 2, both);
}

// A box of edge 1: position and normal per vertex, 16 bits per index.
struct Vertex {
    glm::vec3 position, normal;
};
struct Box {
    GLuint array = 0, vertex_buffer = 0, index_buffer = 0;
    std::uint32_t vertex_count = 0, index_count = 0;
};
Box make_box() {
    std::vector<Vertex> vertices;
    std::vector<std::uint16_t> indices;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5f, 0.5f}) {
            glm::vec3 out(0.0f), u(0.0f), v(0.0f);
            out[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 0.5f;
            for (const int corner : {0, 1, 2, 0, 2, 3})
                indices.push_back(static_cast<std::uint16_t>(vertices.size() + corner));
            for (const glm::vec3& corner : {out - u - v, out + u - v, out + u + v, out - u + v})
                vertices.push_back({corner, 2.0f * out});
        }
    Box box;
    box.vertex_count = static_cast<std::uint32_t>(vertices.size());
    box.index_count = static_cast<std::uint32_t>(indices.size());
    glCreateBuffers(1, &box.vertex_buffer);
    glNamedBufferStorage(box.vertex_buffer, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                         0);
    glCreateBuffers(1, &box.index_buffer);
    glNamedBufferStorage(box.index_buffer, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                         indices.data(), 0);
    glCreateVertexArrays(1, &box.array);
    glVertexArrayVertexBuffer(box.array, 0, box.vertex_buffer, 0, sizeof(Vertex));
    glVertexArrayElementBuffer(box.array, box.index_buffer);
    for (const GLuint attribute : {0u, 1u}) {
        glEnableVertexArrayAttrib(box.array, attribute);
        glVertexArrayAttribFormat(box.array, attribute, 3, GL_FLOAT, GL_FALSE, attribute * sizeof(glm::vec3));
        glVertexArrayAttribBinding(box.array, attribute, 0);
    }
    return box;
}

std::vector<Thing> make_things() {
    std::vector<Thing> things;
    const auto add = [&](const glm::dvec3& at_m, const glm::dvec3& size_m, const glm::vec3& colour,
                         bool turns = false) {
        things.push_back({at_m, size_m, colour, turns});
    };
    add({0.0, -0.1, 0.0}, {16.0, 0.2, 16.0}, {0.6f, 0.58f, 0.55f});
    add({0.0, 2.0, -4.0}, {12.0, 4.0, 0.3}, {0.5f, 0.55f, 0.6f});
    for (int i = 0; i < 6; ++i)
        add({-4.0 + 1.6 * i, 0.5 + 0.15 * i, -1.5 + 0.5 * (i % 2)}, {0.5, 1.0 + 0.3 * i, 0.5}, {0.7f, 0.5f, 0.35f});
    add({0.0, 1.4, 2.0}, {2.4, 0.25, 0.25}, {0.3f, 0.6f, 0.5f}, true);
    return things;
}

// Projection with reversed depths and no far plane: 1 at the near plane, toward 0 far away.
glm::dmat4 reversed_perspective(double fov_y_rad, double aspect) {
    const double scale = 1.0 / std::tan(0.5 * fov_y_rad);
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = scale / aspect;
    clip_from_view[1][1] = scale;
    clip_from_view[2][3] = -1.0;
    clip_from_view[3][2] = kNear_m;
    return clip_from_view;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "deferred_mask");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());

    const GLuint surface_program = make_program(kSurfaceVertex, kSurfaceFragment);
    const GLuint lighting_program = make_program(kEveryPixel, kLighting);
    const Box box = make_box();
    GLuint no_vertices = 0;
    glCreateVertexArrays(1, &no_vertices);
    Surfaces surfaces;
    std::vector<Thing> things = make_things();

    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    // [buffers]
    const auto mesh = shadows.add_buffer_mesh({.name = "box",
                                               .vertex_buffer = box.vertex_buffer,
                                               .index_buffer = box.index_buffer,
                                               .stride_bytes = sizeof(Vertex),
                                               .vertex_count = box.vertex_count,
                                               .index_size = gnomon::IndexSize::u16,
                                               .index_count = box.index_count,
                                               .bounds = {.min_m = glm::dvec3(-0.5), .max_m = glm::dvec3(0.5)}});
    if (!mesh) return fail(mesh.error());
    // [buffers]
    for (Thing& thing : things)
        thing.caster = shadows.add_caster({.mesh = mesh.value(), .world_from_mesh = thing.place(0.0)});

    const std::array<glm::vec4, kLights> lights = {
        {{-4.0f, 7.0f, 5.0f, 0.0f}, {-5.0f, 2.5f, 2.0f, 1.0f}, {4.5f, 3.0f, 1.5f, 1.0f}, {0.0f, 3.2f, 0.5f, 1.0f}}};
    const std::array<glm::vec3, kLights> colours = {
        {{0.45f, 0.43f, 0.4f}, {9.0f, 4.0f, 1.5f}, {1.5f, 5.0f, 9.0f}, {3.0f, 3.0f, 2.5f}}};
    for (const glm::vec4& light : lights)
        shadows.add_light(
            {.light = {.kind = light.w == 0.0f ? gnomon::LightKind::directional : gnomon::LightKind::point},
             .position_m = light,
             .direction = -glm::dvec3(light)});

    while (window.value()->begin_frame()) {
        const glm::uvec2 size_px = window.value()->size_px();
        fit(surfaces, size_px);
        const glm::dmat4 view_from_world =
            glm::lookAt(glm::dvec3(2.0, 4.0, 9.0), glm::dvec3(0.0, 1.0, -1.0), {0, 1, 0});
        const glm::dmat4 clip_from_view = reversed_perspective(0.9, static_cast<double>(size_px.x) / size_px.y);
        const glm::dmat4 clip_from_world_exact = clip_from_view * view_from_world;
        const glm::mat4 clip_from_world(clip_from_world_exact), world_from_clip(glm::inverse(clip_from_world_exact));

        // Surfaces.
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glBindFramebuffer(GL_FRAMEBUFFER, surfaces.framebuffer);
        glDisable(GL_FRAMEBUFFER_SRGB);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glClearDepth(0.0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(surface_program);
        glBindVertexArray(box.array);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
        for (const Thing& thing : things) {
            const glm::dmat4 exact = thing.place(window.value()->time_s());
            shadows.set_transform(thing.caster, exact);
            const glm::mat4 place(exact);
            glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
            glUniform3fv(2, 1, &thing.colour.x);
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(box.index_count), GL_UNSIGNED_SHORT, nullptr);
        }

        // Shadows of all lights, by the surfaces' own depths and normals.
        // [mask]
        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .clip_depth = gnomon::ClipDepth::zero_to_one,
                                                  .depth_texture = surfaces.depth,
                                                  .size_px = size_px,
                                                  .normal_texture = surfaces.normals});
        // [mask]
        if (!mask.failure.empty()) return fail({.message = "no mask", .rule = std::string(mask.failure)});

        // Lighting.
        glBindFramebuffer(GL_FRAMEBUFFER, window.value()->framebuffer());
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glUseProgram(lighting_program);
        glBindVertexArray(no_vertices);
        const GLuint textures[] = {surfaces.depth, surfaces.normals, surfaces.colours, mask.texture};
        glBindTextures(0, 4, textures);
        glUniformMatrix4fv(0, 1, GL_FALSE, &world_from_clip[0][0]);
        glUniform4fv(1, kLights, &lights[0].x);
        glUniform3fv(5, kLights, &colours[0].x);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    return 0;
}
