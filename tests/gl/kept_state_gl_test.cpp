#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "tests/gl/frame_fixture.h"
#include "tests/gl/unusual_gl_state.h"
#include "tests/gl/watched_device.h"

// An engine that shares its context finds every state that OpenGL 4.5 core has as it was before each call.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

const char* name_of(EngineWork work) { return work == EngineWork::feedback ? "feedback" : "pipeline"; }

class UnusualState : public ::testing::TestWithParam<EngineWork> {
protected:
    void SetUp() override {
        auto made = platform::make_headless_context(true);
        ASSERT_TRUE(made) << to_line(made.error());
        context = std::move(made).value();
    }
    std::unique_ptr<platform::Context> context;
};

TEST_P(UnusualState, DiffersFromTheDefaultInEveryPiece) {
    const GlStateRecord fresh = record_gl_state();
    ASSERT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "the recorder queries what does not exist";
    const UnusualGlState engine(GetParam());
    const GlStateRecord unusual = record_gl_state();
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    EXPECT_GT(fresh.size(), 1000u);
    for (const auto& [name, value] : fresh)
        if (!UnusualGlState::is_default(GetParam(), name)) {
            EXPECT_NE(unusual.at(name), value) << name << " is at its default";
        }
    EXPECT_TRUE(unusual.contains("SUBROUTINE VERTEX_SHADER[0]"));
    EXPECT_EQ(differences(unusual, record_gl_state()), std::vector<std::string>{}) << "the recorder changes nothing";
}

/// Every function of the device, in unusual state.
class KeptState : public UnusualState {
protected:
    /// Calls everything and returns the differences found.
    std::vector<std::string> call_everything(bool keeps_state) {
        std::vector<std::string> found;
        const auto add = [&](const std::string& function, const std::string& difference) {
            found.push_back(function + ": " + difference);
        };
        const UnusualGlState engine(GetParam());
        const GlStateRecord before = record_gl_state();
        auto made = gl::make_gl45_device({}, {.keeps_state = keeps_state});
        EXPECT_TRUE(made);
        for (const std::string& difference : differences(before, record_gl_state())) add("make", difference);
        device = std::move(made).value();
        {
            WatchedDevice watched(*device, add);
            call_all(watched, keeps_state);
            EXPECT_THAT(watched.called(), SizeIs(16 + 2)) << "all of the interface, and imports";
        }
        EXPECT_EQ(gl::live_objects(*device), 0u);
        const GlStateRecord last = record_gl_state();
        device.reset();
        for (const std::string& difference : differences(last, record_gl_state())) add("end", difference);
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        EXPECT_THAT(engine.complaints(), SizeIs(::testing::Le(2u))) << "two creations are to fail";
        return found;
    }

