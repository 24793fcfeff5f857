#include "tests/install_consumer/own_frame.h"

#include "systems/extract/extract.h"
#include "systems/transform/transform_system.h"
#include "tests/system/frame_fixture.h"

/// The frame that the guide shows for one's own ECS (docs/embedding.md) does what Frame does: on the same world it
/// records the same commands and reports the same, frame by frame.
namespace gnomon {
namespace {

/// Two of the same world: one for Frame, one for the guide's frame.
class OwnFrameTest : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.exposure_ev = 14.0f;
        auto made = GpuScene::create(own_device, library);
        ASSERT_TRUE(made);
        own = std::make_unique<OwnFrame>(own_device, std::move(made).value());
        for (TestWorld* w : {&world, &own_world}) fill(*w);
    }
    void TearDown() override {
        own.reset();
        own_device.check_leaks();
        for (const gl::Finding& f : own_device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
        FrameTest::TearDown();
    }
    /// What a frame's parts may find out from one frame to the next is all in here: maps, moments, rays, splits by
    /// measured depths, a light that is too dim to be seen.
    void fill(TestWorld& w) {
        stage = w.add_stage();
        const auto add = [&](LightKind kind, const char* name, ShadowFilter filter, float intensity) {
            const ecs::Entity light = w.add_light(kind, kLightPlace_m, name);
            edit_light(w.registry, light, [&](LightShadow& s) { s.filter = filter; });
            edit_light(w.registry, light, [](ShadowTuning& t) { t.cascades.splits = CascadeSplits::sampled; });
            w.registry.patch<Light>(light, [&](Light& l) { l.intensity = intensity; });
        };
        add(LightKind::directional, "sun", ShadowFilter::automatic, 50000.0f);
        add(LightKind::spot, "lamp", ShadowFilter::vsm, 1.0e6f);
        add(LightKind::point, "bulb", ShadowFilter::exact, 1.0e6f);
        add(LightKind::spot, "faint", ShadowFilter::automatic, 1.0e-6f);
    }
    void step_both() {
        step();
        extractor.update(own_world.registry, library, transforms.update(own_world.registry), settings.viewport_px,
                         scene);
        own_world.registry.discard_changes();
        own->run(scene);
    }
    void expect_same() const {
        EXPECT_EQ(gl::to_text(own->commands()), gl::to_text(frame->commands()));
        EXPECT_TRUE(own->commands() == frame->commands());
        const FrameReport &mine = own->report, &theirs = frame->report();
        EXPECT_EQ(mine.failure, theirs.failure);
        EXPECT_EQ(mine.still, theirs.still);
        ASSERT_EQ(mine.lights.size(), theirs.lights.size());
        for (std::size_t i = 0; i < mine.lights.size(); ++i) {
            const LightReport &a = mine.lights[i], &b = theirs.lights[i];
            EXPECT_STREQ(reason_code(a.reason), reason_code(b.reason)) << b.name;
            EXPECT_STREQ(reason_code(a.kept.reason), reason_code(b.kept.reason)) << b.name;
            EXPECT_EQ(a.kept.bytes, b.kept.bytes) << b.name;
            EXPECT_EQ(a.counts.bytes, b.counts.bytes) << b.name;
            EXPECT_EQ(a.why.saved_us, b.why.saved_us) << b.name;
            EXPECT_EQ(a.kept.saved_us, b.kept.saved_us) << b.name;
        }
    }
    TestWorld own_world;
    TestWorld::Stage stage;  // entities of both worlds are alike
    gl::RecordingDevice own_device;
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot scene;
    std::unique_ptr<OwnFrame> own;
};

TEST_F(OwnFrameTest, OfTheGuideDoesWhatFrameDoes) {
    for (gl::RecordingDevice* d : {&device, &own_device}) d->set_timing(gl::TimingMode::finish);
    constexpr int kStill = 8, kMoving = 3;
    bool kept = false, learned = false, dim = false;
    for (int i = 0; i < kStill + kMoving + kStill; ++i) {
        if (i >= kStill && i < kStill + kMoving)
            for (TestWorld* w : {&world, &own_world}) w->move(stage.box, {0.1 * i, 1.0, 0.0});
        step_both();
        SCOPED_TRACE(i);
        expect_same();
        kept = kept || light("lamp").kept.reason == Reason::visibility_kept;
        learned = learned || light("sun").why.saved_us.has_value();
        dim = dim || light("faint").reason == Reason::below_display_step;
    }
    EXPECT_TRUE(kept && learned && dim) << "what is compared is there: " << kept << learned << dim;
}

TEST_F(OwnFrameTest, OfTheGuideDrawsAgainWhatFailed) {
    step_both();
    for (gl::RecordingDevice* d : {&device, &own_device}) d->fail_from(d->calls(), gl::Failure::out_of_memory, true);
    for (TestWorld* w : {&world, &own_world}) w->move(stage.box, {0.5, 1.0, 0.0});
    step_both();
    EXPECT_EQ(own->report.failure, gl::Failure::out_of_memory);
    expect_same();
    for (gl::RecordingDevice* d : {&device, &own_device}) d->stop_failing();
    for (int i = 0; i < 3; ++i) {
        step_both();
        expect_same();
    }
    EXPECT_EQ(own->report.failure, gl::Failure::none);
}

}  // namespace
}  // namespace gnomon
