#include "systems/lighting/kept_visibility.h"

#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// What pixels saw of lights is kept while nothing changes that it follows from: what is made for it, when, and how long
/// it lives.
namespace gnomon {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kSettled = 70;  // frames after which everything is at rest

class KeptVisibility : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        spot = world.add_light(LightKind::spot, kLightPlace_m, "spot");
        point = world.add_light(LightKind::point, {0, 4, 0}, "point");
        for (const ecs::Entity light : {sun, spot, point})
            world.registry.patch<LightShadow>(light, [](LightShadow& s) { s.resolution_px = 64; });
    }
    void settle() {
        for (int i = 0; i < kSettled; ++i) step();
    }
    bool reads(const std::string& name) const { return light(name).kept.reason == Reason::visibility_kept; }
    std::vector<std::string> textures() const {
        std::vector<std::string> labels = map_labels(device, "kept visibility");
        // A label each of the texture and of its target.
        std::vector<std::string> half;
        for (std::size_t i = 0; i + 1 < labels.size(); i += 2) half.push_back(labels[i]);
        return half;
    }
    std::uint64_t texture_bytes() const {
        std::uint64_t sum = 0;
        for (const LightReport& l : frame->report().lights) sum += l.kept.bytes;
        return sum;
    }
    /// Returns the label of the last program that the light's pass over the picture sets.
    std::string program_of(const std::string& name) const {
        std::string label = "no pass";
        for (const Pass& pass : passes())
            if (pass.group == name && !pass.pipelines.empty())
                label = device.program(pass.pipelines.back().program)->label;
        return label;
    }
    TestWorld::Stage stage;
    ecs::Entity sun, spot, point;
};

TEST_F(KeptVisibility, NothingIsMadeWhileTheCameraMoves) {
    for (int i = 0; i < 100; ++i) {
        world.move(stage.camera, {0.01 * i, 4, 8});
        step();
        ASSERT_THAT(textures(), IsEmpty()) << i;
        ASSERT_EQ(texture_bytes(), 0u) << i;
    }
    for (const gl::ResourceCall& call : device.resource_calls())
        EXPECT_NE(call.label.rfind("kept", 0), 0u) << call.label << " was made";
}

TEST_F(KeptVisibility, LightsAreLookedUpOnceMoreInTheSecondStillFrameAndThenRead) {
    settle();
    world.move(stage.box, {0.1, 1, 0});
    step();
    EXPECT_FALSE(reads("sun"));
    step();
    EXPECT_FALSE(reads("sun")) << "the first still frame";
    EXPECT_EQ(program_of("sun").rfind("light ", 0), 0u) << program_of("sun");
    while (!reads("spot")) {
        ASSERT_LT(device.submissions().size(), 300u) << "it never comes to rest";
        step();
    }
    for (const char* name : {"sun", "spot", "point"}) {
        ASSERT_TRUE(reads(name)) << name;
        EXPECT_EQ(program_of(name).rfind("kept light", 0), 0u) << program_of(name);
        EXPECT_GT(light(name).counts.bytes, light(name).kept.bytes) << "and its map";
    }
    EXPECT_EQ(light("sun").kept.bytes, 4u * settings.viewport_px.x * settings.viewport_px.y);
    EXPECT_THAT(textures(), SizeIs(3)) << "what filled them is gone";
    // Maps are not bound.
    for (const gl::Command& command : frame->commands().commands) {
        const auto* bound = std::get_if<gl::BindTexture>(&command);
        if (!bound || !bound->texture) continue;
        EXPECT_NE(device.texture(bound->texture)->label.rfind("shadow map", 0), 0u);
    }
}

TEST_F(KeptVisibility, OnlyThePixelsThatALightReachesAreHeld) {
    world.registry.patch<Light>(point, [](Light& l) { l.range_m = 1.0f; });
    world.move(point, {0, 1.9, 0});
    settle();
    ASSERT_TRUE(reads("point"));
    EXPECT_LT(light("point").kept.bytes, light("sun").kept.bytes / 4);
    EXPECT_GT(light("point").kept.bytes, 0u);
}

