#include <algorithm>
#include <array>

#include "tests/system/frame_fixture.h"

/// CascadeSplits::sampled: what it costs, when it comes, and what happens when it does not.
namespace gnomon {
namespace {

using ::testing::IsEmpty;

class SampledDepthsTest : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.repeatable = true;
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        use(CascadeSplits::sampled);
    }
    void use(CascadeSplits splits, ShadowFit fit = ShadowFit::tight) {
        edit_light(world.registry, sun, [](LightShadow& s) { s.cascades = 4; });
        edit_light(world.registry, sun, [&](ShadowTuning& t) { t.cascades.splits = splits, t.cascades.fit = fit; });
    }
    /// Lets the device answer that all pixels lie between these bins.
    void answer(std::uint32_t from_bin, std::uint32_t to_bin) {
        std::array<std::uint32_t, kDepthBins> pixels{};
        std::fill(pixels.begin() + from_bin, pixels.begin() + to_bin, 1000u);
        const auto bytes = std::as_bytes(std::span(pixels));
        device.script_readback("view distances to read", {bytes.begin(), bytes.end()});
    }
    template <class Command>
    std::vector<Command> recorded() const {
        std::vector<Command> found;
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* one = std::get_if<Command>(&c)) found.push_back(*one);
        return found;
    }
    bool knows() const { return frame->feedback().sampled_depths.camera == stage.camera; }

    static constexpr std::uint32_t k4m = 104, k16m = 112;  // bins that begin there
    TestWorld::Stage stage;
    ecs::Entity sun;
};

TEST_F(SampledDepthsTest, CostNothingWhereNobodyAsks) {
    for (const CascadeSplits splits : {CascadeSplits::practical, CascadeSplits::seen}) {
        use(splits);
        step();
        EXPECT_THAT(recorded<gl::Dispatch>(), IsEmpty());
        EXPECT_THAT(recorded<gl::CopyBuffer>(), IsEmpty());
    }
    for (const std::string& label : device.live_labels()) EXPECT_EQ(label.find("view distances"), std::string::npos);
    for (const gl::ResourceCall& call : device.resource_calls())
        EXPECT_NE(call.kind, gl::ResourceCall::Kind::read_buffer);
}

TEST_F(SampledDepthsTest, AddOneDispatchAndOneCopyBetweenSurfacesAndLights) {
    step();
    const auto dispatches = recorded<gl::Dispatch>();
    ASSERT_EQ(dispatches.size(), 1u);
    EXPECT_EQ(dispatches[0].groups_x, 10u) << "640 px in tiles of 64";
    EXPECT_EQ(dispatches[0].groups_y, 6u) << "360 px, the last tile in part";
    ASSERT_EQ(recorded<gl::CopyBuffer>().size(), 1u);
    const auto& commands = frame->commands().commands;
    const auto group = [&](const char* label) {
        return std::find(commands.begin(), commands.end(), gl::Command{gl::BeginGroup{label}}) - commands.begin();
    };
    EXPECT_LT(group("surfaces"), group("view distances"));
    EXPECT_LT(group("view distances"), group("lights"));
}

TEST_F(SampledDepthsTest, RedrawMapsOnceWhenTheyComeAndNeverAgainWhileNothingMoves) {
    answer(k4m, k16m);
    for (const ShadowFit fit : {ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised}) {
        frame.reset();
        start();
        use(CascadeSplits::sampled, fit);
        step();
        EXPECT_FALSE(knows());
        EXPECT_GT(light("sun").counts.views_drawn, 0u);
        step();
        EXPECT_TRUE(knows());
        EXPECT_GT(light("sun").counts.views_drawn, 0u) << "other splits than those by bounds";
        const gl::CommandList second = frame->commands();
        for (int i = 0; i < 4; ++i) {
            step();
            EXPECT_EQ(light("sun").counts.views_drawn, 0u) << "frame " << i << ", fit " << static_cast<int>(fit);
            EXPECT_THAT(depth_passes(), IsEmpty());
        }
    }
}

TEST_F(SampledDepthsTest, AreLateWithoutWaitingAndNoMoreThanThreeAreUnderWay) {
    settings.repeatable = false;
    answer(k4m, k16m);
    device.delay_readbacks(5);
    std::size_t dispatches = 0;
    for (int i = 0; i < 6; ++i) {
        step();
        EXPECT_FALSE(knows()) << i;
        EXPECT_EQ(light("sun").state == LightState::degraded, false) << "late is no failure";
        dispatches += recorded<gl::Dispatch>().size();
    }
    EXPECT_EQ(dispatches, 3u);
    step();
    EXPECT_TRUE(knows());
    EXPECT_EQ(recorded<gl::Dispatch>().size(), 1u) << "a slot has become free";
}

TEST_F(SampledDepthsTest, OfARepeatableRunAreThereInTheNextFrameHoweverLateTheDeviceIs) {
    answer(k4m, k16m);
    for (const std::uint64_t late : {0u, 5u}) {
        frame.reset();
        start();
        device.delay_readbacks(late);
        step();
        EXPECT_FALSE(knows()) << late;
        step();
        EXPECT_TRUE(knows()) << late;
    }
}

TEST_F(SampledDepthsTest, AreForgottenWhenNobodyAsksAnyMore) {
    answer(k4m, k16m);
    step();
    step();
    EXPECT_TRUE(knows());
    use(CascadeSplits::practical);
    step();
    EXPECT_FALSE(knows());
    step();
    EXPECT_FALSE(knows()) << "nor does one that was under way bring them back";
    use(CascadeSplits::sampled);
    step();
    EXPECT_FALSE(knows()) << "what is known now is of the past";
}

TEST_F(SampledDepthsTest, ThatCannotBeReadLeaveSplitsToBoundsForThatFrameAndSaySo) {
    answer(k4m, k16m);
    step();
    step();
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    step();
    EXPECT_FALSE(knows());
    EXPECT_EQ(light("sun").state, LightState::degraded);
    EXPECT_STREQ(reason_code(light("sun").reason), "depths_unread");
    EXPECT_GT(light("sun").counts.views, 0u);
    step();
    EXPECT_TRUE(knows());
    EXPECT_EQ(light("sun").reason, Reason::none);
}

TEST_F(SampledDepthsTest, WhoseProgramFailsAreTriedAgainAfterAWhile) {
    device.fail_label("view distances", gl::Failure::compile_failed);
    std::size_t tries = 0;
    const auto failed = [](const gl::ResourceCall& c) { return c.failed; };
    for (int i = 0; i < 40; ++i) {
        device.forget();
        step();
        tries += static_cast<std::size_t>(
            std::count_if(device.resource_calls().begin(), device.resource_calls().end(), failed));
        EXPECT_GT(light("sun").counts.views, 0u);
        if (i > 0) {
            EXPECT_STREQ(reason_code(light("sun").reason), "depths_unread");
        }
    }
    EXPECT_EQ(tries, 2u);
    device.stop_failing();
    for (int i = 0; i < 40 && light("sun").reason != Reason::none; ++i) step();
    step();
    EXPECT_TRUE(knows());
}

TEST_F(SampledDepthsTest, OfOneCameraPlaceNothingForAnother) {
    answer(k4m, k16m);
    step();
    step();
    world.registry.destroy(stage.camera);
    stage.camera = world.add_camera({0, 4, 8}, {0, 0, 0});
    step();
    EXPECT_FALSE(knows());
    step();
    EXPECT_TRUE(knows());
}

}  // namespace
}  // namespace gnomon
