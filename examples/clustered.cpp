// A hundred shadowed lamps in one forward pass over the surfaces, clustered by tiles of the screen.
//
// One program looks up all lamps by the GLSL that Gnomon gives. It is made once, and stays while lamps come, go and
// move.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace {

constexpr int kRow = 10, kLamps = kRow * kRow;  // on a grid
constexpr int kTiles = 16, kMostPerTile = 31;   // tiles across and down; lamps in one
constexpr float kRange_m = 3.0f, kCone_rad = 0.9f;

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
constexpr const char* kDepthOnly = "#version 450 core\nvoid main() {}";
constexpr const char* kForward = R"(
in vec3 place;
layout(location = 2) uniform vec3 camera;
layout(location = 3) uniform vec2 tiles_per_pixel;
layout(std430, binding = 0) readonly buffer Lamps { vec4 lamps[]; };              // xyz: position, w: number in Gnomon
layout(std430, binding = 1) readonly buffer Tiles { int tiles[][32]; };           // a count, then lamps
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    ivec2 tile = ivec2(gl_FragCoord.xy * tiles_per_pixel);
    int t = tile.y * 16 + tile.x, count = tiles[t][0];
    vec3 sum = vec3(0.02);
    for (int k = 1; k <= count; ++k) {
        vec4 lamp = lamps[tiles[t][k]];
        vec3 way = lamp.xyz - place;
        float near = max(1.0 - dot(way, way) / 9.0, 0.0), cosine = dot(normal, normalize(way));
        if (near == 0.0 || cosine <= 0.0) continue;
        vec3 tint = 0.6 + 0.4 * cos(vec3(0.0, 2.1, 4.2) + float(tiles[t][k]));
        sum += tint * (near * near * cosine * gnomon_visibility(int(lamp.w), place - camera, normal));
    }
    colour = vec4(0.7 * sum, 1.0);
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

void draw(GLuint program, const std::vector<glm::dmat4>& places, const Box& box, const glm::mat4& clip_from_world) {
    glUseProgram(program);
    glBindVertexArray(box.array);
    glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
    for (const glm::dmat4& at : places) {
        const glm::mat4 place(at);
        glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(box.indices.size()), GL_UNSIGNED_INT, nullptr);
    }
}

using Tiles = std::vector<std::array<int, kMostPerTile + 1>>;

