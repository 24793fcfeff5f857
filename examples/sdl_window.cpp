// Shadows in a program with SDL's window and OpenGL context. Gnomon makes neither: it takes the context that is
// current.
//
// The window's own depths cannot be read as a texture, so the engine draws into a picture of its own and shows that.
// --headless chooses SDL's driver without a display.
#include <SDL.h>
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>  // for the command line and the PNG alone

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace {

// What the engine draws into.
struct Picture {
    GLuint framebuffer = 0, colour = 0, depth = 0;
    glm::ivec2 size_px{0, 0};
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
layout(location = 2) uniform vec3 lamp;
layout(location = 3) uniform vec3 beam;    // direction of its middle
layout(binding = 0) uniform sampler2DArray shadow_mask;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place))), way = lamp - place;
    float cone = smoothstep(0.76, 0.84, dot(normalize(-way), beam));
    float visible = texelFetch(shadow_mask, ivec3(gl_FragCoord.xy, 0), 0).r;
    float light = 40.0 * cone * visible * max(dot(normal, normalize(way)), 0.0) / (1.0 + dot(way, way));
    colour = vec4(vec3(0.7, 0.65, 0.5) * (0.04 + light), 1.0);
})";

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

int fail_sdl(const char* what) {
    std::fprintf(stderr, "%s: %s\n", what, SDL_GetError());
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

// Makes the picture of this size, if it has another.
void fit(Picture& picture, glm::ivec2 size_px) {
    if (picture.size_px == size_px) return;
    glDeleteFramebuffers(1, &picture.framebuffer);
    glDeleteTextures(1, &picture.colour);
    glDeleteTextures(1, &picture.depth);
    picture.size_px = size_px;
    glCreateTextures(GL_TEXTURE_2D, 1, &picture.colour);
    glTextureStorage2D(picture.colour, 1, GL_SRGB8_ALPHA8, size_px.x, size_px.y);
    glCreateTextures(GL_TEXTURE_2D, 1, &picture.depth);
    glTextureStorage2D(picture.depth, 1, GL_DEPTH_COMPONENT32F, size_px.x, size_px.y);
    glCreateFramebuffers(1, &picture.framebuffer);
    glNamedFramebufferTexture(picture.framebuffer, GL_COLOR_ATTACHMENT0, picture.colour, 0);
    glNamedFramebufferTexture(picture.framebuffer, GL_DEPTH_ATTACHMENT, picture.depth, 0);
}

void draw(GLuint program, const std::vector<glm::dmat4>& boxes, const glm::mat4& clip_from_world) {
    glUseProgram(program);
    glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0][0]);
    for (const glm::dmat4& box : boxes) {
        const glm::mat4 place(box);
        glUniformMatrix4fv(1, 1, GL_FALSE, &place[0][0]);
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
}

// Returns whether the user closes the window.
bool wants_to_leave() {
    bool leave = false;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;)
        leave |= event.type == SDL_QUIT || (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE);
    return leave;
}

