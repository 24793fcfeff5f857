#include "tests/gl/embed_fixture.h"
#include "tests/gl/gl_state_record.h"
#include "tests/gl/unusual_gl_state.h"

// Every call of gnomon::Shadows leaves the context as it found it.
namespace gnomon {
namespace {

class EmbedState : public EmbedTest {
protected:
    /// Calls with the engine's state as unusual as it may be, and compares all of it.
    template <class Call>
    void expect_kept(const char* what, Call&& call) {
        const UnusualGlState unusual(EngineWork::feedback);
        const GlStateRecord before = record_gl_state();
        call();
        EXPECT_THAT(differences(before, record_gl_state()), ::testing::IsEmpty()) << what;
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << what;
    }
};

TEST_F(EmbedState, IsThatOfBeforeTheCall) {
    make_engine(Depths::usual_float, 4);
    others.push_back(std::make_unique<Engine>(Depths::reversed));
    add_room();
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    draw_depths(view, *engine);
    View second = view;
    second.normal_texture = 0;
    draw_depths(second, *others.front());
    const game::Shape shape = game::make_box({-0.2, 0.9, -0.2}, {0.2, 1.3, 0.2});
    int drawn = 0;
    const auto draw = [&](const DrawableView&) { ++drawn; };
    LightId lamp;
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferData(buffer, static_cast<GLsizeiptr>(12 * shape.positions.size()), shape.positions.data(), GL_STATIC_DRAW);
    const BufferMeshDesc in_buffers{.vertex_buffer = buffer, .index_buffer = buffer, .vertex_count = 8, .index_count = 3, .bounds = {{-1.0, 0.5, -1.0}, {1.0, 1.5, 1.0}}};
    MeshId engines;
    expect_kept("adding", [&] {
        engines = shadows->add_buffer_mesh(in_buffers).value();
        shadows->add_caster({.mesh = engines});
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
            lamp = shadows->add_light({.light = {.kind = kind}, .position_m = {1.5, 3.0, 1.0}, .direction = {-1.5, -3.0, -1.0}});
        const auto mesh = shadows->add_mesh({.positions_m = shape.positions, .indices = shape.indices});
        shadows->add_caster({.mesh = mesh.value()});
        shadows->add_drawable({.draw = draw, .bounds = {{-1.0, 0.5, -1.0}, {1.0, 1.5, 1.0}}});
    });
    const View both[] = {view, second};
    std::size_t layers = 0;
    for (int frame = 0; frame < 3; ++frame)
        expect_kept("render", [&] {
            for (const Mask& mask : shadows->render(both)) layers += mask.layers;
        });
    EXPECT_EQ(layers, 3u * (3u * 4u + 3u));
    EXPECT_GT(drawn, 0);
    expect_kept("a budget", [&] { shadows->set_budget({.gpu_ms = 2.0f}); });
    expect_kept("a timed render", [&] { shadows->render(both); });
    expect_kept("a view that cannot be read", [&] {
        View bad = view;
        bad.depth_texture = 4711;
        shadows->render(bad);
    });
    expect_kept("a change of a mesh in buffers", [&] {
        shadows->mesh_changed(engines, in_buffers.bounds);
        shadows->render(both);
    });
    EXPECT_GT(shadows->status().maps_drawn, 0u);
    expect_kept("a refused mesh", [&] { EXPECT_FALSE(shadows->add_buffer_mesh({})); });
    expect_kept("a buffer that the engine deletes", [&] {
        glDeleteBuffers(1, &buffer);
        shadows->render(both);
    });
    EXPECT_EQ(shadows->dropped().size(), 1u);
    expect_kept("removing the mesh", [&] { shadows->remove(engines); });
    expect_kept("a query", [&] { shadows->visibility(lamp, {0.0, 2.0, 0.0}); });
    expect_kept("making and removing", [&] {
        auto made = Shadows::create();
        ASSERT_TRUE(made);
        made.value()->render(both);
    });
}

TEST_F(EmbedState, WouldDifferForADeviceThatKeepsNone) {
    const UnusualGlState unusual(EngineWork::feedback);
    const GlStateRecord before = record_gl_state();
    const auto plain = gl::make_gl45_device({});
    ASSERT_TRUE(plain);
    plain.value()->submit({});
    EXPECT_THAT(differences(before, record_gl_state()), ::testing::Not(::testing::IsEmpty()));
}

TEST_F(EmbedState, AnErrorOfTheEngineStaysPending) {
    make_engine(Depths::usual_float);
    add_room();
    add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    draw_depths(view, *engine);
    glEnable(GL_TEXTURE_2D);  // no capability of a core context
    static_cast<void>(take_messages());
    shadows->render(view);
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

}  // namespace
}  // namespace gnomon
