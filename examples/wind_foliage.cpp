// Grass that only a vertex shader bends casts the shadows of what that shader draws.
//
// Gnomon knows of the grass its bounds, and a function that draws it into a map. While the wind blows the engine
// announces each change; when it stands still, no map is drawn.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace {

constexpr int kBlades = 900, kRows = 6, kVerticesPerBlade = kRows * 6;
constexpr double kGust_s = 2.0;  // wind blows, then stands still for as long

// The engine's grass: no vertex buffer, all of it comes from gl_VertexID and gl_InstanceID.
constexpr const char* kGrassVertex = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform float wind_s;
out vec3 place;
void main() {
    const int rows = 6;
    int row = gl_VertexID / 6, corner = gl_VertexID % 6;
    bool right = corner == 1 || corner == 2 || corner == 4, top = corner == 2 || corner == 4 || corner == 5;
    float up = float(row + int(top)) / float(rows);
    vec2 root = vec2(gl_InstanceID % 30, gl_InstanceID / 30) * 0.2 - 3.0;
    float turn = float(gl_InstanceID) * 2.4;
    vec2 width = vec2(cos(turn), sin(turn)) * 0.05 * (1.0 - 0.8 * up) * (right ? 1.0 : -1.0);
    float bend = 0.35 * sin(2.0 * wind_s + 0.8 * root.x + 0.5 * root.y) + 0.1;
    float height = 0.7 + 0.3 * sin(turn * 3.0);
    place = vec3(root.x + width.x + bend * up * up, height * up, root.y + width.y);
    gl_Position = clip_from_world * vec4(place, 1.0);
})";
constexpr const char* kGroundVertex = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
out vec3 place;
void main() {
    vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2) * 16.0 - 8.0;
    place = vec3(corner.x, 0.0, corner.y);
    gl_Position = clip_from_world * vec4(place, 1.0);
})";
constexpr const char* kForward = R"(#version 450 core
in vec3 place;
layout(location = 2) uniform vec3 base_colour;
layout(location = 3) uniform vec3 to_sun;
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    float visible = texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, 0), 0).r;
    colour = vec4(base_colour * (0.15 + 0.85 * visible * abs(dot(normal, to_sun))), 1.0);
})";
constexpr const char* kDepthOnly = "#version 450 core\nvoid main() {}";

GLuint make_program(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    const GLenum kinds[] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
    const char* texts[] = {vertex, fragment};
    for (int i = 0; i < 2; ++i) {
        const GLuint shader = glCreateShader(kinds[i]);
        glShaderSource(shader, 1, &texts[i], nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

struct Meadow {
    GLuint grass_depth = make_program(kGrassVertex, kDepthOnly), grass = make_program(kGrassVertex, kForward);
    GLuint ground_depth = make_program(kGroundVertex, kDepthOnly), ground = make_program(kGroundVertex, kForward);
    GLuint array = 0;
    float wind_s = 0.0f;

    Meadow() { glCreateVertexArrays(1, &array); }
    void draw_grass(GLuint program, const glm::mat4& clip_from_world) const {
        glUseProgram(program);
        glBindVertexArray(array);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
        glUniform1f(1, wind_s);
        glDrawArraysInstanced(GL_TRIANGLES, 0, kVerticesPerBlade, kBlades);
    }
    void draw_ground(GLuint program, const glm::mat4& clip_from_world) const {
        glUseProgram(program);
        glBindVertexArray(array);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
};

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "wind_foliage");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    Meadow meadow;

    // The ground is a mesh that receives; the grass is drawn by the engine, within these bounds.
    const std::vector<glm::vec3> corners{{-8, 0, -8}, {8, 0, -8}, {-8, 0, 8}, {8, 0, 8}};
    const std::vector<std::uint32_t> triangles{0, 2, 1, 1, 2, 3};
    const auto ground = shadows.add_mesh({.name = "ground", .positions_m = corners, .indices = triangles});
    if (!ground) return fail(ground.error());
    shadows.add_caster({.mesh = ground.value(), .casts = false});
    const gnomon::Bounds bounds{{-3.2, 0.0, -3.2}, {3.5, 1.1, 3.2}};
    // [drawable]
    const auto draw = [&](const gnomon::DrawableView& map) {
        meadow.draw_grass(meadow.grass_depth, map.clip_from_world);
    };
    const gnomon::CasterId grass = shadows.add_drawable({.draw = draw, .bounds = bounds});
    // [drawable]
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1.0, 1.4, 0.6));
    shadows.add_light({.name = "sun", .light = {.kind = gnomon::LightKind::directional}, .direction = -to_sun});

    std::uint32_t drawn = 0, frames = 0;
    while (window.value()->begin_frame()) {
        const double time_s = window.value()->time_s();
        const double gusts = std::floor(time_s / (2.0 * kGust_s));
        const double wind_s = kGust_s * gusts + std::min(time_s - 2.0 * kGust_s * gusts, kGust_s);
        // [redraw]
        if (static_cast<float>(wind_s) != meadow.wind_s) shadows.redraw(grass, bounds);
        // [redraw]
        meadow.wind_s = static_cast<float>(wind_s);

        const glm::uvec2 size = window.value()->size_px();
        const glm::dmat4 view_from_world =
            glm::lookAt(glm::dvec3(2.5, 3.0, 5.5), glm::dvec3(0.0, 0.2, 0.0), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dmat4 clip_from_view = glm::perspective(0.8, static_cast<double>(size.x) / size.y, 0.1, 100.0);
        const glm::mat4 clip_from_world(clip_from_view * view_from_world);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        meadow.draw_ground(meadow.ground_depth, clip_from_world);
        meadow.draw_grass(meadow.grass_depth, clip_from_world);

        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .depth_texture = window.value()->depth_texture(),
                                                  .size_px = size});
        if (!mask.failure.empty()) return fail({.message = "no mask", .rule = std::string(mask.failure)});
        drawn += shadows.status().maps_drawn;
        ++frames;

        glDepthFunc(GL_EQUAL);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glBindTextureUnit(0, mask.texture);
        const glm::vec3 sun(to_sun);
        for (const GLuint program : {meadow.ground, meadow.grass}) {
            glProgramUniform3f(program, 2, program == meadow.grass ? 0.2f : 0.45f,
                               program == meadow.grass ? 0.5f : 0.4f, 0.15f);
            glProgramUniform3fv(program, 3, 1, &sun.x);
        }
        meadow.draw_ground(meadow.ground, clip_from_world);
        meadow.draw_grass(meadow.grass, clip_from_world);
        glDepthFunc(GL_LESS);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    std::printf("%u frames, %u maps drawn\n", frames, drawn);
    return 0;
}
