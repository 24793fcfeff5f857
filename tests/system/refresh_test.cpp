#include <algorithm>
#include <limits>

#include "gnomon/components.h"
#include "systems/shadow/culling/static_dynamic_casters.h"
#include "tests/system/frame_fixture.h"

/// LightShadow::refresh_error_px: maps that may show casters where they were, as far as that is too little to be seen.
namespace gnomon {
namespace {

constexpr int kRest = static_cast<int>(shadow::DynamicCasters::kStaticFrames);

class Refresh : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    ecs::Entity add_lamp(LightKind kind, const std::string& name, float refresh_error_px) {
        const ecs::Entity lamp = world.add_light(kind, kLightPlace_m, name);
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) {
            s.resolution_px = 256;
            s.refresh_error_px = refresh_error_px;
        });
        return lamp;
    }
    void move_box(const glm::dvec3& way_m) {
        world.registry.patch<Transform>(stage.box, [&](Transform& t) { t.translation_m += way_m; });
    }
    /// Runs `frames` frames and moves the box by `way_m` before each. Returns the frames in which the light draws
    /// anything.
    std::vector<int> draws(const std::string& name, int frames, const glm::dvec3& way_m) {
        std::vector<int> drawn;
        for (int i = 0; i < frames; ++i) {
            move_box(way_m);
            step();
            if (light(name).counts.views_drawn > 0) drawn.push_back(i);
        }
        return drawn;
    }
    const ViewReport& view(const std::string& name, std::size_t i = 0) const {
        return frame->report().views_of(light(name))[i];
    }
    TestWorld::Stage stage;
};

TEST_F(Refresh, IsDoneInTheFrameInWhichTheBoundWouldBeExceededAndInNoOther) {
    constexpr int kFrames = 30;
    constexpr float kAny_px = 1000.0f;
    const glm::dvec3 way_m(0.001, 0.0, 0.0005);
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        SCOPED_TRACE(static_cast<int>(kind));
        const std::string name = "light" + std::to_string(static_cast<int>(kind));
        const ecs::Entity lamp = add_lamp(kind, name, 1.0e-4f);
        const auto allow = [&](float px) {
            world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.refresh_error_px = px; });
        };
        step();
        EXPECT_EQ(draws(name, 4, way_m), (std::vector<int>{0, 1, 2, 3})) << "all are too far";
        allow(kAny_px);
        move_box(way_m);
        step();
        ASSERT_EQ(light(name).counts.views_drawn, 0u);
        std::vector<double> one_px;  // stale by one step, view by view
        for (const ViewReport& view : frame->report().views_of(light(name)))
            one_px.push_back(view.reason == Reason::refresh_held ? view.why.stale_px : 0.0);
        const double most_px = *std::max_element(one_px.begin(), one_px.end());
        ASSERT_GT(most_px, 0.0);
        EXPECT_EQ(light(name).why.stale_px, most_px);
        const double allowed_px = 3.5 * most_px;
        allow(static_cast<float>(allowed_px));
        std::vector<std::vector<int>> drawn(one_px.size()), wanted(one_px.size());
        for (std::size_t v = 0; v < one_px.size(); ++v) {
            if (one_px[v] == 0.0) continue;
            const int steps = static_cast<int>(allowed_px / one_px[v]);  // that may be kept; one was made
            for (int i = steps - 1; i < kFrames; i += steps + 1) wanted[v].push_back(i);
        }
        for (int i = 0; i < kFrames; ++i) {
            move_box(way_m);
            step();
            const auto views = frame->report().views_of(light(name));
            for (std::size_t v = 0; v < views.size(); ++v)
                if (views[v].state == LightState::rendered) drawn[v].push_back(i);
        }
        EXPECT_EQ(drawn, wanted);
        world.move(stage.box, {0.0, 1.0, 0.0});
        world.registry.remove<LightShadow>(lamp);
        for (int i = 0; i < kRest + 2; ++i) step();
    }
}

TEST_F(Refresh, IsRarerTheFartherAwayItIsSeen) {
    add_lamp(LightKind::spot, "lamp", 1.0f);
    std::vector<std::size_t> counts;
    for (const double away_m : {6.0, 12.0, 24.0, 48.0}) {
        world.move(stage.camera, {0.0, 0.3 * away_m, away_m});
        for (int i = 0; i < kRest + 2; ++i) step();
        counts.push_back(draws("lamp", 40, {0.001, 0.0, 0.0}).size());
    }
    for (std::size_t i = 1; i < counts.size(); ++i) EXPECT_LT(counts[i], counts[i - 1]) << i;
    EXPECT_LE(4 * counts.back(), counts.front());
}