/// Changes everything that visibility follows from, and checks that the other lights keep theirs.
TEST_F(KeptVisibility, EndsWithWhateverItFollowsFrom) {
    const std::vector<std::string> all{"sun", "spot", "point"};
    struct Change {
        const char* what;
        std::function<void()> make;
        std::vector<std::string> kept;  // lights that do not follow from it
    };
    const auto patched = [&](auto edit) { return [this, edit] { edit_light(world.registry, sun, edit); }; };
    const std::vector<Change> changes = {
        {"a caster", [&] { world.move(stage.box, {0.1, 1, 0}); }, {}},
        {"a receiver", [&] { world.move(stage.plane, {0, -0.1, 0}); }, {}},
        {"the layers that a receiver shows", [&] {
             world.registry.patch<MeshRef>(stage.plane, [](MeshRef& m) { m.shadow_layers = 1; });
         }, {}},
        {"the camera", [&] { world.move(stage.camera, {0, 4, 8.1}); }, {}},
        {"the picture's size", [&] { settings.viewport_px.x += 64; }, {}},
        {"a light's place", [&] { world.move(spot, {3, 6, 1.1}); }, {"sun", "point"}},
        {"a light's range", [&] { world.registry.patch<Light>(point, [](Light& l) { l.range_m = 20.0f; }); }, {"sun", "spot"}},
        {"a light's colour", [&] { world.registry.patch<Light>(sun, [](Light& l) { l.colour.r = 0.5f; }); }, all},
        {"a light's strength", [&] { world.registry.patch<Light>(spot, [](Light& l) { l.intensity *= 2.0f; }); }, all},
        {"a filter", patched([](LightShadow& s) { s.filter = ShadowFilter::hard; }), {"spot", "point"}},
        {"a map's size", patched([](LightShadow& s) { s.resolution_px = 128; }), {"spot", "point"}},
        {"a bias", patched([](ShadowTuning& t) { t.bias.mode = BiasMode::constant; }), {"spot", "point"}},
        {"a light's layers", patched([](LightShadow& s) { s.layers = 1; }), {"spot", "point"}},
    };
    for (const Change& change : changes) {
        settle();
        for (const std::string& name : all) ASSERT_TRUE(reads(name)) << name << ", before " << change.what;
        change.make();
        step();
        for (const std::string& name : all)
            EXPECT_EQ(reads(name), std::count(change.kept.begin(), change.kept.end(), name) == 1)
                << name << ", after " << change.what;
    }
}

TEST_F(KeptVisibility, IsFreedASecondAfterThingsMoved) {
    settle();
    ASSERT_THAT(textures(), SizeIs(3));
    for (int i = 0; i <= static_cast<int>(lighting::KeptVisibility::kHoldFrames) + 1; ++i) {
        world.move(stage.camera, {0.01 * (i + 1), 4, 8});
        step();
        EXPECT_EQ(texture_bytes(), 0u) << "what is not read is nobody's";
        const bool is_held = i + 2 < static_cast<int>(lighting::KeptVisibility::kHoldFrames);
        EXPECT_TRUE(!is_held || textures().size() == 3) << i;
    }
    EXPECT_THAT(textures(), IsEmpty());
}

TEST_F(KeptVisibility, IsFreedAtOnceWhereNobodyAsksForIt) {
    settle();
    edit_light(world.registry, sun, [](ShadowTuning& t) { t.reuse.keep_visibility = false; });
    step();
    EXPECT_THAT(textures(), SizeIs(2));
    edit_light(world.registry, spot, [](ShadowTuning& t) { t.reuse.economy = false; });
    step();
    EXPECT_THAT(textures(), SizeIs(1));
    world.registry.destroy(point);
    step();
    EXPECT_THAT(textures(), IsEmpty());
    settle();
    EXPECT_THAT(textures(), IsEmpty());
    EXPECT_EQ(light("sun").kept.bytes, 0u);
}

