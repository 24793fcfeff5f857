#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/math/projection.h"
#include "gnomon/shadows.h"
#include "tests/gl/traced_frame_fixture.h"

// gnomon::Shadows beside an engine of its own, judged by rays and by what Gnomon's own frame shows of the same world.
namespace gnomon {
namespace {

enum class Depths : std::uint8_t { usual_d24, usual_float, reversed };
const char* name_of(Depths depths) {
    return depths == Depths::usual_d24 ? "D24" : depths == Depths::usual_float ? "D32F" : "ReversedD32F";
}

constexpr int kWidth_px = 320, kHeight_px = 256;
constexpr double kNear_m = 0.1, kFov_rad = 0.9;

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
    /// The projection with which depths are drawn.
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
    static GLuint linked(const char* vertex, const char* fragment) {
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
    Depths depths_;
    GLuint framebuffer_ = 0, array_ = 0, program_ = 0;
    std::vector<Mesh> meshes_;
};

/// The same world three times: for an engine with gnomon::Shadows, for Gnomon's own frame, and for rays.
class EmbedTest : public TracedFrameTest {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        auto made = Shadows::create({.message = [this](std::string_view text) { said.emplace_back(text); }});
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
        for (const auto& other : others) other->add(placed.positions, placed.indices);
        const auto mesh = shadows->add_mesh({.name = "shape", .positions_m = placed.positions, .indices = placed.indices});
        EXPECT_TRUE(mesh) << to_line(mesh.error());
        return shadows->add_caster({.mesh = mesh.value()});
    }
    /// A ground with a table, a bar and a card on it.
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
        add_light(light, at_m, -at_m, shadow);
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
        double share() const { return static_cast<double>(other) / static_cast<double>(surfaces); }
    };
    /// Compares a mask with what Gnomon's own frame says of the same pixels.
    Difference compared(const std::vector<std::uint8_t>& mask, std::uint32_t light = 0) {
        draw();
        const std::vector<float> truth = visibility(light);
        Difference d;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] < 0.0f) continue;
            ++d.surfaces;
            d.dark += truth[i] < 0.5f;
            d.lit += truth[i] >= 0.5f;
            d.other += std::abs(static_cast<float>(mask[i]) - 255.0f * truth[i]) > 1.5f;
        }
        return d;
    }

    std::unique_ptr<Engine> engine;
    std::vector<std::unique_ptr<Engine>> others;  // that draw the same meshes
    std::unique_ptr<Shadows> shadows;
    std::vector<std::string> said;
    View view;
};

class EmbedMask : public EmbedTest, public ::testing::WithParamInterface<std::tuple<LightKind, Depths>> {};

TEST_P(EmbedMask, IsWhatTheFrameShows) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const Difference d = compared(masked());
    std::printf("%s %s: %zu surfaces, %zu dark, %zu other, %.4f %%\n", kind_name(kind), name_of(depths), d.surfaces, d.dark,
                d.other, 100.0 * d.share());
    EXPECT_GT(d.dark, 2000u);
    EXPECT_GT(d.lit, 20000u);
    EXPECT_LT(d.share(), 0.0005);
}

TEST_P(EmbedMask, NeedsNoNormals) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    const Difference d = compared(masked());
    std::printf("%s %s, derived normals: %zu other, %.4f %%\n", kind_name(kind), name_of(depths), d.other, 100.0 * d.share());
    EXPECT_LT(d.share(), 0.001);
}

/// Half a shadow edge's pixels may fall to the other side where depths are rounded otherwise.
constexpr std::size_t kFewPixels = 20;

class EmbedScene : public EmbedTest {
protected:
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
    }
    void add_lit_room() {
        add_room();
        add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
        look_from({0.5, 2.5, 4.0});
    }
};