    void call_all(WatchedDevice& watched, bool keeps_state) {
        watched.set_timing(gl::TimingMode::query);
        const std::vector<std::byte> pixels(8 * 8 * 4, std::byte{77});
        const auto colour =
            watched.create_texture({.label = "colour", .width = 8, .height = 8, .mips = 0}, pixels).handle;
        const auto depth =
            watched.create_texture({.label = "depth", .format = gl::Format::d32f, .width = 8, .height = 8}, {}).handle;
        const auto shadows =
            watched.create_texture({.label = "shadows", .format = gl::Format::d32f, .width = 8, .height = 8}, {})
                .handle;
        const auto copy = watched.create_texture({.label = "copy", .width = 8, .height = 8}, {}).handle;
        const auto other = watched.create_texture({.label = "other", .width = 8, .height = 8}, {}).handle;
        const auto sampler = watched.create_sampler({.label = "sampler", .compare = true, .anisotropy = 4.0f}).handle;
        const auto uniforms = watched.create_buffer({.label = "uniforms", .size = 512}, {}).handle;
        const auto storage = watched.create_buffer({.label = "storage", .size = 512, .texels = true}, {}).handle;
        const auto back =
            watched.create_buffer({.label = "back", .size = 512, .use = gl::BufferUse::read_back}, {}).handle;
        const auto two =
            watched.create_target({.label = "two", .colours = {{colour}, {other}}, .depth = {depth}}).handle;
        const auto one = watched.create_target({.label = "one", .colours = {{copy}}}).handle;
        const auto draws = watched.create_program({.label = "draws", .vertex = kVertex, .fragment = kFragment}).handle;
        const auto computes = watched.create_program({.label = "computes", .compute = kCompute}).handle;
        EXPECT_TRUE(two && one && draws && computes && back && sampler);
        for (int i = 0; i < 2; ++i) {
            gl::CommandList list;
            list.update<std::uint32_t>(uniforms, 0, std::vector<std::uint32_t>(64, 1));
            list.add(gl::ClearBuffer{storage, 0, 256});
            list.add(gl::BeginGroup{"all"});
            list.add(gl::BeginTimer{4});
            list.add(gl::BindUniforms{1, uniforms, 256, 256});
            list.add(gl::BindStorage{2, storage});
            list.add(gl::BindTexture{4, shadows, sampler});
            list.add(gl::BindTexels{6, storage});
            list.add(gl::Dispatch{computes});
            list.add(gl::BeginPass{.target = two, .viewport = {1, 1, 6, 6}, .clear_depth = true, .clear_colour = true});
            list.add(gl::SetScissor{{2, 2, 3, 3}});
            for (const gl::Blend blend : {gl::Blend::off, gl::Blend::add, gl::Blend::alpha, gl::Blend::largest}) {
                list.add(gl::SetPipeline{{.program = draws,
                                          .cull = gl::CullMode::back,
                                          .depth_test = gl::DepthTest::greater_equal,
                                          .depth_write = true,
                                          .depth_clamp = true,
                                          .blend = blend}});
                list.add(gl::DrawTriangle{.depth = 0.25f});
                list.add(gl::DrawLines{2});
                list.add(gl::DrawPoints{0, 1});
                list.add(gl::DrawPulled{0, 3});
            }
            list.add(gl::BindMeshes{storage, storage, storage});
            list.add(gl::DrawMeshes{0, 3, 0, 0, 1});
            list.add(gl::DrawMeshesIndirect{storage, 0, 2, 3, 1});
            list.add(gl::EndPass{true});
            list.add(gl::EndTimer{4});
            list.add(gl::BindTexture{4, {}, {}});
            list.add(gl::CopyTexture{copy, other, 0});
            list.add(gl::GenerateMips{colour});
            list.add(gl::CopyBuffer{storage, back});
            list.add(gl::Blit{two, one, {0, 0, 8, 8}, {0, 0, 8, 8}});
            list.add(gl::EndGroup{});
            EXPECT_EQ(watched.submit(list).failure, gl::Failure::none);
        }
        gl::CommandList unfinished;
        unfinished.add(gl::BeginGroup{"open"});
        unfinished.add(gl::BeginTimer{5});
        unfinished.add(gl::BeginPass{.target = one, .viewport = {0, 0, 8, 8}});
        unfinished.add(gl::BeginPass{.target = {999}});
        EXPECT_EQ(watched.submit(unfinished).failure, gl::Failure::invalid_value);
        EXPECT_EQ(watched.create_program({.label = "broken", .vertex = "no shader"}).failure,
                  gl::Failure::compile_failed);
        EXPECT_EQ(watched.create_texture({.width = 0}, {}).failure, gl::Failure::invalid_value);
        EXPECT_EQ(watched.create_target({.label = "nothing"}).failure, gl::Failure::incomplete_target);
        watched.finish();
        // Without the option the results go into the engine's query buffer.
        EXPECT_THAT(watched.take_timings(), SizeIs(keeps_state ? 2 : 0));
        std::vector<std::byte> bytes(512);
        EXPECT_EQ(watched.read_buffer(back, bytes), gl::Readback::done);
        bytes.resize(256);
        EXPECT_TRUE(watched.read_texture(copy, 0, bytes));
        import_both(watched);
        for (const auto target : {two, one}) watched.destroy(target);
        for (const auto texture : {colour, depth, shadows, copy, other}) watched.destroy(texture);
        for (const auto buffer : {uniforms, storage, back}) watched.destroy(buffer);
        for (const auto program : {draws, computes}) watched.destroy(program);
        watched.destroy(sampler);
    }
    void import_both(WatchedDevice& watched) {
        GLuint texture = 0, buffer = 0;
        glCreateTextures(GL_TEXTURE_2D, 1, &texture);
        glTextureStorage2D(texture, 1, GL_DEPTH24_STENCIL8, 4, 4);
        glCreateBuffers(1, &buffer);
        glNamedBufferData(buffer, 64, nullptr, GL_STATIC_DRAW);
        const auto map = watched.watch("import_texture", [&] {
            return gl::import_texture(*device, texture, {.format = gl::Format::d24_s8, .width = 4, .height = 4});
        });
        const auto texels = watched.watch(
            "import_buffer", [&] { return gl::import_buffer(*device, buffer, {.size = 64, .texels = true}); });
        EXPECT_TRUE(map);
        EXPECT_TRUE(texels);
        watched.destroy(map);
        watched.destroy(texels);
        glDeleteTextures(1, &texture);
        glDeleteBuffers(1, &buffer);
    }

