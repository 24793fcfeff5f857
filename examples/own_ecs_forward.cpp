// Eight shadowed lights in one forward pass, for an engine with entities, meshes and shaders of its own.
//
// The engine draws depths first. Gnomon reads them and gives a mask: an array texture with a layer of visibility per
// light. The forward shader reads a texel of each layer, whatever lights and filters there are, and never changes.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace {

constexpr int kLights = 8;

// The engine's own entities: a mesh somewhere, and perhaps a motion.
struct Entity {
    glm::dmat4 home{1.0};
    glm::vec3 colour{0.7f};
    double turns_per_s = 0.0;
    glm::dmat4 place{1.0};    // now
    gnomon::CasterId caster;  // Gnomon's name for it
};

// A box, as the engine draws it: 36 positions with normals.
struct BoxMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    GLuint array = 0;

    BoxMesh() {
        const glm::vec3 axes[3] = {{0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 0.0f, 0.5f}};
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {-1.0f, 1.0f}) {
                const glm::vec3 out = axes[axis] * side, u = axes[(axis + 1) % 3] * side, v = axes[(axis + 2) % 3];
                for (const glm::vec3& corner :
                     {out - u - v, out + u - v, out + u + v, out - u - v, out + u + v, out - u + v})
                    positions.push_back(corner);
            }
        for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
        GLuint buffer = 0;
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)), positions.data(),
                             0);
        glCreateVertexArrays(1, &array);
        glVertexArrayVertexBuffer(array, 0, buffer, 0, sizeof(glm::vec3));
        glEnableVertexArrayAttrib(array, 0);
        glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(array, 0, 0);
    }
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
layout(location = 3) uniform vec4 lights[8];    // xyz: position, or the way to the sun, where w is 0
layout(location = 11) uniform vec3 colours[8];
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 sum = vec3(0.03);
    // [shader]
    for (int i = 0; i < 8; ++i) {
        vec3 way = lights[i].w == 0.0 ? lights[i].xyz : lights[i].xyz - place;
        float falloff = lights[i].w == 0.0 ? 1.0 : 1.0 / (1.0 + dot(way, way));
        float visible = texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, i), 0).r;
        sum += colours[i] * (visible * falloff * max(dot(normal, normalize(way)), 0.0));
    }
    // [shader]
    colour = vec4(base_colour * sum, 1.0);
})";

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

void draw(GLuint program, const std::vector<Entity>& entities, const BoxMesh& box, const glm::mat4& clip_from_world) {
    glUseProgram(program);
    glBindVertexArray(box.array);
    glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
    for (const Entity& entity : entities) {
        const glm::mat4 place(entity.place);
        glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
        glUniform3fv(2, 1, &entity.colour.x);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(box.positions.size()));
    }
}

std::vector<Entity> make_world() {
    std::vector<Entity> world;
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& size, const glm::vec3& colour, double turns = 0.0) {
        const glm::dmat4 home = glm::scale(glm::translate(glm::dmat4(1.0), at), size);
        world.push_back({home, colour, turns, home, {}});
    };
    add({0.0, -0.1, 0.0}, {24.0, 0.2, 24.0}, {0.55f, 0.55f, 0.5f});
    for (int i = 0; i < 9; ++i) {
        const double angle = i * 0.698;
        add({4.0 * std::cos(angle), 1.0, 4.0 * std::sin(angle)}, {0.5, 2.0, 0.5}, {0.6f, 0.5f, 0.4f});
    }
    add({0.0, 1.2, 0.0}, {1.5, 0.4, 1.5}, {0.5f, 0.6f, 0.7f}, 0.1);
    return world;
}

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "own_ecs_forward");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());

    std::vector<Entity> world = make_world();
    const BoxMesh box;
    const GLuint depth_only = make_program(kVertex, kDepthOnly), forward = make_program(kVertex, kForward);

    // Gnomon gets the mesh, a caster per entity, and the lights.
    // [hand over]
    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    const auto mesh = shadows.add_mesh({.name = "box", .positions_m = box.positions, .indices = box.indices});
    if (!mesh) return fail(mesh.error());
    for (Entity& entity : world)
        entity.caster = shadows.add_caster({.mesh = mesh.value(), .world_from_mesh = entity.place});
    // [hand over]
    std::vector<gnomon::LightId> lights;
    std::vector<glm::vec4> light_places;
    std::vector<glm::vec3> light_colours;
    const auto add_light = [&](gnomon::LightKind kind, const glm::dvec3& at, const glm::dvec3& toward,
                               const glm::vec3& colour) {
        // [light]
        lights.push_back(shadows.add_light({.light = {.kind = kind}, .position_m = at, .direction = toward - at}));
        // [light]
        light_places.emplace_back(glm::vec3(at), kind == gnomon::LightKind::directional ? 0.0f : 1.0f);
        light_colours.push_back(colour);
    };
    add_light(gnomon::LightKind::directional, {3.0, 8.0, 5.0}, {0.0, 0.0, 0.0}, {0.5f, 0.5f, 0.45f});
    for (int i = 1; i < kLights; ++i) {
        const double angle = 0.9 * i;
        const glm::dvec3 at(6.5 * std::cos(angle), 3.0 + 0.2 * i, 6.5 * std::sin(angle));
        const glm::vec3 colour(0.5f + 0.5f * std::cos(1.3f * static_cast<float>(i)), 0.6f,
                               0.5f + 0.5f * std::sin(static_cast<float>(i)));
        add_light(i % 2 == 0 ? gnomon::LightKind::point : gnomon::LightKind::spot, at, {0.0, 0.5, 0.0}, 9.0f * colour);
    }

    while (window.value()->begin_frame()) {
        const glm::uvec2 size = window.value()->size_px();
        const double time_s = window.value()->time_s();
        const glm::dmat4 view_from_world =
            glm::lookAt(glm::dvec3(7.0, 6.0, 9.0), glm::dvec3(0.0, 0.3, 0.0), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dmat4 clip_from_view = glm::perspective(0.9, static_cast<double>(size.x) / size.y, 0.1, 100.0);
        const glm::mat4 clip_from_world(clip_from_view * view_from_world);

        // [move]
        for (Entity& entity : world) {
            const double angle = 6.2832 * entity.turns_per_s * time_s;
            entity.place = glm::rotate(entity.home, angle, glm::dvec3(0.0, 1.0, 0.0));
            shadows.set_transform(entity.caster, entity.place);  // costs nothing where it stayed
        }
        // [move]

        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(depth_only, world, box, clip_from_world);

        // [mask]
        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .depth_texture = window.value()->depth_texture(),
                                                  .size_px = size,
                                                  .lights = lights});
        if (!mask.failure.empty()) return fail({.message = "no mask", .rule = std::string(mask.failure)});
        // [mask]

        glDepthFunc(GL_EQUAL);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glBindTextureUnit(0, mask.texture);
        glUseProgram(forward);
        glUniform4fv(3, kLights, &light_places[0].x);
        glUniform3fv(11, kLights, &light_colours[0].x);
        draw(forward, world, box, clip_from_world);
        glDepthFunc(GL_LESS);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    // [status]
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const gnomon::LightStatus status = shadows.status(lights[i]);
        std::printf("light %zu: %s, %s %u maps, %.1f MB\n", i, to_text(status.state), reason_code(status.reason),
                    status.maps, static_cast<double>(status.bytes) / 1.0e6);
    }
    // [status]
    return 0;
}