TEST_F(EmbedScene, WithoutItsCasterThereIsNoShadow) {
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    const CasterId box = add(game::make_box({-0.8, 0.7, -0.5}, {0.8, 0.8, 0.5}));
    add_shadowed(LightKind::point, {0.0, 3.0, 0.0});
    look_from({0.5, 4.5, 4.0});
    const std::vector<std::uint8_t> with = masked();
    shadows->remove(box);
    const std::vector<std::uint8_t> without = masked();
    EXPECT_GT(differing(with, without), 1000u);
    const std::size_t under_the_box = static_cast<std::size_t>(std::count(without.begin(), without.end(), 255));
    EXPECT_GT(under_the_box, static_cast<std::size_t>(std::count(with.begin(), with.end(), 255)) + 1000);
}

TEST_F(EmbedScene, FollowsWhatMovesAndKeepsWhatStays) {
    add_lit_room();
    masked();
    masked();
    EXPECT_EQ(shadows->status().maps_drawn, 0u) << "nothing moved";
    const auto mesh = shadows->add_mesh({.positions_m = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).positions,
                                         .indices = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).indices});
    const CasterId box = shadows->add_caster({.mesh = mesh.value(), .world_from_mesh = glm::translate(glm::dmat4(1.0), {0.6, 1.2, 0.3})});
    const std::vector<std::uint8_t> first = masked();
    EXPECT_GT(shadows->status().maps_drawn, 0u);
    shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.2, 1.4, 0.3}));
    const std::vector<std::uint8_t> second = masked();
    EXPECT_GT(shadows->status().maps_drawn, 0u);
    EXPECT_GT(differing(first, second), 200u);
    shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.6, 1.2, 0.3}));
    EXPECT_EQ(differing(masked(), first), 0u);
}

TEST_F(EmbedScene, LayersAreTheViewsLightsInItsOrder) {
    add_room();
    const LightId sun = add_shadowed(LightKind::directional, {1.5, 3.0, 1.0});
    const LightId lamp = add_shadowed(LightKind::point, {-1.0, 2.5, 1.0});
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> of_sun = masked(0), of_lamp = masked(1);
    EXPECT_GT(differing(of_sun, of_lamp), 1000u);
    const LightId order[] = {lamp, sun, lamp};
    view.lights = order;
    EXPECT_EQ(differing(masked(0), of_lamp), 0u);
    EXPECT_EQ(differing(masked(1), of_sun), 0u);
    EXPECT_EQ(differing(masked(2), of_lamp), 0u);
    shadows->remove(sun);
    const std::vector<std::uint8_t> of_none = masked(1);
    EXPECT_EQ(std::count(of_none.begin(), of_none.end(), 255), kWidth_px * kHeight_px) << "a light that is gone darkens nothing";
    EXPECT_EQ(differing(masked(0), of_lamp), 0u);
}

TEST_F(EmbedScene, AnOffCentrePictureIsAPartOfTheWhole) {
    add_lit_room();
    const double top = kNear_m * std::tan(0.5 * kFov_rad), right = top * kWidth_px / kHeight_px;
    const glm::dmat4 whole = glm::frustumRH_NO(-right, right, -top, top, kNear_m, 100.0);
    // Half as wide and high about a place off the axis, so that each pixel is a quarter of one of the whole's.
    const glm::dmat4 part = glm::frustumRH_NO(-0.25 * right, 0.75 * right, -0.75 * top, 0.25 * top, kNear_m, 100.0);
    engine->own_projection = part;
    const std::vector<std::uint8_t> seen = masked();
    engine->own_projection = whole;
    const std::vector<std::uint8_t> all = masked();
    std::size_t compared = 0, other = 0;
    for (int y = 0; y < kHeight_px; ++y)
        for (int x = 0; x < kWidth_px; ++x) {
            const int in_x = (x + 3 * kWidth_px / 4) / 2, in_y = (y + kHeight_px / 4) / 2;
            if (in_x < 1 || in_x + 1 >= kWidth_px || in_y < 1 || in_y + 1 >= kHeight_px) continue;
            const auto at = [&](int dx, int dy) { return all[static_cast<std::size_t>((in_y + dy) * kWidth_px + in_x + dx)]; };
            const bool even = at(0, 0) == at(1, 0) && at(0, 0) == at(-1, 0) && at(0, 0) == at(0, 1) && at(0, 0) == at(0, -1) &&
                              at(0, 0) == at(1, 1) && at(0, 0) == at(-1, -1) && at(0, 0) == at(1, -1) && at(0, 0) == at(-1, 1);
            if (!even) continue;
            ++compared;
            other += seen[static_cast<std::size_t>(y * kWidth_px + x)] != at(0, 0);
        }
    EXPECT_GT(compared, 60000u);
    EXPECT_LT(other, 60u) << "of " << compared << ": only thin features between the whole's pixels";
}

