#include <gmock/gmock.h>

#include <algorithm>
#include <memory>

#include "engine/gl/device_recording.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/settings/presets.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/panel_hand.h"

/// The panel of lights (F1) under a mouse, in the built-in scene, on the recording device. What is clicked and dragged
/// reaches the lights, and the next frame's shadows.
namespace gnomon {
namespace {

class Panel : public ::testing::Test {
protected:
    void SetUp() override {
        auto scene = game::load_scene({});
        ASSERT_TRUE(scene) << to_line(scene.error());
        world.scene = game::spawn_scene(std::move(scene).value(), world.registry, world.library);
        auto made = FrameSystem::create(device, world.library);
        ASSERT_TRUE(made) << to_line(made.error());
        frame = std::move(made).value();
        gui = std::make_unique<game::Gui>();
        gui->panel.shown = true;
        settings.viewport_px = {2000, 1600};  // the panel fits in with all that is opened
        hand.emplace(world, *frame, *gui, settings.viewport_px);
        step();
    }
    void TearDown() override {
        hand.reset();
        gui.reset();
        frame.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    void step() {
        settings.shadows = gui->panel.shadows;
        settings.freeze_fits = gui->panel.freeze_fits;
        settings.shadow_budget = gui->panel.budget;
        frame->run(world.registry, settings);
    }
    void settle() {
        constexpr int kFrames = 70;  // a map that is larger than it need be is kept for a second
        for (int i = 0; i < kFrames; ++i) step();
    }
    const LightShadow& shadow(const std::string& light) const {
        for (const game::NamedEntity& named : world.scene.lights)
            if (named.name == light) return *world.registry.get<LightShadow>(named.entity);
        ADD_FAILURE() << "no light " << light;
        static const LightShadow kNone{};
        return kNone;
    }
    const game::Preset* preset_of(const std::string& light) const {
        for (const game::NamedEntity& named : world.scene.lights)
            if (named.name == light) return game::preset_of(*game::settings_of(world.registry, named.entity));
        return nullptr;
    }
    std::uint64_t texels() const {
        std::uint64_t sum = 0;
        for (const LightReport& light : frame->report().lights) sum += light.counts.texels;
        return sum;
    }
    const std::vector<std::string> shadowed{"sun", "lantern", "guard_lamp"};
    gl::RecordingDevice device;
    game::GameWorld world;
    FrameSettings settings;
    std::unique_ptr<FrameSystem> frame;
    std::unique_ptr<game::Gui> gui;
    std::optional<PanelHand> hand;
};

TEST_F(Panel, DragsTheErrorOfAllLightsFromEndToEndAndMapsFollow) {
    // A light with a set filter gets a finer map; with an automatic one it would get rays instead.
    for (const game::NamedEntity& light : world.scene.lights)
        if (world.registry.has<LightShadow>(light.entity))
            world.registry.patch<LightShadow>(light.entity, [](LightShadow& s) { s.filter = ShadowFilter::hard; });
    EXPECT_FALSE(hand->click({"max_error_px"})) << "its header is closed";
    ASSERT_TRUE(hand->click({"accuracy against time"}));
    ASSERT_TRUE(hand->drag({"max_error_px"}, 1.5));
    const float most_px = game::contract_px(game::kMostContractStep);
    for (const std::string& light : shadowed) EXPECT_EQ(shadow(light).max_error_px, most_px) << light;
    settle();
    const std::uint64_t coarse = texels();
    ASSERT_TRUE(hand->drag({"max_error_px"}, -0.5));
    const float least_px = game::contract_px(game::kLeastContractStep);
    for (const std::string& light : shadowed) EXPECT_EQ(shadow(light).max_error_px, least_px) << light;
    settle();
    EXPECT_GT(texels(), 16 * coarse);
    ASSERT_TRUE(hand->drag({"max_error_px"}, 0.5));
    EXPECT_GT(shadow("sun").max_error_px, least_px);
    EXPECT_LT(shadow("sun").max_error_px, most_px);
    step();
    ASSERT_TRUE(hand->click({"automatic"}));
    for (const std::string& light : shadowed) EXPECT_EQ(shadow(light).max_error_px, 0.0f) << light;
    // What each setting cost was noted beside it.
    const std::vector<game::ContractPoint> points = gui->panel.contract.curves[""].points();
    const auto texels_at = [&](float px) {
        for (const game::ContractPoint& point : points)
            if (!(point.max_error_px < px) && !(point.max_error_px > px)) return point.texels;
        return std::uint64_t{0};
    };
    EXPECT_EQ(texels_at(most_px), coarse);
    EXPECT_GT(texels_at(least_px), 16 * coarse);
    ASSERT_TRUE(hand->click({"forget what was measured"}));
    EXPECT_LE(gui->panel.contract.curves[""].points().size(), 1u) << "the frame after";
}

TEST_F(Panel, ChoosesOfWhichLightTheErrorIsMeant) {
    ASSERT_TRUE(hand->click({"accuracy against time"}));
    ASSERT_TRUE(hand->click({"light"}));
    ASSERT_TRUE(hand->choose("lantern"));
    EXPECT_EQ(gui->panel.contract.light, "lantern");
    ASSERT_TRUE(hand->drag({"max_error_px"}, 1.5));
    EXPECT_EQ(shadow("lantern").max_error_px, game::contract_px(game::kMostContractStep));
    EXPECT_EQ(shadow("sun").max_error_px, 0.0f);
    EXPECT_EQ(shadow("guard_lamp").max_error_px, 0.0f);
}

TEST_F(Panel, SetsPresetsByTheirNames) {
    ASSERT_TRUE(hand->click({"accuracy against time"}));
    for (const game::Preset& preset : game::presets()) {
        ASSERT_TRUE(hand->click({preset.name})) << preset.name;
        for (const std::string& light : shadowed) EXPECT_EQ(preset_of(light), &preset) << light;
    }
}

TEST_F(Panel, BoundsWhatShadowsTakeAndLetsGo) {
    const std::uint64_t all = texels();
    ASSERT_TRUE(hand->click({"budgets"}));
    ASSERT_TRUE(hand->drag({"maps, MiB"}, 0.4));
    const std::uint64_t bytes = gui->panel.budget.bytes;
    ASSERT_GT(bytes, 0u);
    step();
    EXPECT_LT(texels(), all);
    std::uint64_t taken = 0;
    for (const LightReport& light : frame->report().lights) taken += light.counts.bytes;
    EXPECT_LE(taken, bytes);
    ASSERT_TRUE(hand->drag({"GPU, ms per frame"}, 0.5));
    EXPECT_GT(gui->panel.budget.gpu_ms, 0.0f);
    ASSERT_TRUE(hand->click({"defaults"}));
    EXPECT_EQ(gui->panel.budget, shadow::ShadowBudget{});
}

TEST_F(Panel, ChangesOneLightsOwnSettings) {
    ASSERT_TRUE(hand->click({"lantern"}));
    ASSERT_TRUE(hand->click({"lantern", "quality"}));
    ASSERT_TRUE(hand->drag({"lantern", "quality", "resolution"}, 1.5));
    EXPECT_EQ(shadow("lantern").resolution_px, 4096u);
    EXPECT_EQ(shadow("sun").resolution_px, 0u);
    ASSERT_TRUE(hand->click({"lantern", "basic", "filter"}));
    ASSERT_TRUE(hand->choose("hard"));
    EXPECT_EQ(shadow("lantern").filter, ShadowFilter::hard);
    ASSERT_TRUE(hand->click({"lantern", "basic", "enabled"}));
    EXPECT_FALSE(shadow("lantern").enabled);
    step();
    for (const LightReport& light : frame->report().lights)
        if (light.name == "lantern") {
            EXPECT_EQ(light.reason, Reason::shadows_off);
        }
}

TEST_F(Panel, GreysWhatHasNoEffectAndResetsAGroup) {
    ASSERT_TRUE(hand->click({"lantern"}));
    ASSERT_TRUE(hand->click({"lantern", "cascades"}));
    (void)hand->drag({"lantern", "cascades", "cascades"}, 1.5);
    EXPECT_EQ(shadow("lantern").cascades, 0u) << "a lantern has none";
    ASSERT_TRUE(hand->click({"lantern", "quality"}));
    ASSERT_TRUE(hand->drag({"lantern", "quality", "resolution"}, 1.5));
    EXPECT_EQ(shadow("lantern").resolution_px, 4096u);
    ASSERT_TRUE(hand->click({"lantern", "quality", "reset"}));
    EXPECT_EQ(shadow("lantern").resolution_px, 0u);
    ASSERT_TRUE(hand->click({"sun"}));
    ASSERT_TRUE(hand->click({"sun", "cascades"}));
    EXPECT_TRUE(hand->drag({"sun", "cascades", "cascades"}, 1.5));
    EXPECT_EQ(shadow("sun").cascades, kMaxCascades);
}

TEST_F(Panel, ShowsTheSettingsInTheGroupsThatAreListedAndTheAuthorsOpen) {
    ASSERT_TRUE(hand->click({"lantern"}));
    EXPECT_FALSE(hand->click({"lantern", "cost", "economy"})) << "its group is closed";
    for (const game::NamedEntity& light : world.scene.lights)
        EXPECT_FALSE(world.registry.has<ShadowTuning>(light.entity)) << "nobody needs it";
    ASSERT_TRUE(hand->click({"lantern", "cost"}));
    ASSERT_TRUE(hand->click({"lantern", "cost", "economy"}));
    for (const game::NamedEntity& light : world.scene.lights) {
        const ShadowTuning* tuning = world.registry.get<ShadowTuning>(light.entity);
        EXPECT_EQ(tuning && !tuning->reuse.economy, light.name == "lantern") << light.name;
    }
}

TEST_F(Panel, SwitchesShadowsFitsMovementAndTheFrozenFrame) {
    ASSERT_TRUE(hand->click({"shadows"}));
    EXPECT_FALSE(gui->panel.shadows);
    step();
    EXPECT_EQ(texels(), 0u);
    ASSERT_TRUE(hand->click({"freeze fits (F4)"}));
    EXPECT_TRUE(gui->panel.freeze_fits);
    ASSERT_TRUE(hand->click({"movement (P)"}));
    EXPECT_TRUE(gui->panel.toggle_motion);
    ASSERT_TRUE(hand->click({"mark errors against ray-traced truth (F5)"}));
    EXPECT_TRUE(gui->panel.toggle_frozen);
}

TEST_F(Panel, MistComesAndGoes) {
    const auto fogs = [&] {
        std::size_t count = 0;
        world.registry.each<FogVolume>([&](ecs::Entity, const FogVolume&) { ++count; });
        return count;
    };
    ASSERT_TRUE(hand->drag({"mist"}, 0.5));
    ASSERT_EQ(fogs(), 1u);
    const float some = world.registry.get<FogVolume>(world.mist)->extinction_per_m;
    EXPECT_GT(some, 0.0f);
    ASSERT_TRUE(hand->drag({"mist"}, 1.5));
    ASSERT_EQ(fogs(), 1u);
    EXPECT_GT(world.registry.get<FogVolume>(world.mist)->extinction_per_m, some);
    step();
    ASSERT_TRUE(hand->drag({"mist"}, -0.5));
    EXPECT_EQ(fogs(), 0u);
    EXPECT_EQ(world.mist, ecs::kNull);
    step();
}

TEST_F(Panel, NothingChangesWhileNothingIsClicked) {
    const LightShadow before = shadow("sun");
    EXPECT_FALSE(hand->click({"no such thing"})) << "the mouse went all over the panel";
    EXPECT_EQ(shadow("sun"), before);
    EXPECT_TRUE(gui->panel.shadows);
    EXPECT_EQ(gui->panel.budget, shadow::ShadowBudget{});
}

}  // namespace
}  // namespace gnomon