TEST_F(KeptVisibility, LightsWithoutShadowsHaveNone) {
    for (const ecs::Entity l : {sun, spot, point}) world.registry.remove<LightShadow>(l);
    settle();
    EXPECT_THAT(textures(), IsEmpty());
    for (const gl::ResourceCall& call : device.resource_calls()) EXPECT_NE(call.label.rfind("kept", 0), 0u) << call.label;
}

TEST_F(KeptVisibility, MapsOfCastersAsTheyWereAreLookedUp) {
    world.registry.patch<LightShadow>(spot, [](LightShadow& s) { s.refresh_error_px = 100.0f; });
    for (int i = 0; i < kSettled; ++i) {
        if (i < 10) world.move(stage.box, {0.001 * i, 1, 0});
        step();
        EXPECT_FALSE(light("spot").reason == Reason::refresh_held && reads("spot")) << i;
    }
}

TEST_F(KeptVisibility, AFailedSubmissionIsNotTrusted) {
    settle();
    ASSERT_TRUE(reads("sun"));
    device.fail_call(device.calls(), gl::Failure::out_of_memory);  // the next call is the submission: nothing is made
    EXPECT_NE(step().failure, gl::Failure::none);
    step();
    EXPECT_FALSE(reads("sun"));
    settle();
    EXPECT_TRUE(reads("sun"));
}

TEST_F(KeptVisibility, WhatCannotBeMadeIsLookedUpAndTriedAgain) {
    for (const char* label : {"kept visibility", "kept light"}) {
        device.fail_label(label, gl::Failure::out_of_memory);
        world.move(stage.box, {0.1, 1, 0});
        settle();
        for (const char* name : {"sun", "spot", "point"}) {
            EXPECT_FALSE(reads(name)) << name << " without " << label;
            EXPECT_EQ(light(name).state, LightState::reused) << "nothing is lost";
        }
        device.stop_failing();
        settle();
        EXPECT_TRUE(reads("sun")) << label;
        frame.reset();
        start();
    }
}

TEST_F(KeptVisibility, ItsProgramsWaitForThoseThatLightsNeed) {
    settings.programs_per_frame = 1;
    bool waited = false;
    for (int i = 0; i < kSettled; ++i) {
        const std::uint64_t compiled = step().programs_compiled;
        EXPECT_LE(i == 0 ? 0 : compiled, 1u) << i;
        bool waits = false;
        for (const LightReport& l : frame->report().lights) waits = waits || l.reason == Reason::filter_program_waits;
        EXPECT_FALSE(waits && texture_bytes() > 0) << i;
        waited = waited || waits;
    }
    EXPECT_TRUE(waited);
    for (const char* name : {"sun", "spot", "point"}) EXPECT_TRUE(reads(name)) << name;
}

TEST_F(KeptVisibility, TakesWhatABudgetLeavesAndIsGivenUpFirst) {
    settle();
    std::uint64_t maps = 0;
    for (const LightReport& l : frame->report().lights) maps += l.counts.bytes - l.kept.bytes;
    const std::uint64_t kept = texture_bytes();
    const auto held = [&] {
        std::uint64_t sum = 0;
        for (const LightReport& l : frame->report().lights) sum += l.counts.bytes;
        return sum;
    };
    settings.shadow_budget.bytes = maps + kept / 2;
    for (int i = 0; i < kSettled; ++i) {
        step();
        EXPECT_LE(held(), settings.shadow_budget.bytes) << i;
    }
    EXPECT_GT(texture_bytes(), 0u) << "there is room for some";
    EXPECT_LT(texture_bytes(), kept);
    for (const LightReport& l : frame->report().lights) EXPECT_NE(l.reason, Reason::budget_shrunk) << l.name;
    // A map that takes the room gets it. While a part of the picture is filled, a whole one is there beside it.
    settings.shadow_budget.bytes = maps + kept + 640u * 360u * sizeof(float);
    settle();
    ASSERT_EQ(texture_bytes(), kept);
    world.registry.patch<LightShadow>(spot, [](LightShadow& s) { s.resolution_px = 700; });
    for (int i = 0; i < kSettled; ++i) {
        step();
        EXPECT_LE(held(), settings.shadow_budget.bytes) << i;
    }
    EXPECT_NE(light("spot").reason, Reason::budget_shrunk);
    EXPECT_EQ(light("spot").counts.texels, 700u * 700u);
    EXPECT_LT(texture_bytes(), kept);
}

