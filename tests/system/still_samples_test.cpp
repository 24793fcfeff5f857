#include <glm/geometric.hpp>

#include "systems/picture/sample_places.h"
#include "tests/system/frame_fixture.h"

/// FrameSettings::still_samples and smooth_edges: when samples are added up, what ends them, and what frames draw.
namespace gnomon {
namespace {

using ::testing::IsEmpty;

constexpr std::uint32_t kSamples = 8;

class StillSamples : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        fill();
        settings.still_samples = kSamples;
    }
    void fill() {
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        world.add_light(LightKind::spot, kLightPlace_m, "spot");
    }
    /// Draws until the picture has that number of samples. Returns the number of frames; 0: it never has.
    int frames_until(std::uint32_t samples) {
        for (int i = 1; i <= 200; ++i)
            if (step().samples == samples) return i;
        return 0;
    }
    std::vector<std::string> groups() const {
        std::vector<std::string> labels;
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* g = std::get_if<gl::BeginGroup>(&c)) labels.emplace_back(g->label.text());
        return labels;
    }
    bool has_group(const std::string& label) const {
        const std::vector<std::string> all = groups();
        return std::find(all.begin(), all.end(), label) != all.end();
    }
    bool is_live(const std::string& label) const {
        const std::vector<std::string> all = device.live_labels();
        return std::find(all.begin(), all.end(), label) != all.end();
    }
    TestWorld::Stage stage;
    ecs::Entity sun;
};

TEST_F(StillSamples, GrowByOnePerFrame) {
    EXPECT_EQ(step().samples, 1u);
    EXPECT_FALSE(is_live("sum of samples")) << "the first picture might be the only one";
    for (std::uint32_t n = 1; n <= kSamples; ++n) {
        EXPECT_EQ(step().samples, n);
        EXPECT_TRUE(has_group("surfaces")) << n;
    }
    for (int i = 0; i < 100; ++i) EXPECT_EQ(step().samples, kSamples) << "casters that become static change no picture";
}

/// Compares with frames without samples: the same maps are drawn in the same frames, in motion and at rest.
TEST_F(StillSamples, DrawNoMap) {
    std::vector<std::size_t> drawn[2];
    for (const std::uint32_t samples : {1u, 64u}) {
        frame.reset();
        world = TestWorld();
        fill();
        start();
        settings.still_samples = samples;
        std::uint32_t most = 0;
        for (int i = 0; i < 150; ++i) {
            if (i % 75 < 10) world.move(stage.box, {0.01 * i, 1, 0});
            most = std::max(most, step().samples);
            drawn[samples > 1].push_back(depth_passes().size());
        }
        EXPECT_EQ(most, samples);
    }
    EXPECT_EQ(drawn[0], drawn[1]);
    EXPECT_GT(*std::max_element(drawn[0].begin(), drawn[0].end()), 0u);
    EXPECT_EQ(drawn[1].back(), 0u);
}

TEST_F(StillSamples, OnceAllAreThereOnlyTheirMeanIsDrawn) {
    ASSERT_GT(frames_until(kSamples), 0);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(step().samples, kSamples);
        ASSERT_EQ(passes().size(), 1u);
        EXPECT_EQ(passes().front().group, "samples");
        EXPECT_TRUE(passes().front().draws.empty());
    }
    EXPECT_EQ(light("sun").state, LightState::reused);
    EXPECT_GT(light("sun").counts.views, 0u);
}

TEST_F(StillSamples, EndWithWhateverChanges) {
    const std::vector<std::pair<const char*, std::function<void()>>> changes = {
        {"a caster",
         [&] {
             world.move(stage.box, {0.1, 1, 0});
         }},
        {"the camera",
         [&] {
             world.move(stage.camera, {0, 4, 8.1});
         }},
        {"a light's strength", [&] { world.registry.patch<Light>(sun, [](Light& l) { l.intensity *= 2.0f; }); }},
        {"a setting", [&] { world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.cascades = 2; }); }},
        {"the exposure", [&] { settings.exposure_ev = 7.0f; }},
        {"the picture's size", [&] { settings.viewport_px.x += 64; }},
        {"shadows", [&] { settings.shadows = !settings.shadows; }},
        {"a debug view", [&] { settings.debug.view = debug::find_view("cascades"); }},
        {"no debug view", [&] { settings.debug.view = nullptr; }},
        {"fewer samples", [&] { settings.still_samples = 4; }},
        {"the world",
         [&] {
             world.add_mesh(kBox, {2, 1, 0}, true);
         }},
    };
    for (const auto& [what, change] : changes) {
        const std::uint32_t most = settings.debug.view ? 1 : settings.still_samples;
        ASSERT_GT(frames_until(most), 0) << "before " << what;
        change();
        EXPECT_EQ(step().samples, 1u) << what;
        EXPECT_TRUE(has_group("surfaces")) << what;
    }
    EXPECT_GT(frames_until(settings.still_samples), 0);
}

