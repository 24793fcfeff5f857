#include <epoxy/egl.h>

#include <thread>

#include "tests/gl/embed_fixture.h"
#include "tests/gl/gl_state_record.h"
#include "tests/gl/lookup_pass.h"
#include "tests/gl/packed_mesh.h"

// An engine with two contexts that share objects, and gnomon::Shadows in one or in each of them.
namespace gnomon {
namespace {

/// A second context beside the current one.
class OtherContext {
public:
    explicit OtherContext(bool shares) : display_(eglGetCurrentDisplay()), first_(eglGetCurrentContext()), surface_(eglGetCurrentSurface(EGL_DRAW)) {
        EGLint id = 0, count = 0;
        EGLConfig config = nullptr;  // a context without one has id 0
        eglQueryContext(display_, first_, EGL_CONFIG_ID, &id);
        const EGLint of_id[] = {EGL_CONFIG_ID, id, EGL_NONE};
        if (id != 0) eglChooseConfig(display_, of_id, &config, 1, &count);
        constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                                          EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET, EGL_NONE};
        context_ = eglCreateContext(display_, config, shares ? first_ : EGL_NO_CONTEXT, kAttributes);
    }
    OtherContext(const OtherContext&) = delete;
    OtherContext& operator=(const OtherContext&) = delete;
    ~OtherContext() {
        back();
        eglDestroyContext(display_, context_);
    }
    bool enter() const { return context_ != EGL_NO_CONTEXT && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE; }
    void back() const { eglMakeCurrent(display_, surface_, surface_, first_); }
    void leave() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

private:
    EGLDisplay display_;
    EGLContext first_, context_ = EGL_NO_CONTEXT;
    EGLSurface surface_;
};

/// Vertex arrays and framebuffers of a context, with many names that objects in the other one have, too.
struct OwnObjects {
    static constexpr GLsizei kCount = 200;
    OwnObjects() {
        glCreateVertexArrays(kCount, arrays.data());
        glCreateFramebuffers(kCount, framebuffers.data());
    }
    bool are_alive() const {
        return std::all_of(arrays.begin(), arrays.end(), [](GLuint name) { return glIsVertexArray(name) == GL_TRUE; }) &&
               std::all_of(framebuffers.begin(), framebuffers.end(), [](GLuint name) { return glIsFramebuffer(name) == GL_TRUE; });
    }
    std::array<GLuint, kCount> arrays{}, framebuffers{};
};

/// Returns a fence after the current context's commands, for contexts that read their results.
GLsync fenced() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    return fence;
}
void wait_for(GLsync fence) {
    glWaitSync(fence, 0, GL_TIMEOUT_IGNORED);
    glDeleteSync(fence);
}

class EmbedContexts : public EmbedTest {
protected:
    ShadowsOptions options() override {
        ShadowsOptions wanted = EmbedTest::options();
        wanted.lookup = lookup_of_triangles();
        return wanted;
    }
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
        add_room();
        lamp = add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
        look_from({0.5, 2.5, 4.0});
    }
    LightId lamp;
};

TEST_F(EmbedContexts, RenderingInAnotherIsRefused) {
    const std::vector<std::uint8_t> before = masked();
    for (const bool shares : {true, false}) {
        SCOPED_TRACE(shares);
        const OtherContext other(shares);
        ASSERT_TRUE(other.enter());
        const OwnObjects objects;
        auto of_other = std::move(Shadows::create().value());
        const GlStateRecord state = record_gl_state();
        const View both[] = {view, view};
        const auto masks = shadows->render(both);
        ASSERT_EQ(masks.size(), 2u);
        for (const Mask& mask : masks) {
            EXPECT_EQ(mask.failure, "context.other");
            EXPECT_EQ(mask.texture, 0u);
        }
        EXPECT_EQ(shadows->status().failure, "context.other");
        EXPECT_EQ(shadows->status().maps_drawn, 0u);
        EXPECT_THAT(differences(state, record_gl_state()), ::testing::IsEmpty());
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        EXPECT_TRUE(objects.are_alive());
        of_other.reset();
        other.back();
        EXPECT_EQ(masked(), before) << "back in its own context it goes on";
        EXPECT_EQ(shadows->status().maps_drawn, 0u) << "with the maps that it had";
    }
}

TEST_F(EmbedContexts, OneWithoutOpenGl45IsRefusedByNameAndPage) {
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext own = eglGetCurrentContext();
    const EGLSurface surface = eglGetCurrentSurface(EGL_DRAW);
    ASSERT_EQ(eglBindAPI(EGL_OPENGL_ES_API), EGLBoolean{EGL_TRUE});
    constexpr EGLint kEs3[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLContext es = eglCreateContext(display, nullptr, EGL_NO_CONTEXT, kEs3);
    const bool entered = es != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, es) == EGL_TRUE;
    std::string rule, message;
    if (entered) {
        const auto made = Shadows::create();
        if (!made) rule = made.error().rule, message = made.error().message;
    }
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display, surface, surface, own);
    if (es != EGL_NO_CONTEXT) eglDestroyContext(display, es);
    if (!entered) GTEST_SKIP() << "no context of OpenGL ES here";
    EXPECT_EQ(rule, "gl.version");
    EXPECT_THAT(message, ::testing::AllOf(::testing::HasSubstr("not OpenGL 4.5"), ::testing::HasSubstr("docs/reference/limits.md"), ::testing::HasSubstr("OpenGL ES")));
    EXPECT_GT(masked().size(), 0u) << "back in its own context it goes on";
}

