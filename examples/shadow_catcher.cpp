// A shadow catcher: a box that is not there throws its shadows onto a photograph.
//
// The photograph, here a pattern, is drawn first. The catcher is an invisible ground where the photograph shows one. It
// is in the depth buffer, as the box is, so that the mask holds its shadows. It is drawn as black with the share of its
// light that casters take as alpha.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

namespace {

constexpr int kGround = 6, kAll = 42;  // indices of the ground, and of ground and box
constexpr glm::vec3 kPositions[12] = {{-6, 0, -6}, {-6, 0, 6}, {6, 0, 6},  {6, 0, -6}, {-1, 0, -1}, {1, 0, -1},
                                      {-1, 2, -1}, {1, 2, -1}, {-1, 0, 1}, {1, 0, 1},  {-1, 2, 1},  {1, 2, 1}};
constexpr GLuint kIndices[kAll] = {0, 1,  2, 0, 2, 3,  5, 7,  11, 5, 11, 9, 4, 8, 10, 4, 10, 6, 6, 10, 11,
                                   6, 11, 7, 8, 9, 11, 8, 11, 10, 4, 6,  7, 4, 7, 5,  4, 5,  9, 4, 9,  8};
constexpr glm::dvec3 kToSun(3.0, 5.0, 4.0), kLamp_m(-4.0, 4.0, 1.0);

constexpr const char* kPhotograph = R"(#version 450 core
layout(location = 0) out vec4 colour;
void main() {
    vec2 at = gl_FragCoord.xy / 40.0;
    float check = mod(floor(at.x) + floor(at.y), 2.0);
    colour = vec4(0.35 + 0.1 * check, 0.4, 0.3 + 0.02 * at.y, 1.0);
})";
constexpr const char* kEveryPixel = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); })";
constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform vec3 positions[12];
layout(location = 13) uniform uint indices[42];
layout(location = 0) out vec3 place;
invariant gl_Position;
void main() { gl_Position = clip_from_world * vec4(place = positions[indices[gl_VertexID]], 1.0); })";
constexpr const char* kFragment = R"(#version 450 core
layout(location = 60) uniform bool catches;
layout(location = 61) uniform vec4 lights[2];   // xyz: position, or the way to the sun, where w is 0
layout(location = 63) uniform vec3 colours[2];
layout(location = 0) in vec3 place;
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;

// [catcher]
// Premultiplied colour of a shadow catcher. falls: light on it without casters. arrives: with them.
vec4 caught(vec3 falls, vec3 arrives) {
    const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
    float all = dot(falls, kLuminance);
    return vec4(0.0, 0.0, 0.0, all > 0.0 ? 1.0 - dot(arrives, kLuminance) / all : 0.0);
}
// [catcher]

void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 falls = vec3(0.2), arrives = falls;   // ambient light, which casters do not take
    for (int i = 0; i < 2; ++i) {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - place;
        float falloff = lights[i].w == 0.0 ? 1.0 : 1.0 / dot(way, way);
        vec3 light = colours[i] * (falloff * max(dot(normal, normalize(way)), 0.0));
        falls += light;
        arrives += light * texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, i), 0).r;
    }
    colour = catches ? caught(falls, arrives) : vec4(vec3(0.6, 0.3, 0.2) * arrives, 1.0);
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

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "shadow_catcher");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();

    // The catcher is declared as any receiver: maps are fitted to it.
    auto mesh = shadows.add_mesh({.name = "ground and box", .positions_m = kPositions, .indices = kIndices});
    if (!mesh) return fail(mesh.error());
    shadows.add_caster({.mesh = mesh.value()});
    shadows.add_light({.light = {.kind = gnomon::LightKind::directional}, .direction = -kToSun});
    shadows.add_light({.light = {.kind = gnomon::LightKind::point}, .position_m = kLamp_m});

    const GLuint photograph = make_program(kEveryPixel, kPhotograph), surfaces = make_program(kVertex, kFragment);
    const glm::vec4 lights[] = {{kToSun, 0.0}, {kLamp_m, 1.0}};
    const glm::vec3 colours[] = {glm::vec3(0.7f), {30.0f, 20.0f, 10.0f}};
    glProgramUniform3fv(surfaces, 1, 12, &kPositions[0].x);
    glProgramUniform1uiv(surfaces, 13, kAll, kIndices);
    glProgramUniform4fv(surfaces, 61, 2, &lights[0].x);
    glProgramUniform3fv(surfaces, 63, 2, &colours[0].x);
    GLuint no_vertices = 0;
    glCreateVertexArrays(1, &no_vertices);
    glBindVertexArray(no_vertices);
    glEnable(GL_FRAMEBUFFER_SRGB);  // colours are light: blending is, too

    while (window.value()->begin_frame()) {
        const glm::uvec2 size_px = window.value()->size_px();
        const glm::dmat4 clip_from_view = glm::perspective(0.9, 1.0 * size_px.x / size_px.y, 0.1, 100.0);
        const glm::dmat4 view_from_world = glm::lookAt(glm::dvec3(-4, 5, 7), glm::dvec3(0), glm::dvec3(0, 1, 0));
        const glm::mat4 clip_from_world(clip_from_view * view_from_world);
        glProgramUniformMatrix4fv(surfaces, 0, 1, GL_FALSE, &clip_from_world[0][0]);

        // Depths of all, the catcher's too.
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_BLEND);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(surfaces);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDrawArrays(GL_TRIANGLES, 0, kAll);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .depth_texture = window.value()->depth_texture(),
                                                  .size_px = size_px});
        if (mask.texture == 0) return fail({.message = "no mask: " + std::string(mask.failure), .rule = "mask"});
        glBindTextureUnit(0, mask.texture);

        glDisable(GL_DEPTH_TEST);
        glUseProgram(photograph);
        glDrawArrays(GL_TRIANGLES, 0, 3);

        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glUseProgram(surfaces);
        glProgramUniform1i(surfaces, 60, GL_FALSE);
        glDrawArrays(GL_TRIANGLES, kGround, kAll - kGround);
        // [blend]
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // into a framebuffer that encodes sRGB: it blends light
        // [blend]
        glProgramUniform1i(surfaces, 60, GL_TRUE);
        glDrawArrays(GL_TRIANGLES, 0, kGround);
        if (auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
}