    static constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(std140, binding = 1) uniform Block { vec4 values[16]; };
void main() { gl_Position = vec4(position + values[gl_VertexID % 16].xyz, 1.0); gl_PointSize = 2.0; }
)";
    static constexpr const char* kFragment = R"(#version 450 core
layout(binding = 4) uniform sampler2DShadow map;
layout(binding = 6) uniform usamplerBuffer texels;
layout(binding = 9) uniform samplerCube free_cube;
layout(std430, binding = 2) readonly buffer Storage { vec4 stored[]; };
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() {
    first = vec4(texture(map, vec3(0.5))) + vec4(texelFetch(texels, 0)) + texture(free_cube, vec3(1.0));
    second = stored[0];
}
)";
    static constexpr const char* kCompute = R"(#version 450 core
layout(local_size_x = 1) in;
layout(std430, binding = 2) buffer Storage { uint stored[]; };
layout(std430, binding = 5) readonly buffer Free { uint unbound[]; };
void main() { stored[0] = 1u + uint(unbound.length()); }
)";
    std::unique_ptr<gl::Device> device;
};

TEST_P(KeptState, IsEqualAfterEveryCall) { EXPECT_THAT(call_everything(true), IsEmpty()); }

/// Feedback that runs forbids other programs, so that only the other work has a defined outcome without the option.
class UnkeptState : public KeptState {};
TEST_P(UnkeptState, LosesWhatTheListSets) {
    const std::vector<std::string> found = call_everything(false);
    for (const char* name :
         {"submit: CLIP_ORIGIN:", "submit: DRAW_FRAMEBUFFER_BINDING:", "submit: VIEWPORT[15]:",
          "submit: TEXTURE_BINDING_3D[31]:", "submit: SAMPLER_BINDING[0]:", "submit: UNIFORM_BUFFER[3]:",
          "submit: SHADER_STORAGE_BUFFER[1]:", "submit: UNIFORM_BUFFER_BINDING:", "submit: BLEND[7]:",
          "submit: COLOR_WRITEMASK[2]:", "submit: STENCIL_TEST:", "create_texture: UNPACK_ROW_LENGTH:",
          "create_texture: PACK_ALIGNMENT:", "submit: VERTEX_ARRAY_BINDING:", "submit: SUBROUTINE"})
        EXPECT_THAT(found, Contains(StartsWith(name)));
}

INSTANTIATE_TEST_SUITE_P(Engine, UnusualState, ::testing::Values(EngineWork::feedback, EngineWork::pipeline),
                         [](const auto& param) { return name_of(param.param); });
INSTANTIATE_TEST_SUITE_P(Engine, UnkeptState, ::testing::Values(EngineWork::pipeline),
                         [](const auto& param) { return name_of(param.param); });
INSTANTIATE_TEST_SUITE_P(Engine, KeptState, ::testing::Values(EngineWork::feedback, EngineWork::pipeline),
                         [](const auto& param) { return name_of(param.param); });

