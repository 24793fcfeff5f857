// Beams of lamps in fog: a volume shader that looks shadows up in the air.
//
// The fog is a receiver without a surface: a box of air, so that maps hold what darkens it.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace {

constexpr int kLamps = 3, kBars = 9;

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform mat4 world_from_mesh;
out vec3 place;
void main() {
    place = (world_from_mesh * vec4(position, 1.0)).xyz;
    gl_Position = clip_from_world * vec4(place, 1.0);
})";
constexpr const char* kSurface = R"(
in vec3 place;
layout(location = 2) uniform vec3 camera;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place))), sum = vec3(0.02);
    for (int i = 0; i < 3; ++i) {
        vec3 way = lamps[i] - place;
        float lit = max(dot(normal, normalize(way)), 0.0) * 12.0 / dot(way, way);
        sum += tints[i] * (lit * gnomon_uniform_visibility(i, place - camera, normal));
    }
    colour = vec4(0.6 * sum, 1.0);
})";
constexpr const char* kScreen = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); })";
constexpr const char* kFog = R"(
layout(location = 0) uniform mat4 camera_from_clip;   // gives positions from the camera, in the world's axes
layout(location = 2) uniform vec3 camera;
layout(location = 3) uniform vec2 size_px;
layout(binding = 15) uniform sampler2D depths;
layout(location = 0) out vec4 colour;
void main() {
    float depth = min(texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r, 0.999);
    vec4 end = camera_from_clip * vec4(2.0 * vec3(gl_FragCoord.xy / size_px, depth) - 1.0, 1.0);
    vec3 way = end.xyz / end.w;
    if (length(way) > 16.0) way *= 16.0 / length(way);   // beyond, there is no fog
    const int kSteps = 24;
    float start = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));   // Jimenez 2014
    vec3 sum = vec3(0.0);
    for (int k = 0; k < kSteps; ++k) {
        vec3 at = way * ((float(k) + start) / float(kSteps));   // from the camera
        for (int i = 0; i < 3; ++i) {
            vec3 to_lamp = lamps[i] - (camera + at);
            sum += tints[i] * (gnomon_uniform_visibility(i, at) / (0.3 + dot(to_lamp, to_lamp)));
        }
    }
    colour = vec4(sum * (0.25 * length(way) / float(kSteps)), 0.0);
})";

