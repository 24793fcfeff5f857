// The first shadow: a ground, a box and a sun. Depths are drawn; Gnomon makes a mask of them; a second draw reads it.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

constexpr glm::vec3 kPositions[12] = {{-6, 0, -6}, {-6, 0, 6}, {6, 0, 6},  {6, 0, -6}, {-1, 0, -1}, {1, 0, -1},
                                      {-1, 2, -1}, {1, 2, -1}, {-1, 0, 1}, {1, 0, 1},  {-1, 2, 1},  {1, 2, 1}};
constexpr GLuint kIndices[42] = {0, 1,  2, 0, 2, 3,  5, 7,  11, 5, 11, 9, 4, 8, 10, 4, 10, 6, 6, 10, 11,
                                 6, 11, 7, 8, 9, 11, 8, 11, 10, 4, 6,  7, 4, 7, 5,  4, 5,  9, 4, 9,  8};
constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform vec3 positions[12];
layout(location = 13) uniform uint indices[42];
layout(location = 0) out vec3 place;
out gl_PerVertex { vec4 gl_Position; };
void main() { gl_Position = clip_from_world * vec4(place = positions[indices[gl_VertexID]], 1.0); })";
constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) in vec3 place;
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    float cosine = max(dot(normalize(cross(dFdx(place), dFdy(place))), normalize(vec3(3.0, 5.0, 4.0))), 0.0);
    colour = vec4(vec3(0.2 + 0.6 * cosine * texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, 0), 0).r), 1.0);
})";
constexpr auto need = [](auto result) {
    if (!result) std::exit((std::fprintf(stderr, "%s\n", to_line(result.error()).c_str()), 2));
    return std::move(result).value();
};

int main(int argc, char** argv) {
    const auto window = need(gnomon::Window::open(need(gnomon::window_options(argc, argv, "first_shadow"))));
    const GLuint vertex = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &kVertex);
    GLuint pipeline = 0, array = 0;
    glGenProgramPipelines(1, &pipeline), glBindProgramPipeline(pipeline);
    glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, vertex);
    glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, glCreateShaderProgramv(GL_FRAGMENT_SHADER, 1, &kFragment));
    glProgramUniform3fv(vertex, 1, 12, &kPositions[0].x), glProgramUniform1uiv(vertex, 13, 42, kIndices);
    glGenVertexArrays(1, &array), glBindVertexArray(array), glEnable(GL_DEPTH_TEST), glDepthFunc(GL_LEQUAL);
    const auto shadows = need(gnomon::Shadows::create());
    shadows->add_caster({.mesh = need(shadows->add_mesh({.positions_m = kPositions, .indices = kIndices}))});
    shadows->add_light({.light = {.kind = gnomon::LightKind::directional}, .direction = {-3.0, -5.0, -4.0}});
    while (window->begin_frame()) {
        const glm::uvec2 size_px = window->size_px();
        const glm::dmat4 clip_from_view = glm::perspective(0.9, 1.0 * size_px.x / size_px.y, 0.1, 100.0);
        const glm::dmat4 view_from_world = glm::lookAt(glm::dvec3(-4, 5, 7), glm::dvec3(0), glm::dvec3(0, 1, 0));
        glProgramUniformMatrix4fv(vertex, 0, 1, GL_FALSE, &glm::mat4(clip_from_view * view_from_world)[0][0]);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT), glDrawArrays(GL_TRIANGLES, 0, 42);
        const gnomon::Mask mask = shadows->render({.world_from_view = glm::inverse(view_from_world),
                                                   .clip_from_view = clip_from_view,
                                                   .depth_texture = window->depth_texture(),
                                                   .size_px = size_px});
        if (mask.texture == 0) return std::fprintf(stderr, "no mask: %s\n", mask.failure.data()), 2;
        glBindTextureUnit(0, mask.texture), glDrawArrays(GL_TRIANGLES, 0, 42);
        need(window->end_frame());
    }
}