/// Whole frames, with a light per way that shadows are made.
class KeptFrames : public FrameTest, public ::testing::WithParamInterface<EngineWork> {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0}));
        const std::uint32_t box = add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5}));
        place(plane, {}, false);
        moving = place(box, {.translation_m = {-1.5, 0.3, 0.0}});
        place(box, {.translation_m = {1.5, 0.3, 0.0}});
        add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        using Row = std::pair<LightKind, ShadowFilter>;
        int number = 0;
        for (const auto& [kind, filter] :
             {Row{LightKind::directional, ShadowFilter::automatic}, Row{LightKind::spot, ShadowFilter::exact},
              Row{LightKind::point, ShadowFilter::exact_soft}, Row{LightKind::point, ShadowFilter::moments},
              Row{LightKind::directional, ShadowFilter::evsm4}}) {
            const double angle = 0.9 * ++number;
            const glm::dvec3 at(2.0 * std::cos(angle), 4.0, 2.0 * std::sin(angle));
            const Light light{.kind = kind, .intensity = 100.0f, .outer_cone_rad = 0.6f, .source_radius_m = 0.1f};
            add_light(light, at, -at, {.filter = filter, .resolution_px = 64});
        }
        settings = {.viewport_px = {64, 48}, .exposure_ev = {}, .repeatable = true, .leave_out_dim_lights = false};
    }
    struct Pictures {
        std::vector<std::vector<std::uint8_t>> rgba;
        std::vector<std::vector<float>> visibility;  // last frame's, by light
        std::size_t timed_lights = 0;
        bool operator==(const Pictures& other) const { return rgba == other.rgba && visibility == other.visibility; }
    };
    Pictures play(gl::Device& on) {
        Pictures pictures;
        auto made = FrameSystem::create(on, library);
        EXPECT_TRUE(made) << to_line(made.error());
        if (!made) return pictures;
        FrameSystem& frame = *made.value();
        for (int i = 0; i < 4; ++i) {
            on.set_timing(i % 2 == 0 ? gl::TimingMode::query : gl::TimingMode::finish);
            world.patch<Transform>(moving, [&](Transform& at) { at.translation_m.x = -1.5 + 0.2 * i; });
            frame.run(world, settings);
            EXPECT_STREQ(gl::to_text(frame.report().failure), "none");
            EXPECT_TRUE(frame.read_picture(pictures.rgba.emplace_back()));
            on.finish();
            for (const LightReport& light : frame.report().lights) pictures.timed_lights += light.gpu_us.has_value();
        }
        for (std::uint32_t light = 0; light < frame.snapshot().lights.size(); ++light)
            EXPECT_TRUE(frame.read_visibility(light, pictures.visibility.emplace_back()));
        return pictures;
    }
    ecs::Entity moving;
};

TEST_P(KeptFrames, AreThoseOfAContextOfItsOwnAndChangeNothing) {
    const Pictures alone = play(device());
    EXPECT_NE(alone.rgba[0], alone.rgba[3]) << "something moves";
    const UnusualGlState engine(GetParam());
    auto made = gl::make_gl45_device({}, {.keeps_state = true});
    ASSERT_TRUE(made);
    const std::unique_ptr<gl::Device> kept = std::move(made).value();
    std::size_t differences = 0;
    WatchedDevice watched(*kept, [&](const std::string& function, const std::string& difference) {
        if (++differences < 20) ADD_FAILURE() << function << ": " << difference;
    });
    const Pictures shared = play(watched);
    EXPECT_EQ(shared, alone) << "the engine's state reaches a picture";
    EXPECT_GT(shared.timed_lights, 0u);
    EXPECT_TRUE(watched.called().contains("create_program"));
    EXPECT_EQ(differences, 0u);
    EXPECT_EQ(gl::live_objects(*kept), 0u);
    EXPECT_THAT(engine.complaints(), IsEmpty());
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

INSTANTIATE_TEST_SUITE_P(Engine, KeptFrames, ::testing::Values(EngineWork::feedback, EngineWork::pipeline),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace gnomon