GLuint make_program(const std::string& vertex, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    const GLenum kinds[] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
    const char* texts[] = {vertex.c_str(), fragment.c_str()};
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

struct Box {
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    GLuint array = 0;

    Box() {
        for (int i = 0; i < 8; ++i) corners.push_back(glm::vec3(i & 1, i >> 1 & 1, i >> 2) - 0.5f);
        GLuint buffers[2];
        glCreateBuffers(2, buffers);
        glNamedBufferStorage(buffers[0], static_cast<GLsizeiptr>(corners.size() * sizeof corners[0]), corners.data(),
                             0);
        glNamedBufferStorage(buffers[1], static_cast<GLsizeiptr>(indices.size() * sizeof indices[0]), indices.data(),
                             0);
        glCreateVertexArrays(1, &array);
        glVertexArrayVertexBuffer(array, 0, buffers[0], 0, sizeof(glm::vec3));
        glVertexArrayElementBuffer(array, buffers[1]);
        glEnableVertexArrayAttrib(array, 0);
        glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(array, 0, 0);
    }
};

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "fog");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    auto created =
        gnomon::Shadows::create({.lookup = gnomon::LookupOptions{.first_texture_unit = 0,
                                                                 .suns = false,
                                                                 .points = false,
                                                                 .alpha_tests = false,
                                                                 .filters = {gnomon::ShadowFilter::triangles}}});
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    const auto lookups = shadows.lookup_glsl();
    if (!lookups) return fail(lookups.error());
    const std::string lit =
        "#version 450 core\nlayout(location = 8) uniform vec3 lamps[3];\n"
        "layout(location = 11) uniform vec3 tints[3];\n" +
        lookups.value();
    const GLuint surface = make_program(kVertex, lit + kSurface), fog = make_program(kScreen, lit + kFog);
    const GLuint depth_only = make_program(kVertex, "#version 450 core\nvoid main() {}");
    const Box box;

    const auto mesh = shadows.add_mesh({.name = "box", .positions_m = box.corners, .indices = box.indices});
    if (!mesh) return fail(mesh.error());
    std::vector<glm::dmat4> places{glm::scale(glm::translate(glm::dmat4(1.0), {0.0, -0.1, 0.0}), {16.0, 0.2, 16.0})};
    for (int i = 0; i < kBars; ++i)
        places.push_back(glm::scale(glm::translate(glm::dmat4(1.0), {0.7 * i - 2.8, 1.2, 0.0}), {0.25, 2.4, 0.25}));
    for (const glm::dmat4& place : places) shadows.add_caster({.mesh = mesh.value(), .world_from_mesh = place});
    // [air]
    const glm::dmat4 volume = glm::scale(glm::translate(glm::dmat4(1.0), {0.0, 2.0, 2.0}), {14.0, 4.0, 12.0});
    shadows.add_air({.world_from_box = volume});
    // [air]
    glm::vec3 lamps[kLamps], tints[kLamps] = {{1.0f, 0.8f, 0.5f}, {0.5f, 0.8f, 1.0f}, {0.9f, 0.5f, 0.8f}};
    for (int i = 0; i < kLamps; ++i) {
        lamps[i] = glm::vec3(2.5f * static_cast<float>(i - 1), 1.6f, -2.5f);
        shadows.add_light({.light = {.kind = gnomon::LightKind::spot, .range_m = 14.0f, .outer_cone_rad = 0.8f},
                           .position_m = glm::dvec3(lamps[i]),
                           .direction = {0.0, -0.1, 1.0},
                           .shadow = {.resolution_px = 1024}});
    }

    while (window.value()->begin_frame()) {
        const glm::uvec2 size = window.value()->size_px();
        const double turn = 0.2 * window.value()->time_s();
        const glm::dvec3 eye(5.0 * std::sin(0.5 + turn), 3.0, 7.0);
        const glm::dmat4 view_from_world = glm::lookAt(eye, glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dmat4 clip_from_view = glm::perspective(0.9, static_cast<double>(size.x) / size.y, 0.1, 100.0);
        const glm::mat4 clip_from_world(clip_from_view * view_from_world);
        const glm::mat4 camera_from_clip(glm::inverse(clip_from_view * glm::dmat4(glm::dmat3(view_from_world))));
        const glm::vec3 camera(eye);

        const gnomon::Mask none = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .size_px = size,
                                                  .wants_mask = false});
        if (!none.failure.empty()) return fail({.message = "no shadows", .rule = std::string(none.failure)});
        if (!shadows.bind_lookup()) return fail({"no room for the lights' records"});

        const auto draw = [&](GLuint program) {
            glUseProgram(program);
            glBindVertexArray(box.array);
            glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
            for (const glm::dmat4& at : places) {
                const glm::mat4 place(at);
                glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(box.indices.size()), GL_UNSIGNED_INT, nullptr);
            }
        };
        for (const GLuint program : {surface, fog}) {
            glProgramUniform3fv(program, 2, 1, &camera.x);
            glProgramUniform3fv(program, 8, kLamps, &lamps[0].x);
            glProgramUniform3fv(program, 11, kLamps, &tints[0].x);
        }
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(depth_only);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_FRAMEBUFFER_SRGB);
        draw(surface);
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glUseProgram(fog);
        glBindTextureUnit(15, window.value()->depth_texture());
        glUniformMatrix4fv(0, 1, GL_FALSE, &camera_from_clip[0][0]);
        glUniform2f(3, static_cast<float>(size.x), static_cast<float>(size.y));
        glDepthMask(GL_FALSE);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
        glDepthFunc(GL_LESS);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    return 0;
}