// Draws frames until the window is closed or all of them are drawn.
int run(SDL_Window* window, const gnomon::WindowOptions& options) {
    const GLuint depth_only = make_program(kVertex, kDepthOnly), forward = make_program(kVertex, kForward);
    const std::vector<glm::vec3> positions = box_positions();
    const GLuint array = make_array(positions);
    Picture picture;
    std::vector<glm::dmat4> boxes;
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& size) {
        boxes.push_back(glm::scale(glm::translate(glm::dmat4(1.0), at), size));
    };
    add({0.0, -0.1, 0.0}, {12.0, 0.2, 12.0});
    for (int i = 0; i < 5; ++i) add({-2.4 + 1.2 * i, 0.5 + 0.1 * i, i % 2 - 0.5}, {0.4, 1.0 + 0.2 * i, 0.4});

    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    const auto mesh = shadows.add_mesh({.name = "box", .positions_m = positions, .indices = indices});
    if (!mesh) return fail(mesh.error());
    for (const glm::dmat4& box : boxes) shadows.add_caster({.mesh = mesh.value(), .world_from_mesh = box});
    gnomon::LightDesc lamp{.light = {.kind = gnomon::LightKind::spot, .outer_cone_rad = 0.72f},
                           .position_m = {4.0, 4.5, 3.0}};
    const gnomon::LightId lamp_id = shadows.add_light(lamp);

    for (std::uint32_t frame = 0; (options.frames == 0 || frame < options.frames) && !wants_to_leave(); ++frame) {
        glm::ivec2 size_px(0);
        SDL_GL_GetDrawableSize(window, &size_px.x, &size_px.y);
        if (size_px.x <= 0 || size_px.y <= 0) continue;
        fit(picture, size_px);
        const glm::dmat4 view_from_world =
            glm::lookAt(glm::dvec3(-4.0, 4.0, 6.0), glm::dvec3(0.0, 0.4, 0.0), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dmat4 clip_from_view = glm::perspective(0.9, static_cast<double>(size_px.x) / size_px.y, 0.1, 100.0);
        const glm::mat4 clip_from_world(clip_from_view * view_from_world);
        lamp.direction = glm::dvec3(0.8 * std::sin(frame / 40.0), 0.0, 0.0) - lamp.position_m;
        shadows.set_light(lamp_id, lamp);

        glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer);
        glViewport(0, 0, size_px.x, size_px.y);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glBindVertexArray(array);
        draw(depth_only, boxes, clip_from_world);
        const gnomon::Mask mask = shadows.render({.world_from_view = glm::inverse(view_from_world),
                                                  .clip_from_view = clip_from_view,
                                                  .depth_texture = picture.depth,
                                                  .size_px = size_px});
        if (!mask.failure.empty()) return fail({.message = "no mask", .rule = std::string(mask.failure)});
        const glm::vec3 place(lamp.position_m), beam(glm::normalize(lamp.direction));
        glDepthFunc(GL_EQUAL);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glBindTextureUnit(0, mask.texture);
        glProgramUniform3fv(forward, 2, 1, &place.x);
        glProgramUniform3fv(forward, 3, 1, &beam.x);
        draw(forward, boxes, clip_from_world);

        glDisable(GL_FRAMEBUFFER_SRGB);  // colours are encoded already
        glBlitNamedFramebuffer(picture.framebuffer, 0, 0, 0, size_px.x, size_px.y, 0, 0, size_px.x, size_px.y,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
        SDL_GL_SwapWindow(window);
    }
    if (options.screenshot.empty()) return 0;
    const auto written = gnomon::write_screenshot(picture.colour, options.screenshot);
    return written ? 0 : fail(written.error());
}

}  // namespace

int main(int argc, char** argv) {
    auto read = gnomon::window_options(argc, argv, "sdl_window");
    if (!read) return fail(read.error());
    gnomon::WindowOptions& options = read.value();
    if (options.headless) {
        SDL_setenv("SDL_VIDEODRIVER", "offscreen", 1);
        options.frames = std::max(options.frames, 1u);
    }
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return fail_sdl("SDL does not start");
    const std::string_view driver = SDL_GetCurrentVideoDriver();
    if (options.frames == 0 && (driver == "offscreen" || driver == "dummy"))  // SDL's choice where it finds no display
        return fail({"there is no display: --headless, or --frames N, draws without one"});
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_Window* window = SDL_CreateWindow("Gnomon in SDL", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                          static_cast<int>(options.size_px.x), static_cast<int>(options.size_px.y),
                                          SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE);
    SDL_GLContext context = window ? SDL_GL_CreateContext(window) : nullptr;
    const int code = context ? run(window, options) : fail_sdl("SDL opens no window with OpenGL 4.5");
    if (context) SDL_GL_DeleteContext(context);
    if (window) SDL_DestroyWindow(window);
    SDL_Quit();
    return code;
}