TEST_F(EmbedTest, EachSampleOfAMultisampledPictureHasALayer) {
    make_engine(Depths::usual_float, 4);
    others.push_back(std::make_unique<Engine>(Depths::usual_float));
    Engine& plain = *others.front();
    add_room();
    add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    ASSERT_EQ(mask.samples, 4u);
    ASSERT_EQ(mask.layers, 4u);
    std::vector<std::vector<std::uint8_t>> samples;
    for (std::uint32_t i = 0; i < 4; ++i) samples.push_back(layer_of(mask, i));
    EXPECT_GT(differing(samples[0], samples[3]), 100u) << "edges lie elsewhere";
    const auto places = gl::sample_positions(device(), engine->depth);
    ASSERT_EQ(places.size(), 4u);
    View single = view;
    single.normal_texture = plain.normals;
    for (std::size_t i = 0; i < 4; ++i) {
        glm::dmat4 jittered = engine->projection();
        jittered[2][0] += 2.0 * (places[i][0] - 0.5) / kWidth_px;
        jittered[2][1] += 2.0 * (places[i][1] - 0.5) / kHeight_px;
        plain.own_projection = jittered;
        draw_depths(single, plain);
        const Mask alone = shadows->render(single);
        EXPECT_EQ(alone.samples, 1u);
        EXPECT_LT(differing(layer_of(alone, 0), samples[i]), kFewPixels) << "sample " << i;
    }
}

