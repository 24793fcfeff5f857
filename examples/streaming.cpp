// A world without end: its cells come and go around a camera that moves. Each is a mesh of its own, and some have a
// lamp.
//
// Meshes, casters and lights are added and removed between frames. Positions are double: this world begins a thousand
// kilometres from its origin, and the engine draws relative to the camera.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double kCell_m = 12.0, kSpeed_m_s = 36.0;
constexpr int kReach = 3;            // cells around the camera's own
constexpr int kMostPerFrame = 3;     // cells that come in one frame, once the first ones are there
constexpr std::size_t kLights = 16;  // that the shader has room for
constexpr glm::dvec3 kStart_m{1.0e6, 0.0, -4.0e5};

// Column and row of a cell.
using Key = std::pair<int, int>;

struct Cell {
    GLuint array = 0, buffer = 0;
    GLsizei count = 0;
    glm::dvec3 corner_m{0.0};
    gnomon::MeshId mesh = {};
    gnomon::CasterId caster = {};
    gnomon::LightId lamp = {};  // none in most cells
    glm::dvec3 lamp_m{0.0};
};

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_mesh;
layout(location = 1) uniform mat4 view_from_mesh;
out vec3 place;    // seen from the camera
invariant gl_Position;
void main() {
    place = (view_from_mesh * vec4(position, 1.0)).xyz;
    gl_Position = clip_from_mesh * vec4(position, 1.0);
})";
constexpr const char* kDepthOnly = R"(#version 450 core
void main() {})";
constexpr const char* kForward = R"(#version 450 core
in vec3 place;
layout(location = 2) uniform int light_count;
layout(location = 3) uniform vec4 lights[16];    // seen from the camera: position, or the way to the sun, where w is 0
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 sum = vec3(0.06, 0.07, 0.09);
    for (int i = 0; i < light_count; ++i) {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - place;
        vec3 shone = lights[i].w == 0.0 ? vec3(0.6, 0.57, 0.5) : vec3(24.0, 13.0, 5.0) / (1.0 + dot(way, way));
        float visible = texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, i), 0).r;
        sum += shone * (visible * max(dot(normal, normalize(way)), 0.0));
    }
    colour = vec4(0.6 * sum, 1.0);
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

// Appends a box as triangles without indices.
void append_box(std::vector<glm::vec3>& positions, const glm::vec3& middle, const glm::vec3& size) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5f, 0.5f}) {
            glm::vec3 out(0.0f), u(0.0f), v(0.0f);
            out[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 0.5f;
            for (const glm::vec3& corner :
                 {out - u - v, out + u - v, out + u + v, out - u - v, out + u + v, out - u + v})
                positions.push_back(middle + corner * size);
        }
}

// Returns a number of [0, 1) that a cell always has.
float chance(Key key, int which) {
    std::uint32_t bits = static_cast<std::uint32_t>(key.first) * 73856093u ^
                         static_cast<std::uint32_t>(key.second) * 19349663u ^
                         static_cast<std::uint32_t>(which) * 83492791u;
    bits = (bits ^ (bits >> 15)) * 2246822519u;
    bits = (bits ^ (bits >> 13)) * 3266489917u;
    return static_cast<float>((bits ^ (bits >> 16)) >> 8) / 16777216.0f;
}

// The triangles of a cell, from its corner: a slab of ground, and some blocks.
std::vector<glm::vec3> cell_positions(Key key) {
    constexpr auto kEdge_m = static_cast<float>(kCell_m);
    std::vector<glm::vec3> positions;
    append_box(positions, {0.5f * kEdge_m, -0.25f, 0.5f * kEdge_m}, {kEdge_m, 0.5f, kEdge_m});
    for (int block = 0; block < 4; ++block) {
        const float height_m = 0.6f + 3.4f * chance(key, 4 * block);
        append_box(positions,
                   {kEdge_m * (0.15f + 0.7f * chance(key, 4 * block + 1)), 0.5f * height_m,
                    kEdge_m * (0.15f + 0.7f * chance(key, 4 * block + 2))},
                   {0.8f, height_m, 0.8f + chance(key, 4 * block + 3)});
    }
    return positions;
}

// Loads a cell: into the engine's buffers, and into Gnomon.
gnomon::Result<Cell> load(gnomon::Shadows& shadows, Key key) {
    const std::vector<glm::vec3> positions = cell_positions(key);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    Cell cell;
    cell.corner_m = kStart_m + kCell_m * glm::dvec3(key.first, 0.0, key.second);
    cell.count = static_cast<GLsizei>(positions.size());
    glCreateBuffers(1, &cell.buffer);
    glNamedBufferStorage(cell.buffer, static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)), positions.data(),
                         0);
    glCreateVertexArrays(1, &cell.array);
    glVertexArrayVertexBuffer(cell.array, 0, cell.buffer, 0, sizeof(glm::vec3));
    glEnableVertexArrayAttrib(cell.array, 0);
    glVertexArrayAttribFormat(cell.array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(cell.array, 0, 0);

    // [load]
    const auto mesh = shadows.add_mesh({.name = "cell", .positions_m = positions, .indices = indices});
    if (!mesh) return mesh.error();
    cell.mesh = mesh.value();
    cell.caster =
        shadows.add_caster({.mesh = cell.mesh, .world_from_mesh = glm::translate(glm::dmat4(1.0), cell.corner_m)});
    // [load]
    if (key.first % 3 == 0 && key.second % 3 == 0) {
        cell.lamp_m = cell.corner_m + glm::dvec3(0.5 * kCell_m, 5.0, 0.5 * kCell_m);
        cell.lamp = shadows.add_light(
            {.light = {.kind = gnomon::LightKind::point, .range_m = 25.0f}, .position_m = cell.lamp_m});
    }
    return cell;
}