/// Lists in each tile the lamps that may reach what it shows: by the box on the screen around the ball of their range.
void fill_tiles(const std::vector<glm::vec4>& lamps, const glm::dmat4& clip_from_world, Tiles& tiles) {
    tiles.assign(kTiles * kTiles, {});
    for (int lamp = 0; lamp < static_cast<int>(lamps.size()); ++lamp) {
        glm::dvec2 low(1.0), high(-1.0);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 off((corner & 1) * 2 - 1, (corner >> 1 & 1) * 2 - 1, (corner >> 2) * 2 - 1);
            const glm::dvec4 clip = clip_from_world * glm::dvec4(glm::dvec3(lamps[lamp]) + off * double{kRange_m}, 1.0);
            if (clip.w <= 0.0) low = glm::dvec2(-1.0), high = glm::dvec2(1.0);  // behind the eye: anywhere
            if (clip.w <= 0.0) break;
            low = glm::min(low, glm::dvec2(clip) / clip.w);
            high = glm::max(high, glm::dvec2(clip) / clip.w);
        }
        const glm::ivec2 from = glm::clamp(glm::ivec2((low * 0.5 + 0.5) * double{kTiles}), 0, kTiles - 1);
        const glm::ivec2 to = glm::clamp(glm::ivec2((high * 0.5 + 0.5) * double{kTiles}), 0, kTiles - 1);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                auto& tile = tiles[static_cast<std::size_t>(y * kTiles + x)];
                if (tile[0] < kMostPerTile) tile[static_cast<std::size_t>(++tile[0])] = lamp;
            }
    }
}

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "clustered");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    const Box box;

    // The text has spots alone, which is what all lamps are.
    auto created =
        gnomon::Shadows::create({.lookup = gnomon::LookupOptions{.first_texture_unit = 0,
                                                                 .storage_binding = 2,
                                                                 .suns = false,
                                                                 .points = false,
                                                                 .alpha_tests = false,
                                                                 .filters = {gnomon::ShadowFilter::triangles}}});
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    // [text]
    const auto lookups = shadows.lookup_glsl();
    if (!lookups) return fail(lookups.error());
    const GLuint forward = make_program(kVertex, "#version 450 core\n" + lookups.value() + kForward);
    // [text]
    const GLuint depth_only = make_program(kVertex, kDepthOnly);

    std::vector<glm::dmat4> places{glm::scale(glm::translate(glm::dmat4(1.0), {0.0, -0.1, 0.0}), {26.0, 0.2, 26.0})};
    std::vector<gnomon::LightId> lights;
    const auto mesh = shadows.add_mesh({.name = "box", .positions_m = box.corners, .indices = box.indices});
    if (!mesh) return fail(mesh.error());
    const auto lamp_place = [](int i, double time_s) {
        const double turn = 0.7 * time_s + i;
        return glm::dvec3(2.4 * (i % kRow) - 10.8 + 0.5 * std::cos(turn), 2.0,
                          2.4 * (i / kRow) - 10.8 + 0.5 * std::sin(turn));
    };
    for (int i = 0; i < kLamps; ++i) {
        const glm::dvec3 at(2.4 * (i % kRow) - 10.8, 0.4, 2.4 * (i / kRow) - 10.8);
        places.push_back(
            glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), at), 0.7 * i, {0.0, 1.0, 0.0}), {0.5, 0.8, 0.5}));
        lights.push_back(shadows.add_light({}));
    }
    for (const glm::dmat4& place : places) shadows.add_caster({.mesh = mesh.value(), .world_from_mesh = place});

    GLuint buffers[2];
    glCreateBuffers(2, buffers);
    Tiles tiles;
    std::vector<glm::vec4> lamps(kLamps);
    while (window.value()->begin_frame()) {
        const glm::uvec2 size = window.value()->size_px();
        const glm::dvec3 eye(9.0, 8.0, 11.0);
        const glm::dmat4 view_from_world = glm::lookAt(eye, glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dmat4 clip_from_view = glm::perspective(0.9, static_cast<double>(size.x) / size.y, 0.1, 100.0);
        const glm::dmat4 clip_from_world = clip_from_view * view_from_world;
        for (int i = 0; i < kLamps; ++i) {
            // Every tenth lamp moves: only its map is drawn again.
            const glm::dvec3 at = lamp_place(i, i % 10 == 0 ? window.value()->time_s() : 0.0);
            shadows.set_light(
                lights[static_cast<std::size_t>(i)],
                {.light = {.kind = gnomon::LightKind::spot, .range_m = kRange_m, .outer_cone_rad = kCone_rad},
                 .position_m = at,
                 .direction = {0.0, -1.0, 0.0},
                 .shadow = {.resolution_px = 256}});  // a hundred small maps in one shared array
            lamps[static_cast<std::size_t>(i)] = glm::vec4(glm::vec3(at), 0.0f);
        }

        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(depth_only, places, box, glm::mat4(clip_from_world));

        const gnomon::Mask none = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .size_px = size,
                                                  .wants_mask = false});
        if (!none.failure.empty()) return fail({.message = "no shadows", .rule = std::string(none.failure)});
        for (int i = 0; i < kLamps; ++i)
            lamps[static_cast<std::size_t>(i)].w =
                static_cast<float>(shadows.lookup_index(lights[static_cast<std::size_t>(i)]));
        fill_tiles(lamps, clip_from_world, tiles);
        glNamedBufferData(buffers[0], static_cast<GLsizeiptr>(lamps.size() * sizeof lamps[0]), lamps.data(),
                          GL_STREAM_DRAW);
        glNamedBufferData(buffers[1], static_cast<GLsizeiptr>(tiles.size() * sizeof tiles[0]), tiles.data(),
                          GL_STREAM_DRAW);
        glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
        if (!shadows.bind_lookup()) return fail({"no room for the lights' records"});

        glDepthFunc(GL_EQUAL);
        glEnable(GL_FRAMEBUFFER_SRGB);
        const glm::vec3 from(eye);
        glProgramUniform3fv(forward, 2, 1, &from.x);
        glProgramUniform2f(forward, 3, static_cast<float>(kTiles) / static_cast<float>(size.x),
                           static_cast<float>(kTiles) / static_cast<float>(size.y));
        draw(forward, places, box, glm::mat4(clip_from_world));
        glDepthFunc(GL_LESS);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    std::printf("%d lamps, %u maps drawn in the last frame, %.0f MB\n", kLamps, shadows.status().maps_drawn,
                static_cast<double>(shadows.status().bytes) / 1.0e6);
    return 0;
}
