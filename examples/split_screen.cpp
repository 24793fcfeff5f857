// Two players, a half of the window each: one render() call makes a mask for either camera.
//
// Each half has depths of its own, drawn before the call, and reads its own mask after it. Each player has a body that
// the other one sees, with its shadow; in the player's own half neither is there. So the views have a layer each.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>
#include <vector>

namespace {

constexpr int kPlayers = 2, kLights = 3;

// A box somewhere, in some players' halves.
struct Thing {
    glm::dmat4 place{1.0};
    glm::vec3 colour{0.7f};
    gnomon::ShadowLayers seen_by = gnomon::kAllShadowLayers;  // a bit per player
    gnomon::CasterId caster = {};
};

gnomon::ShadowLayers layer_of(int player) { return static_cast<gnomon::ShadowLayers>(1 << player); }

// A half of the window, and what its player sees.
struct Half {
    GLuint framebuffer = 0, colour = 0, depth = 0;
    glm::uvec2 size_px{0, 0};
    glm::dmat4 world_from_view{1.0}, clip_from_view{1.0};
};

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform mat4 world_from_mesh;
out vec3 place;
invariant gl_Position;
void main() {
    place = (world_from_mesh * vec4(position, 1.0)).xyz;
    gl_Position = clip_from_world * vec4(place, 1.0);
})";
constexpr const char* kDepthOnly = R"(#version 450 core
void main() {})";
constexpr const char* kForward = R"(#version 450 core
in vec3 place;
layout(location = 2) uniform vec3 base_colour;
layout(location = 3) uniform vec4 lights[3];    // xyz: position, or the way to the sun, where w is 0
layout(location = 6) uniform vec3 colours[3];
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 sum = vec3(0.05);
    for (int i = 0; i < 3; ++i) {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - place;
        float falloff = lights[i].w == 0.0 ? 1.0 : 1.0 / (1.0 + dot(way, way));
        float visible = texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, i), 0).r;
        sum += colours[i] * (visible * falloff * max(dot(normal, normalize(way)), 0.0));
    }
    colour = vec4(base_colour * sum, 1.0);
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

// A box of edge 1, as triangles without indices.
std::vector<glm::vec3> box_positions() {
    std::vector<glm::vec3> positions;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5f, 0.5f}) {
            glm::vec3 out(0.0f), u(0.0f), v(0.0f);
            out[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 0.5f;
            for (const glm::vec3& corner :
                 {out - u - v, out + u - v, out + u + v, out - u - v, out + u + v, out - u + v})
                positions.push_back(corner);
        }
    return positions;
}

GLuint make_array(const std::vector<glm::vec3>& positions) {
    GLuint buffer = 0, array = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)), positions.data(), 0);
    glCreateVertexArrays(1, &array);
    glVertexArrayVertexBuffer(array, 0, buffer, 0, sizeof(glm::vec3));
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    return array;
}

// Makes the half's picture of this size, if it has another.
void fit(Half& half, glm::uvec2 size_px) {
    if (half.size_px == size_px) return;
    glDeleteFramebuffers(1, &half.framebuffer);
    glDeleteTextures(1, &half.colour);
    glDeleteTextures(1, &half.depth);
    half.size_px = size_px;
    const auto width = static_cast<GLsizei>(size_px.x), height = static_cast<GLsizei>(size_px.y);
    glCreateTextures(GL_TEXTURE_2D, 1, &half.colour);
    glTextureStorage2D(half.colour, 1, GL_SRGB8_ALPHA8, width, height);
    glCreateTextures(GL_TEXTURE_2D, 1, &half.depth);
    glTextureStorage2D(half.depth, 1, GL_DEPTH_COMPONENT24, width, height);
    glCreateFramebuffers(1, &half.framebuffer);
    glNamedFramebufferTexture(half.framebuffer, GL_COLOR_ATTACHMENT0, half.colour, 0);
    glNamedFramebufferTexture(half.framebuffer, GL_DEPTH_ATTACHMENT, half.depth, 0);
}

// Returns where the player's eye is: both walk around the middle, on opposite sides.
glm::dvec3 eye_of(int player, double time_s) {
    const double angle_rad = 0.6 + 0.3 * time_s + 3.1416 * player;
    return {7.0 * std::cos(angle_rad), 3.5 + player, 7.0 * std::sin(angle_rad)};
}