TEST_F(Refresh, IsSaidWithWhatItCosts) {
    add_lamp(LightKind::spot, "lamp", 50.0f);
    step();
    move_box({0.001, 0.0, 0.0});
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered) << "of what stood still it is not known how far it moved";
    const double exact_px = light("lamp").predicted_error_px;
    double last_px = exact_px;
    for (int i = 0; i < 5; ++i) {
        move_box({0.001, 0.0, 0.0});
        step();
        EXPECT_EQ(light("lamp").state, LightState::reused);
        EXPECT_STREQ(reason_code(light("lamp").reason), "refresh_held");
        EXPECT_STREQ(reason_code(view("lamp").reason), "refresh_held");
        EXPECT_EQ(view("lamp").state, LightState::reused);
        EXPECT_GT(light("lamp").predicted_error_px, last_px);
        last_px = light("lamp").predicted_error_px;
        EXPECT_EQ(light("lamp").counts.draws + light("lamp").counts.clears, 0u);
    }
    EXPECT_LE(last_px, exact_px + 50.0);
    move_box({-0.005, 0.0, 0.0});
    step();
    EXPECT_NEAR(light("lamp").predicted_error_px, exact_px, 1e-6) << "it is back where it was";
}

TEST_F(Refresh, EndsOnceWhatMovedStandsStill) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        const std::string name = "light" + std::to_string(static_cast<int>(kind));
        const ecs::Entity lamp = add_lamp(kind, name, 100.0f);
        step();
        EXPECT_EQ(draws(name, 10, {0.001, 0.0, 0.0}).size(), 1u);
        int drawn = 0;
        for (int i = 0; i < kRest + 5; ++i) {
            step();
            drawn += static_cast<int>(light(name).counts.views_drawn > 0);
        }
        EXPECT_EQ(drawn, 1) << "it holds what is there now";
        EXPECT_STREQ(reason_code(light(name).reason), "content_unchanged");
        EXPECT_TRUE(frame->report().still);
        world.registry.remove<LightShadow>(lamp);
    }
}

TEST_F(Refresh, WaitsForNothingButMoves) {
    const ecs::Entity lamp = add_lamp(LightKind::spot, "lamp", 100.0f);
    const ecs::Entity other = world.add_mesh(kBox, {1.0, 1.0, 0.5}, true);
    step();
    const auto moves = [&](int frames) { return draws("lamp", frames, {0.001, 0.0, 0.0}).size(); };
    EXPECT_EQ(moves(5), 1u);
    const auto expect_drawn = [&](const char* what) {
        move_box({0.001, 0.0, 0.0});
        step();
        EXPECT_GT(light("lamp").counts.views_drawn, 0u) << what;
        EXPECT_EQ(moves(3), 0u) << "after " << what;
    };
    world.move(other, {1.0, 1.1, 0.5});
    expect_drawn("another starts to move");
    world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.mesh = kSolidBox; });
    expect_drawn("it becomes another mesh");
    world.registry.patch<Transform>(lamp, [](Transform& t) { t.translation_m.x += 0.5; });
    expect_drawn("the light moves");
    world.registry.destroy(other);
    expect_drawn("a caster vanishes");
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = 512; });
    expect_drawn("another map");
}

TEST_F(Refresh, IsNotPutOffByWhatIsOff) {
    const ecs::Entity lamp = add_lamp(LightKind::spot, "lamp", 0.0f);
    for (const float off : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.refresh_error_px = off; });
        step();
        EXPECT_EQ(draws("lamp", 6, {1.0e-6, 0.0, 0.0}).size(), 6u);
    }
    edit_light(world.registry, lamp, [](LightShadow& s) { s.refresh_error_px = 100.0f; });
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.bias.mode = BiasMode::constant; });
    step();
    EXPECT_EQ(draws("lamp", 6, {1.0e-6, 0.0, 0.0}).size(), 6u) << "a bias by hand promises nothing";
    edit_light(world.registry, lamp, [](ShadowTuning& t) {
        t.bias.mode = BiasMode::automatic;
        t.reuse.economy = false;
    });
    EXPECT_EQ(draws("lamp", 6, {1.0e-6, 0.0, 0.0}).size(), 6u);
}

TEST_F(Refresh, IsDoneAgainAfterASubmissionFailed) {
    const ecs::Entity lamp = add_lamp(LightKind::spot, "lamp", 0.0f);
    step();
    draws("lamp", 5, {0.001, 0.0, 0.0});
    const auto allow = [&](float px) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.refresh_error_px = px; });
    };
    allow(1.0e-6f);
    EXPECT_EQ(draws("lamp", 2, {0.001, 0.0, 0.0}).size(), 2u);
    move_box({0.001, 0.0, 0.0});
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    step();
    EXPECT_EQ(frame->report().failure, gl::Failure::out_of_memory);
    allow(100.0f);
    EXPECT_EQ(draws("lamp", 3, {0.001, 0.0, 0.0}), std::vector<int>{0}) << "what the map shows is not known";
}

}  // namespace
}  // namespace gnomon