TEST_F(EmbedContexts, DestroyedInAnotherItLeavesThatOnesObjectsAlone) {
    masked();
    shadows->set_budget({.gpu_ms = 5.0f});  // with timers
    masked();
    const OtherContext other(true);
    ASSERT_TRUE(other.enter());
    const OwnObjects objects;
    shadows.reset();
    EXPECT_TRUE(objects.are_alive());
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    other.back();
}

TEST_F(EmbedContexts, OneInEachWorksSideBySide) {
    // A mesh in buffers is drawn from by both; nothing of it exists twice.
    const game::Shape shape = game::make_box({-1.7, 0.3, 0.2}, {-1.1, 0.9, 0.8});
    const PackedMesh packed(shape, {.name = "shared"});
    shadows->add_caster({.mesh = shadows->add_buffer_mesh(packed.desc).value()});
    const std::vector<std::uint8_t> expected = masked();
    const GLsync fence = fenced();
    const OtherContext other(true);
    ASSERT_TRUE(other.enter());
    wait_for(fence);
    {
        Engine window(Depths::usual_float);
        auto of_window = std::move(Shadows::create().value());
        for (const Room& part : room) {
            window.add(part.positions, part.indices);
            of_window->add_caster({.mesh = of_window->add_mesh({.positions_m = part.positions, .indices = part.indices}).value()});
        }
        const CasterId caster = of_window->add_caster({.mesh = of_window->add_buffer_mesh(packed.desc).value()});
        of_window->add_light({.light = {.kind = LightKind::point}, .position_m = {1.5, 3.0, 1.0}});
        for (int frame = 0; frame < 3; ++frame) {
            View in_window = view;
            in_window.normal_texture = window.normals;
            draw_depths(in_window, window);
            EXPECT_EQ(layer_of(of_window->render(in_window), 0), expected) << "frame " << frame;
            other.back();
            EXPECT_EQ(masked(), expected) << "frame " << frame;
            ASSERT_TRUE(other.enter());
        }
        of_window->remove(caster);
        View in_window = view;
        in_window.normal_texture = window.normals;
        draw_depths(in_window, window);
        EXPECT_GT(differing(layer_of(of_window->render(in_window), 0), expected), 300u) << "control: each has its own casters";
    }
    other.back();
    EXPECT_EQ(masked(), expected);
}

TEST_F(EmbedContexts, AMaskAndItsMapsAreReadInTheOther) {
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    const std::vector<std::uint8_t> here = layer_of(mask, 0);
    const std::string text = shadows->lookup_glsl().value();
    const GLsync fence = fenced();
    const OtherContext other(true);
    ASSERT_TRUE(other.enter());
    wait_for(fence);
    EXPECT_EQ(layer_of(mask, 0), here);
    EXPECT_GT(std::count(here.begin(), here.end(), 255), 10000);
    {
        const LookupPass pass(text);
        ASSERT_TRUE(shadows->bind_lookup());
        const std::vector<std::uint8_t> looked_up = pass.drawn(*engine, view, shadows->lookup_index(lamp));
        EXPECT_LT(differing(looked_up, here), kFewPixels);
        shadows->add_light({.light = {.kind = LightKind::directional}});  // what needs no OpenGL may be called anywhere
    }
    other.back();
    EXPECT_EQ(masked(0), here);
    EXPECT_GT(differing(masked(1), here), 1000u);
}

TEST_F(EmbedContexts, BuffersFilledInTheOtherAreDrawn) {
    const game::Shape shape = game::make_box({-1.7, 0.3, 0.2}, {-1.1, 0.9, 0.8});
    const std::vector<std::uint8_t> before = masked();
    const OtherContext other(true);
    ASSERT_TRUE(other.enter());
    const PackedMesh packed(shape, {.name = "loaded"});
    const GLsync fence = fenced();
    other.back();
    wait_for(fence);
    shadows->add_caster({.mesh = shadows->add_buffer_mesh(packed.desc).value()});
    EXPECT_GT(differing(masked(), before), 300u);
}

TEST_F(EmbedContexts, TheContextMayMoveToAnotherThread) {
    const std::vector<std::uint8_t> before = masked();
    const OtherContext other(false);
    other.leave();
    std::vector<std::uint8_t> on_thread;
    std::thread([&] {
        other.back();
        on_thread = masked();
        other.leave();
    }).join();
    other.back();
    EXPECT_EQ(on_thread, before);
    EXPECT_EQ(masked(), before);
}

}  // namespace
}  // namespace gnomon