TEST_F(EmbedScene, ViewsAtOnceShowWhatEachShowsAlone) {
    others.push_back(std::make_unique<Engine>(Depths::reversed));
    add_lit_room();
    draw_depths(view, *engine);
    View from_behind = view;
    from_behind.world_from_view = glm::inverse(glm::lookAt(glm::dvec3(-3.0, 2.0, -2.0), glm::dvec3(0.0, 0.5, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
    from_behind.normal_texture = others.front()->normals;
    draw_depths(from_behind, *others.front());
    const View both[] = {view, from_behind};
    const auto masks = shadows->render(both);
    ASSERT_EQ(masks.size(), 2u);
    const std::vector<std::uint8_t> first = layer_of(masks[0], 0), second = layer_of(masks[1], 0);
    EXPECT_GT(differing(first, second), 1000u);
    EXPECT_LT(differing(layer_of(shadows->render(view), 0), first), kFewPixels);
    EXPECT_LT(differing(layer_of(shadows->render(from_behind), 0), second), kFewPixels);
}

TEST_F(EmbedScene, AFlatViewIsThatOfTheFrame) {
    add_room();
    add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    const glm::dvec3 at_m(2.0, 3.0, 4.0), to_m(0.0, 0.5, 0.0);
    constexpr double kHalf_m = 1.5;
    add_camera({.projection = CameraProjection::orthographic, .half_height_m = kHalf_m, .near_m = 0.1, .far_m = 30.0}, at_m, to_m - at_m);
    view.world_from_view = glm::inverse(glm::lookAt(at_m, to_m, glm::dvec3(0.0, 1.0, 0.0)));
    const double half_x = kHalf_m * kWidth_px / kHeight_px;
    engine->own_projection = glm::orthoRH_NO(-half_x, half_x, -kHalf_m, kHalf_m, 0.1, 30.0);
    const Difference d = compared(masked());
    EXPECT_GT(d.dark, 2000u);
    EXPECT_LT(d.share(), 0.0005) << d.other;
}

TEST_F(EmbedScene, WhatCannotBeReadHasAReasonAndHarmsNoOther) {
    add_lit_room();
    const std::vector<std::uint8_t> good = masked();
    const auto failure = [&](auto change) {
        View bad = view;
        change(bad);
        const View both[] = {bad, view};
        const auto masks = shadows->render(both);
        EXPECT_EQ(masks[0].texture, 0u);
        EXPECT_LT(differing(layer_of(masks[1], 0), good), kFewPixels);
        return std::string(masks[0].failure);
    };
    EXPECT_EQ(failure([](View& v) { v.depth_texture = 0; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.depth_texture = 4711; }), "view.depth");
    EXPECT_EQ(failure([&](View& v) { v.depth_texture = engine->normals; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.normal_texture = 4711; }), "view.normals");
    EXPECT_EQ(failure([](View& v) { v.size_px = {0, 10}; }), "view.size");
    EXPECT_EQ(failure([](View& v) { v.size_px = {kWidth_px + 1, kHeight_px}; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.clip_from_view = glm::dmat4(std::numeric_limits<double>::quiet_NaN()); }), "view.projection");
    EXPECT_EQ(failure([](View& v) { v.world_from_view[0][0] = std::numeric_limits<double>::infinity(); }), "view.projection");
    EXPECT_EQ(failure([](View& v) { v.world_from_view *= 2.0; }), "view.projection");
}

TEST_F(EmbedScene, NothingAtAllIsNoFault) {
    EXPECT_TRUE(shadows->render(std::span<const View>{}).empty());
    look_from({0.5, 2.5, 4.0});
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    EXPECT_EQ(mask.failure, "");
    EXPECT_EQ(mask.layers, 0u);
    EXPECT_FALSE(shadows->status(LightId{}).gpu_us);
    EXPECT_EQ(shadows->visibility(LightId{}, {0.0, 0.0, 0.0}), 0.0f);
}

TEST_F(EmbedScene, ALightOfRaysGetsAFilteredMapAndSaysSo) {
    add_room();
    const LightId lamp = add_shadowed(LightKind::spot, {1.5, 3.0, 1.0}, {.filter = ShadowFilter::exact});
    look_from({0.5, 2.5, 4.0});
    const Difference d = compared(masked());
    EXPECT_LT(d.share(), 0.0005) << d.other;
    EXPECT_EQ(shadows->status(lamp).reason, Reason::rays_off);
    EXPECT_EQ(shadows->status(lamp).state, LightState::degraded);
    EXPECT_NE(shadows->status(lamp).filter, ShadowFilter::exact);
}

TEST_F(EmbedScene, ABudgetIsKeptAndSaid) {
    add_lit_room();
    masked();
    const std::uint64_t bytes = shadows->status().bytes;
    shadows->set_budget({.bytes = bytes / 5});
    for (int frame = 0; frame < 3; ++frame) masked();
    EXPECT_LE(shadows->status().bytes, bytes / 5);
    EXPECT_GT(shadows->status().bytes, 0u);
}

TEST_F(EmbedScene, QueriesAgreeWithTheMask) {
    add_room();
    const LightId lamp = add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    masked();
    EXPECT_EQ(shadows->visibility(lamp, {0.0, 2.0, 0.0}), 1.0f);
    EXPECT_EQ(shadows->visibility(lamp, {0.0, 0.6, 0.0}), 0.0f) << "under the table";
}

/// A fence of grass: cards with many rows, which bend.
game::Shape grass() {
    game::Shape shape;
    constexpr int kRows = 12;
    for (int blade = 0; blade < 9; ++blade) {
        const double x = -0.8 + 0.2 * blade, z = 0.25 * ((blade * 7) % 5) - 0.5;
        for (int row = 0; row < kRows; ++row) {
            const double low = 1.2 * row / kRows, high = 1.2 * (row + 1) / kRows;
            game::append(shape, game::make_card({x, 0.5 * (low + high), z}, {0.18, 0.0, 0.05}, {0.0, high - low, 0.0}));
        }
    }
    return shape;
}

class EmbedDrawable : public EmbedTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Adds grass that only the engine's vertex shader bends; rays and the frame get it as it is bent.
    void add_grass(float sway) {
        game::Shape bent = grass();
        const game::Shape straight = bent;
        for (glm::vec3& p : bent.positions) p.x += sway * p.y * p.y;
        place(add_analysed(bent));
        mesh_ = engine->add(straight.positions, straight.indices, sway);
        const auto draw = [this](const DrawableView& map) {
            ++calls;
            engine->draw_one(mesh_, map.clip_from_world);
        };
        drawable = shadows->add_drawable({.name = "grass", .draw = draw, .bounds = kBounds});
    }
    static constexpr Bounds kBounds{{-1.6, 0.0, -0.7}, {1.6, 1.3, 0.7}};
    CasterId drawable;
    int calls = 0;

private:
    std::size_t mesh_ = 0;
};

TEST_P(EmbedDrawable, CastsWhatItsOwnVertexStageDraws) {
    make_engine(Depths::usual_float);
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    add(game::make_box({-0.3, 0.0, 0.6}, {0.3, 0.7, 0.9}));
    add_grass(0.3f);
    const LightId lamp = add_shadowed(GetParam(), {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const Difference d = compared(masked());
    std::printf("%s: %zu surfaces, %zu dark, %zu other, %.4f %%, %d draws\n", kind_name(GetParam()), d.surfaces, d.dark, d.other,
                100.0 * d.share(), calls);
    EXPECT_GT(calls, 0);
    EXPECT_GT(d.dark, 500u);
    EXPECT_LT(d.share(), 0.003);
    EXPECT_EQ(shadows->status(lamp).state, LightState::rendered);
}

TEST_P(EmbedDrawable, StandingWindCostsNothing) {
    make_engine(Depths::usual_float);
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    add_grass(0.3f);
    add_shadowed(GetParam(), {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const std::vector<std::uint8_t> before = masked();
    calls = 0;
    masked();
    EXPECT_EQ(calls, 0);
    EXPECT_EQ(shadows->status().maps_drawn, 0u);
    shadows->redraw(drawable, kBounds);
    EXPECT_EQ(differing(masked(), before), 0u) << "it drew the same";
    EXPECT_GT(calls, 0);
    shadows->remove(drawable);
    calls = 0;
    EXPECT_GT(differing(masked(), before), 400u) << "control: without it there is no shadow";
    EXPECT_EQ(calls, 0);
}

TEST_P(EmbedDrawable, WindRedrawsOnlyWhatShowsIt) {
    make_engine(Depths::usual_float);
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    add(game::make_box({4.0, 0.5, -0.5}, {5.0, 1.0, 0.5}));
    add_grass(0.1f);
    add_shadowed(GetParam(), {1.5, 3.0, 1.0});
    const LightId elsewhere = shadows->add_light({.light = {.kind = LightKind::spot, .range_m = 6.0f, .outer_cone_rad = 0.4f},
                                                  .position_m = {4.5, 4.0, 0.0}});
    look_from({3.5, 4.5, 8.0});
    view.normal_texture = engine->normals;
    masked();
    ASSERT_EQ(shadows->status(elsewhere).state, LightState::rendered) << reason_code(shadows->status(elsewhere).reason);
    for (int frame = 0; frame < 3; ++frame) {
        shadows->redraw(drawable, kBounds);
        masked();
        EXPECT_GT(shadows->status().maps_drawn, 0u);
        EXPECT_EQ(shadows->status(elsewhere).maps_drawn, 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EmbedDrawable, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(kind_name(row.param)); });

INSTANTIATE_TEST_SUITE_P(All, EmbedMask,
                         ::testing::Combine(::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                                            ::testing::Values(Depths::usual_d24, Depths::usual_float, Depths::reversed)),
                         [](const auto& row) {
                             return std::string(kind_name(std::get<0>(row.param))) + name_of(std::get<1>(row.param));
                         });

}  // namespace
}  // namespace gnomon