// Unloads a cell from both.
void unload(gnomon::Shadows& shadows, const Cell& cell) {
    // [unload]
    shadows.remove(cell.caster);
    shadows.remove(cell.mesh);
    if (cell.lamp) shadows.remove(cell.lamp);
    // [unload]
    glDeleteVertexArrays(1, &cell.array);
    glDeleteBuffers(1, &cell.buffer);
}

// Lists the cells that lie within reach and are not loaded, the nearest first.
std::vector<Key> missing(const std::map<Key, Cell>& cells, Key middle) {
    std::vector<Key> keys;
    for (int x = middle.first - kReach; x <= middle.first + kReach; ++x)
        for (int z = middle.second - kReach; z <= middle.second + kReach; ++z)
            if (!cells.contains({x, z})) keys.emplace_back(x, z);
    const auto way = [&](Key key) { return std::abs(key.first - middle.first) + std::abs(key.second - middle.second); };
    std::stable_sort(keys.begin(), keys.end(), [&](Key a, Key b) { return way(a) < way(b); });
    return keys;
}

void draw(GLuint program, const std::map<Key, Cell>& cells, const glm::dmat4& view_from_world,
          const glm::dmat4& clip_from_view) {
    glUseProgram(program);
    for (const auto& [key, cell] : cells) {
        const glm::dmat4 exact = glm::translate(view_from_world, cell.corner_m);
        const glm::mat4 view_from_mesh(exact), clip_from_mesh(clip_from_view * exact);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_mesh[0][0]);
        glUniformMatrix4fv(1, 1, GL_FALSE, &view_from_mesh[0][0]);
        glBindVertexArray(cell.array);
        glDrawArrays(GL_TRIANGLES, 0, cell.count);
    }
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "streaming");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    const GLuint depth_only = make_program(kVertex, kDepthOnly), forward = make_program(kVertex, kForward);
    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();

    std::map<Key, Cell> cells;
    const glm::dvec3 to_sun(4.0, 6.0, 3.0);
    const gnomon::LightId sun =
        shadows.add_light({.light = {.kind = gnomon::LightKind::directional}, .direction = -to_sun});

    for (int frame = 0; window.value()->begin_frame(); ++frame) {
        const glm::uvec2 size_px = window.value()->size_px();
        const double way_m = kSpeed_m_s * window.value()->time_s();
        const glm::dvec3 eye_m = kStart_m + glm::dvec3(way_m, 9.0, 10.0 * std::sin(way_m / 40.0));
        const glm::dmat4 view_from_world = glm::lookAt(eye_m, eye_m + glm::dvec3(1.0, -0.45, 0.2), {0.0, 1.0, 0.0});
        const glm::dmat4 clip_from_view = glm::perspective(1.0, static_cast<double>(size_px.x) / size_px.y, 0.3, 150.0);

        // Cells come and go. The first frame brings all of them.
        const glm::dvec3 place = (eye_m - kStart_m) / kCell_m;
        const Key middle(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.z)));
        int came = 0, went = 0;
        for (auto at = cells.begin(); at != cells.end();) {
            const bool far = std::abs(at->first.first - middle.first) > kReach ||
                             std::abs(at->first.second - middle.second) > kReach;
            if (far) unload(shadows, at->second);
            went += far;
            at = far ? cells.erase(at) : std::next(at);
        }
        for (const Key& key : missing(cells, middle)) {
            if (frame > 0 && came == kMostPerFrame) break;
            auto cell = load(shadows, key);
            if (!cell) return fail(cell.error());
            cells.emplace(key, cell.value());
            ++came;
        }

        // Lights of this frame, as the shader reads them: the sun, and the lamps of all cells.
        std::vector<gnomon::LightId> lights{sun};
        std::vector<glm::vec4> seen_lights{glm::vec4(glm::dmat3(view_from_world) * to_sun, 0.0f)};
        for (const auto& [key, cell] : cells)
            if (cell.lamp && lights.size() < kLights) {
                lights.push_back(cell.lamp);
                seen_lights.emplace_back(view_from_world * glm::dvec4(cell.lamp_m, 1.0));
            }

        glEnable(GL_DEPTH_TEST);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glClearColor(0.03f, 0.04f, 0.06f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(depth_only, cells, view_from_world, clip_from_view);
        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .depth_texture = window.value()->depth_texture(),
                                                  .size_px = size_px,
                                                  .lights = lights});
        if (!mask.failure.empty()) return fail({.message = "no mask", .rule = std::string(mask.failure)});
        glDepthFunc(GL_EQUAL);
        glBindTextureUnit(0, mask.texture);
        glProgramUniform1i(forward, 2, static_cast<GLint>(lights.size()));
        glProgramUniform4fv(forward, 3, static_cast<GLsizei>(seen_lights.size()), &seen_lights[0].x);
        draw(forward, cells, view_from_world, clip_from_view);
        glDepthFunc(GL_LESS);

        if (came + went > 0 || frame % 30 == 0)
            std::printf("frame %d: %zu meshes (%d came, %d went), %zu lights, %u maps drawn, %.1f MB of maps\n", frame,
                        cells.size(), came, went, lights.size(), shadows.status().maps_drawn,
                        static_cast<double>(shadows.status().bytes) / 1.0e6);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    return 0;
}
