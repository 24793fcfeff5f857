#pragma once
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/math/frustum.h"
#include "engine/math/projection.h"
#include "gnomon/shadows.h"
#include "tests/gl/traced_frame_fixture.h"

namespace gnomon {

enum class Depths : std::uint8_t { usual_d24, usual_float, reversed };
inline const char* name_of(Depths depths) {
    return depths == Depths::usual_d24 ? "D24" : depths == Depths::usual_float ? "D32F" : "ReversedD32F";
}

inline constexpr int kWidth_px = 320, kHeight_px = 256;
inline constexpr double kNear_m = 0.1, kFov_rad = 0.9;

/// Links a program of the engine's.
inline GLuint linked(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    for (const auto& [kind, text] : {std::pair(GL_VERTEX_SHADER, vertex), std::pair(GL_FRAGMENT_SHADER, fragment)}) {
        const GLuint shader = glCreateShader(static_cast<GLenum>(kind));
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    return program;
}

/// An engine that draws depths and normals of meshes in world space, and knows OpenGL alone.
class Engine {
public:
    explicit Engine(Depths depths, GLsizei samples = 1) : depths_(depths) {
        const GLenum target = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
        const auto make = [&](GLuint& texture, GLenum format) {
            glCreateTextures(target, 1, &texture);
            if (samples > 1)
                glTextureStorage2DMultisample(texture, samples, format, kWidth_px, kHeight_px, GL_TRUE);
            else
                glTextureStorage2D(texture, 1, format, kWidth_px, kHeight_px);
        };
        make(depth, depths == Depths::usual_d24 ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F);
        make(normals, GL_RGBA16F);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_,
                                  depths == Depths::usual_d24 ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth, 0);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, normals, 0);
        glCreateVertexArrays(1, &array_);
        program_ = linked(R"(#version 450 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform float sway;   // wind: metres at a height of a metre
out vec3 place;
void main() {
    place = position + vec3(sway * position.y * position.y, 0.0, 0.0);
    gl_Position = clip_from_world * vec4(place, 1.0);
})",
                          R"(#version 450 core
in vec3 place;
layout(location = 0) out vec4 normal;
void main() { normal = vec4(normalize(cross(dFdx(place), dFdy(place))), 0.0); })");
    }
    ~Engine() {
        glDeleteTextures(1, &depth);
        glDeleteTextures(1, &normals);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteVertexArrays(1, &array_);
        glDeleteProgram(program_);
        for (const Mesh& mesh : meshes_) {
            glDeleteBuffers(1, &mesh.vertices);
            glDeleteBuffers(1, &mesh.indices);
        }
    }
    std::size_t add(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices, float sway = 0.0f) {
        Mesh& mesh = meshes_.emplace_back();
        mesh.sway = sway;
        glCreateBuffers(1, &mesh.vertices);
        glNamedBufferStorage(mesh.vertices, static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)), positions.data(), 0);
        glCreateBuffers(1, &mesh.indices);
        glNamedBufferStorage(mesh.indices, static_cast<GLsizeiptr>(indices.size() * 4), indices.data(), 0);
        mesh.count = static_cast<GLsizei>(indices.size());
        return meshes_.size() - 1;
    }
    void set_sway(std::size_t mesh, float sway) { meshes_[mesh].sway = sway; }
    /// Draws one mesh as it sways, wherever that goes.
    void draw_one(std::size_t i, const glm::mat4& clip_from_world) const {
        const Mesh& mesh = meshes_[i];
        glUseProgram(program_);
        glUniformMatrix4fv(glGetUniformLocation(program_, "clip_from_world"), 1, GL_FALSE, &clip_from_world[0][0]);
        glUniform1f(glGetUniformLocation(program_, "sway"), mesh.sway);
        glBindVertexArray(array_);
        glEnableVertexArrayAttrib(array_, 0);
        glVertexArrayAttribFormat(array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(array_, 0, 0);
        glVertexArrayVertexBuffer(array_, 0, mesh.vertices, 0, sizeof(glm::vec3));
        glVertexArrayElementBuffer(array_, mesh.indices);
        glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
    }
    void draw(const glm::dmat4& clip_from_world) const {
        const bool reversed = depths_ == Depths::reversed;
        glClipControl(GL_LOWER_LEFT, reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, kWidth_px, kHeight_px);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(reversed ? GL_GREATER : GL_LESS);
        glClearDepth(reversed ? 0.0 : 1.0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        for (std::size_t i = 0; i < meshes_.size(); ++i) draw_one(i, glm::mat4(clip_from_world));
    }
    /// Returns the projection with which depths are drawn.
    glm::dmat4 projection() const {
        if (own_projection) return *own_projection;
        const double half_y = std::tan(0.5 * kFov_rad), half_x = half_y * kWidth_px / kHeight_px;
        if (depths_ == Depths::reversed)
            return math::reversed_perspective(-half_x, half_x, -half_y, half_y, kNear_m, std::numeric_limits<double>::infinity());
        return glm::perspectiveRH_NO(kFov_rad, static_cast<double>(kWidth_px) / kHeight_px, kNear_m, 100.0);
    }
    ClipDepth clip_depth() const {
        return depths_ == Depths::reversed ? ClipDepth::zero_to_one : ClipDepth::minus_one_to_one;
    }

    GLuint depth = 0, normals = 0;
    std::optional<glm::dmat4> own_projection;

private:
    struct Mesh {
        GLuint vertices = 0, indices = 0;
        GLsizei count = 0;
        float sway = 0.0f;
    };
    Depths depths_;
    GLuint framebuffer_ = 0, array_ = 0, program_ = 0;
    std::vector<Mesh> meshes_;
};

/// The same world three times: for an engine with gnomon::Shadows, for Gnomon's own frame, and for rays.
class EmbedTest : public TracedFrameTest {
protected:
    virtual ShadowsOptions options() {
        ShadowsOptions wanted;
        wanted.message = [this](std::string_view text) { said.emplace_back(text); };
        return wanted;
    }
    /// Lookups from the first unit on that the tests' own passes leave free.
    static LookupOptions lookup_of_triangles() {
        return {.first_texture_unit = 2,
                .texture_unit_count = 14,
                .storage_binding = 3,
                .alpha_tests = false,
                .filters = {ShadowFilter::triangles}};
    }
    void SetUp() override {
        TracedFrameTest::SetUp();
        auto made = Shadows::create(options());
        ASSERT_TRUE(made) << to_line(made.error());
        shadows = std::move(made).value();
        settings.viewport_px = {kWidth_px, kHeight_px};
        settings.rays = false;
    }
    void TearDown() override {
        shadows.reset();
        engine.reset();
        others.clear();
        EXPECT_THAT(said, ::testing::IsEmpty());
        TracedFrameTest::TearDown();
    }
    void make_engine(Depths depths, GLsizei samples = 1) { engine = std::make_unique<Engine>(depths, samples); }

    CasterId add(const game::Shape& shape, const glm::dmat4& world_from_mesh = glm::dmat4(1.0)) {
        game::Shape placed;
        game::append(placed, shape, world_from_mesh);
        place(add_analysed(placed));
        engine->add(placed.positions, placed.indices);
        room.push_back({placed.positions, placed.indices});
        for (const auto& other : others) other->add(placed.positions, placed.indices);
        const auto mesh = shadows->add_mesh({.name = "shape", .positions_m = placed.positions, .indices = placed.indices});
        EXPECT_TRUE(mesh) << to_line(mesh.error());
        return shadows->add_caster({.mesh = mesh.value()});
    }
    /// Adds a ground with a table, a bar and a card on it.
    void add_room() {
        add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
        add(game::make_box({-0.8, 0.7, -0.5}, {0.8, 0.8, 0.5}));
        for (const double x : {-0.7, 0.7})
            for (const double z : {-0.4, 0.4}) add(game::make_bar({x, 0.0, z}, {x, 0.7, z}, 0.04, 12));
        add(game::make_sphere(0.3, 24, 16), glm::translate(glm::dmat4(1.0), {0.1, 1.1, 0.0}));
        add(game::make_card({-1.6, 0.6, 0.3}, {0.5, 0.0, 0.3}, {0.0, 0.9, 0.1}));
    }
    LightId add_shadowed(LightKind kind, const glm::dvec3& at_m, const LightShadow& shadow = {}) {
        const Light light{.kind = kind, .outer_cone_rad = 0.9f};
        const ecs::Entity entity = add_light(light, at_m, -at_m, shadow);
        // A spot's map turns with it; Shadows chooses the turn about the light's direction.
        const glm::dmat3 rotation = math::basis_from_back(glm::normalize(at_m));
        world.patch<Transform>(entity, [&](Transform& transform) { transform.rotation = glm::quat_cast(rotation); });
        return shadows->add_light({.light = light, .position_m = at_m, .direction = -at_m, .shadow = shadow});
    }
    void look_from(const glm::dvec3& at_m) {
        const glm::dvec3 to_m(0.0, 0.5, 0.0);
        add_camera({.fov_y_rad = kFov_rad, .near_m = kNear_m}, at_m, to_m - at_m);
        view.world_from_view = glm::inverse(glm::lookAt(at_m, to_m, glm::dvec3(0.0, 1.0, 0.0)));
    }
    /// Draws the engine's depths as the view sees them.
    void draw_depths(View& of, const Engine& by) const {
        of.clip_from_view = by.projection();
        of.clip_depth = by.clip_depth();
        of.depth_texture = by.depth;
        of.size_px = {kWidth_px, kHeight_px};
        by.draw(of.clip_from_view * glm::inverse(of.world_from_view));
    }
    static std::vector<std::uint8_t> layer_of(const Mask& mask, std::uint32_t layer) {
        EXPECT_EQ(mask.failure, "");
        EXPECT_GT(mask.layers, layer);
        std::vector<std::uint8_t> texels(kWidth_px * kHeight_px);
        if (mask.layers > layer)
            glGetTextureSubImage(mask.texture, 0, 0, 0, static_cast<GLint>(layer), kWidth_px, kHeight_px, 1, GL_RED,
                                 GL_UNSIGNED_BYTE, static_cast<GLsizei>(texels.size()), texels.data());
        return texels;
    }
    /// Draws the engine's depths, renders the shadows and reads one layer of the mask.
    std::vector<std::uint8_t> masked(std::uint32_t layer = 0) {
        draw_depths(view, *engine);
        return layer_of(shadows->render(view), layer);
    }
    /// Counts pixels in which two masks differ by more than rounding to 8 bits.
    static std::size_t differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(int{a[i]} - int{b[i]}) > 1;
        return count;
    }
    struct Difference {
        std::size_t surfaces = 0, dark = 0, lit = 0, other = 0;  // pixels; other: the mask is not the frame's visibility
        float largest = 0.0f;                                    // difference of a pixel, steps of 1/255
        double share() const { return static_cast<double>(other) / static_cast<double>(surfaces); }
    };
    /// Compares a mask with what Gnomon's own frame shows at the same pixels.
    Difference compared(const std::vector<std::uint8_t>& mask, std::uint32_t light = 0) {
        draw();
        const std::vector<float> truth = visibility(light);
        Difference d;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] < 0.0f) continue;
            ++d.surfaces;
            d.dark += truth[i] < 0.5f;
            d.lit += truth[i] >= 0.5f;
            const float apart = std::abs(static_cast<float>(mask[i]) - 255.0f * truth[i]);
            d.other += apart > 1.5f;
            d.largest = std::max(d.largest, apart);
        }
        return d;
    }

    std::unique_ptr<Engine> engine;
    std::vector<std::unique_ptr<Engine>> others;  // that draw the same meshes
    struct Room {
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> indices;
    };
    std::vector<Room> room;  // all that add() placed
    std::unique_ptr<Shadows> shadows;
    std::vector<std::string> said;
    View view;
};

/// Half a shadow edge's pixels may fall to the other side where depths are rounded otherwise.
inline constexpr std::size_t kFewPixels = 20;

}  // namespace gnomon