TEST_F(KeptVisibility, AMapThatTheDeviceHasNoRoomForGetsItsRoom) {
    settle();
    ASSERT_THAT(textures(), SizeIs(3));
    world.registry.patch<LightShadow>(spot, [](LightShadow& s) { s.resolution_px = 512; });
    device.fail_call(device.calls(), gl::Failure::out_of_memory);  // the first thing made is its new map
    step();
    EXPECT_EQ(light("spot").state, LightState::rendered);
    EXPECT_EQ(light("spot").counts.texels, 512u * 512u);
    EXPECT_THAT(textures(), SizeIs(2)) << "others found room again";
    EXPECT_FALSE(reads("sun")) << "what it had is gone";
}

TEST_F(KeptVisibility, SaysWhatItSaves) {
    device.set_timing(gl::TimingMode::finish);
    settle();
    ASSERT_TRUE(reads("sun"));
    EXPECT_TRUE(light("sun").kept.saved_us);
    EXPECT_GE(*light("sun").kept.saved_us, 0.0);
}

/// Uses two cameras in turn: each keeps its own.
TEST_F(KeptVisibility, EachCameraKeepsItsOwn) {
    const auto camera = [](std::uint32_t i) { return ecs::Entity{i, 1}; };
    const ecs::Entity lamp{9, 1};
    const gl::Rect whole{0, 0, 8, 8};
    lighting::KeptVisibility kept(device);
    using Use = lighting::KeptVisibility::Use;
    const auto use = [&](std::uint32_t c, std::uint64_t signature) {
        kept.begin(camera(c), ~std::uint64_t{0});
        const Use found = kept.plan(lamp, signature, whole, {8, 8}).use;
        kept.end();
        kept.submitted(true);
        return found;
    };
    kept.submitted(true);
    for (int i = 0; i < 2; ++i)
        for (std::uint32_t c : {0u, 1u}) EXPECT_EQ(use(c, 5 + c), Use::look_up) << i;
    for (std::uint32_t c : {0u, 1u}) EXPECT_EQ(use(c, 5 + c), Use::fill);
    EXPECT_EQ(kept.bytes(), 2u * 4 * 64);
    for (std::uint32_t c : {0u, 1u}) EXPECT_EQ(use(c, 5 + c), Use::read);
    EXPECT_EQ(use(0, 7), Use::look_up) << "one camera moves";
    EXPECT_EQ(use(1, 6), Use::read) << "the other does not";
    // A camera that is gone takes its own with it.
    for (std::uint64_t i = 0; i <= lighting::KeptVisibility::kHoldFrames; ++i) use(1, 6);
    EXPECT_EQ(kept.bytes(), 1u * 4 * 64);
}

TEST_F(KeptVisibility, NothingIsKeptByWhoeverNeverSaysThatItWasDrawn) {
    lighting::KeptVisibility kept(device);
    for (int i = 0; i < 10; ++i) {
        kept.begin({1, 1}, ~std::uint64_t{0});
        EXPECT_EQ(kept.plan({2, 1}, 3, {0, 0, 8, 8}, {8, 8}).use, lighting::KeptVisibility::Use::look_up);
        kept.end();
    }
    EXPECT_EQ(kept.bytes(), 0u);
}

}  // namespace
}  // namespace gnomon