void place_camera(Half& half, const glm::dvec3& eye) {
    half.world_from_view = glm::inverse(glm::lookAt(eye, glm::dvec3(0.0, 0.8, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
    half.clip_from_view = glm::perspective(1.0, static_cast<double>(half.size_px.x) / half.size_px.y, 0.1, 100.0);
}

void draw(GLuint program, const Half& half, int player, const std::vector<Thing>& things) {
    const glm::mat4 clip_from_world(half.clip_from_view * glm::inverse(half.world_from_view));
    glUseProgram(program);
    glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
    for (const Thing& thing : things) {
        if ((thing.seen_by & layer_of(player)) == 0) continue;
        const glm::mat4 place(thing.place);
        glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
        glUniform3fv(2, 1, &thing.colour.x);
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
}

void begin(const Half& half) {
    glBindFramebuffer(GL_FRAMEBUFFER, half.framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(half.size_px.x), static_cast<GLsizei>(half.size_px.y));
}

std::vector<Thing> make_things() {
    std::vector<Thing> things;
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& size, const glm::vec3& colour) {
        things.push_back({glm::scale(glm::translate(glm::dmat4(1.0), at), size), colour});
    };
    add({0.0, -0.1, 0.0}, {24.0, 0.2, 24.0}, {0.6f, 0.6f, 0.55f});
    for (int i = 0; i < 7; ++i) {
        const double angle_rad = 0.9 * i;
        add({2.8 * std::cos(angle_rad), 0.4 + 0.15 * i, 2.8 * std::sin(angle_rad)}, {0.6, 0.8 + 0.3 * i, 0.6},
            {0.7f, 0.5f, 0.4f});
    }
    for (int player = 0; player < kPlayers; ++player)  // bodies come last
        things.push_back({glm::dmat4(1.0), {0.3f, 0.6f, 0.4f}, layer_of(kPlayers - 1 - player)});
    return things;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "split_screen");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());

    const GLuint depth_only = make_program(kVertex, kDepthOnly), forward = make_program(kVertex, kForward);
    const std::vector<glm::vec3> positions = box_positions();
    const GLuint box = make_array(positions);
    std::vector<Thing> things = make_things();
    std::array<Half, kPlayers> halves;

    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    const auto mesh = shadows.add_mesh({.name = "box", .positions_m = positions, .indices = indices});
    if (!mesh) return fail(mesh.error());
    for (Thing& thing : things)
        thing.caster = shadows.add_caster({.mesh = mesh.value(),
                                           .world_from_mesh = thing.place,
                                           .cast_layers = thing.seen_by,
                                           .receive_layers = thing.seen_by});
    const std::array<glm::vec4, kLights> lights = {
        {{6.0f, 5.0f, 4.0f, 0.0f}, {0.0f, 2.4f, 0.0f, 1.0f}, {-4.5f, 3.0f, 1.0f, 1.0f}}};
    const std::array<glm::vec3, kLights> colours = {{{0.4f, 0.38f, 0.35f}, {4.0f, 3.0f, 1.5f}, {1.5f, 3.0f, 7.0f}}};
    for (const glm::vec4& light : lights)
        shadows.add_light(
            {.light = {.kind = light.w == 0.0f ? gnomon::LightKind::directional : gnomon::LightKind::point},
             .position_m = light,
             .direction = -glm::dvec3(light)});

    while (window.value()->begin_frame()) {
        const glm::uvec2 size_px = window.value()->size_px(), half_px(std::max(size_px.x / 2, 1u), size_px.y);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glClearColor(0.02f, 0.03f, 0.05f, 1.0f);
        glBindVertexArray(box);

        // Bodies stand below their players' eyes.
        for (int player = 0; player < kPlayers; ++player) {
            const glm::dvec3 eye = eye_of(player, window.value()->time_s());
            Thing& body = things[things.size() - kPlayers + player];
            body.place = glm::scale(glm::translate(glm::dmat4(1.0), {eye.x, 0.5 * eye.y, eye.z}), {0.6, eye.y, 0.6});
            shadows.set_transform(body.caster, body.place);
            fit(halves[player], half_px);
            place_camera(halves[player], eye);
        }

        // Depths of both halves, then both masks, then both pictures.
        std::array<gnomon::View, kPlayers> views;
        for (int player = 0; player < kPlayers; ++player) {
            const Half& half = halves[player];
            begin(half);
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            draw(depth_only, half, player, things);
            // [view]
            views[player] = {.world_from_view = half.world_from_view,
                             .clip_from_view = half.clip_from_view,
                             .depth_texture = half.depth,
                             .size_px = half.size_px,
                             .cast_layers = layer_of(player),
                             .receive_layers = layer_of(player)};
            // [view]
        }
        // [masks]
        const std::span<const gnomon::Mask> masks = shadows.render(views);
        // [masks]
        glDepthFunc(GL_EQUAL);
        for (int player = 0; player < kPlayers; ++player) {
            const Half& half = halves[player];
            if (!masks[player].failure.empty()) return fail({"no mask", {}, {}, std::string(masks[player].failure)});
            begin(half);
            glBindTextureUnit(0, masks[player].texture);
            glProgramUniform4fv(forward, 3, kLights, &lights[0].x);
            glProgramUniform3fv(forward, 6, kLights, &colours[0].x);
            draw(forward, half, player, things);
            const auto left = static_cast<GLint>(player * half_px.x), width = static_cast<GLint>(half_px.x),
                       height = static_cast<GLint>(half_px.y);
            glBlitNamedFramebuffer(half.framebuffer, window.value()->framebuffer(), 0, 0, width, height, left, 0,
                                   left + width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        }
        glDepthFunc(GL_LESS);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    std::printf("%u maps drawn in the last frame for both players, %.1f MB\n", shadows.status().maps_drawn,
                static_cast<double>(shadows.status().bytes) / 1.0e6);
    return 0;
}