TEST_F(StillSamples, DebugViewsHaveOne) {
    settings.debug.view = debug::find_view("cascades");
    for (int i = 0; i < 200; ++i) EXPECT_EQ(step().samples, 1u);
}

TEST_F(StillSamples, CostNothingUnlessAskedFor) {
    settings.still_samples = 1;
    for (int i = 0; i < 200; ++i) EXPECT_EQ(step().samples, 1u);
    EXPECT_TRUE(has_group("surfaces"));
    EXPECT_FALSE(has_group("samples"));
    EXPECT_FALSE(has_group("smooth edges"));
    EXPECT_FALSE(is_live("sum of samples"));
    EXPECT_FALSE(is_live("picture to smooth"));
    settings.still_samples = kSamples;
    ASSERT_GT(frames_until(kSamples), 0);
    EXPECT_TRUE(is_live("sum of samples"));
    settings.still_samples = 1;
    step();
    EXPECT_FALSE(is_live("sum of samples")) << "its memory is free again";
}

TEST_F(StillSamples, AFailedFrameStartsAnew) {
    ASSERT_GT(frames_until(4), 0);
    device.fail_call(device.resource_calls().size(), gl::Failure::out_of_memory);  // the submission
    step();
    EXPECT_EQ(step().samples, 1u);
    EXPECT_GT(frames_until(kSamples), 0);
}

TEST_F(StillSamples, WithoutMemoryThePictureHasOne) {
    ASSERT_GT(step().samples, 0u);
    device.fail_label("sum of samples", gl::Failure::out_of_memory);
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(step().samples, 1u);
        EXPECT_TRUE(has_group("surfaces"));
    }
}

TEST_F(StillSamples, SmoothingComesWhileTheyAreFew) {
    settings.still_samples = 12;
    settings.smooth_edges = true;
    step();
    EXPECT_TRUE(has_group("smooth edges"));
    ASSERT_GT(frames_until(7), 0);
    EXPECT_TRUE(has_group("smooth edges"));
    EXPECT_EQ(step().samples, 8u);
    EXPECT_FALSE(has_group("smooth edges"));
    world.move(stage.camera, {0, 4, 8.2});
    step();
    EXPECT_TRUE(has_group("smooth edges"));
    settings.smooth_edges = false;
    step();
    EXPECT_FALSE(is_live("picture to smooth")) << "its memory is free again";
}

TEST_F(StillSamples, SmoothingBlursNoDebugView) {
    settings.smooth_edges = true;
    settings.debug.view = debug::find_view("depth");
    settings.debug.light = "sun";
    step();
    const std::vector<std::string> all = groups();
    const auto smooth = std::find(all.begin(), all.end(), "smooth edges");
    const auto debug = std::find_if(all.begin(), all.end(),
                                    [](const std::string& g) { return g.find("depth") == 0 || g.find("debug") == 0; });
    ASSERT_NE(smooth, all.end());
    ASSERT_NE(debug, all.end()) << ::testing::PrintToString(all);
    EXPECT_LT(smooth - all.begin(), debug - all.begin());
}

TEST(SamplePlaces, FillThePixelEvenlyFromItsMiddle) {
    EXPECT_EQ(picture::sample_place_px(0), glm::dvec2(0.0));
    std::vector<int> counts(16, 0);
    glm::dvec2 mean(0.0);
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::dvec2 at = picture::sample_place_px(i);
        mean += at / 64.0;
        ASSERT_LE(std::abs(at.x), 0.5);
        ASSERT_LE(std::abs(at.y), 0.5);
        ++counts[static_cast<std::size_t>((at.x + 0.5) * 4) + 4 * static_cast<std::size_t>((at.y + 0.5) * 4)];
    }
    EXPECT_LT(glm::length(mean), 0.03) << "the picture stays where it is";
    for (const int count : counts) {
        EXPECT_GE(count, 2);
        EXPECT_LE(count, 6);
    }
}

}  // namespace
}  // namespace gnomon
