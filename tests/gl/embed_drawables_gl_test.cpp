#include "tests/gl/embed_fixture.h"

// Casters that the engine draws with its own vertex stage.
namespace gnomon {
namespace {

/// Makes a fence of grass: cards with many rows, which bend.
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
            glEnable(GL_CULL_FACE);  // an engine's own habits
            glDepthFunc(GL_ALWAYS);
            glDepthMask(GL_FALSE);
        };
        drawable = shadows->add_drawable({.draw = draw, .bounds = kBounds});
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
    const std::vector<std::uint8_t> mask = masked();
    EXPECT_EQ(glIsEnabled(GL_CULL_FACE), GL_FALSE) << "what a depth pass needs is as it was before";
    GLint depth_test = 0;
    glGetIntegerv(GL_DEPTH_FUNC, &depth_test);
    EXPECT_EQ(depth_test, GL_LESS);
    const Difference d = compared(mask);
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
    add_shadowed(GetParam(), {1.5, 3.0, 1.0}, {.refresh_error_px = 1.0f});  // for casters of known movement alone
    const LightId elsewhere = shadows->add_light({.light = {.kind = LightKind::spot, .range_m = 6.0f, .outer_cone_rad = 0.4f},
                                                  .position_m = {4.5, 4.0, 0.0}});
    look_from({3.5, 4.5, 8.0});
    view.normal_texture = engine->normals;
    masked();
    ASSERT_EQ(shadows->status(elsewhere).state, LightState::rendered) << reason_code(shadows->status(elsewhere).reason);
    for (int frame = 0; frame < 6; ++frame) {
        shadows->redraw(drawable, kBounds);
        masked();
        EXPECT_GT(shadows->status().maps_drawn, 0u);
        EXPECT_EQ(shadows->status(elsewhere).maps_drawn, 0u);
    }
}

TEST_P(EmbedDrawable, IsKeptWithinTheErrorThatItsMovementAllows) {
    make_engine(Depths::usual_float);
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    add_grass(0.1f);
    // Clear of the planes through a lamp: there no movement is small.
    const LightId lamp = add_shadowed(GetParam(), {2.5, 3.5, 2.5}, {.refresh_error_px = 1.0f});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const auto maps_drawn = [&](double moves_at_most_m) {
        std::uint32_t drawn = 0;
        for (int frame = 0; frame < 5; ++frame) {
            shadows->redraw(drawable, kBounds, moves_at_most_m);
            masked();
            drawn += shadows->status().maps_drawn;
        }
        return drawn;
    };
    maps_drawn(0.5);  // it is known to move from then on
    EXPECT_EQ(maps_drawn(1.0e-5), 0u) << "far less than a pixel";
    EXPECT_EQ(shadows->status(lamp).reason, Reason::refresh_held);
    EXPECT_GE(maps_drawn(0.5), 5u) << "control: half a metre";
    EXPECT_GE(maps_drawn(std::numeric_limits<double>::infinity()), 5u) << "unknown";
}

INSTANTIATE_TEST_SUITE_P(All, EmbedDrawable, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(kind_name(row.param)); });

}  // namespace
}  // namespace gnomon
