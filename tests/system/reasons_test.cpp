#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>

#include "gnomon/components.h"
#include "systems/shadow/request/decide_requests.h"
#include "tests/oracle/fit_stages.h"
#include "tests/source_paths.h"
#include "tests/system/frame_fixture.h"

/// Every reason has a code of its own, a line in docs/reference/reasons.md, and a scene that gives it.
namespace gnomon {
namespace {

using Kind = gl::ResourceCall::Kind;

std::string text_of(const std::string& file) {
    std::ifstream in(test::source_folder() / file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<Reason> all_reasons() {
    std::vector<Reason> reasons;
    for (int i = 0; i < static_cast<int>(Reason::count); ++i) reasons.push_back(static_cast<Reason>(i));
    return reasons;
}

TEST(Reasons, AllHaveCodesOfTheirOwn) {
    std::vector<std::string> codes;
    for (const Reason reason : all_reasons()) {
        const std::string code = reason_code(reason);
        EXPECT_NE(code, "unknown") << static_cast<int>(reason);
        EXPECT_EQ(std::count(codes.begin(), codes.end(), code), 0) << code;
        codes.push_back(code);
    }
    EXPECT_STREQ(reason_code(Reason::count), "unknown");
}

TEST(Reasons, AllAreDocumented) {
    const std::string page = text_of("docs/reference/reasons.md");
    for (const Reason reason : all_reasons())
        EXPECT_NE(page.find("\n| `" + std::string(reason_code(reason)) + "` |"), std::string::npos)
            << reason_code(reason);
}

TEST(Reasons, OfLimitsNameThem) {
    using ::testing::HasSubstr;
    EXPECT_THAT(reason_text(Reason::cascades_clamped),
                HasSubstr("the light has " + std::to_string(kMaxCascades) + "."));
    EXPECT_THAT(reason_text(Reason::resolution_clamped), HasSubstr("below 16 texels or above the device's limit"));
    EXPECT_THAT(reason_text(Reason::filter_cut), HasSubstr("docs/reference/limits.md"));
}

/// The smallest scene with a shadow, and what is wrong with it.
class ReasonScenes : public FrameTest {
protected:
    struct Scene {
        LightKind kind = LightKind::spot;
        std::function<void(LightShadow&)> setting = {};
        std::function<void()> change = {};  // edits the world, or the device, before the first frame
        int frames = 1;
        std::function<void()> before_each = {};  // called before each of the frames
        ShadowTuning tuning = {};
    };
    static Scene of_spot(std::function<void(LightShadow&)> setting) { return {LightKind::spot, std::move(setting)}; }
    static Scene of_sun(std::function<void(LightShadow&)> setting) {
        return {LightKind::directional, std::move(setting)};
    }
    static Scene tuned(LightKind kind, const ShadowTuning& tuning) { return {.kind = kind, .tuning = tuning}; }
    Scene changed(std::function<void()> change) { return {LightKind::spot, {}, std::move(change)}; }
    /// Makes a scene with a call that fails: the first of that kind and label in a frame without a fault.
    Scene refused(Kind kind, const std::string& label, gl::Failure failure) {
        return changed([=, this] { device.fail_call(calls_before + first_call(kind, label), failure); });
    }
    std::uint64_t first_call(Kind kind, const std::string& label) const {
        gl::RecordingDevice other;
        auto made = FrameSystem::create(other, library);
        TestWorld same;
        same.add_stage();
        shadowed(same, LightKind::spot);
        made.value()->run(same.registry, settings);
        std::uint64_t number = 0;
        for (const gl::ResourceCall& call : other.resource_calls()) {
            if (call.kind == kind && call.label == label) return number;
            number += call.kind < Kind::destroy_texture || call.kind >= Kind::submit ? 1 : 0;
        }
        ADD_FAILURE() << "nothing is called " << label;
        return number;
    }
    static ecs::Entity shadowed(TestWorld& in, LightKind kind) {
        const ecs::Entity light = in.add_light(kind, kLightPlace_m, "lamp");
        in.registry.patch<LightShadow>(light, [](LightShadow& s) { s.resolution_px = 64; });
        return light;
    }
    std::map<Reason, Scene> scenes();
    Reason given(const Scene& scene) {
        stage = world.add_stage();
        lamp = shadowed(world, scene.kind);
        if (scene.setting) world.registry.patch<LightShadow>(lamp, scene.setting);
        world.registry.emplace<ShadowTuning>(lamp, scene.tuning);
        if (scene.change) scene.change();
        for (int i = 0; i < scene.frames; ++i) {
            if (scene.before_each) scene.before_each();
            step();
        }
        const LightReport& report = light("lamp");
        if (report.filter.reason != Reason::none) return report.filter.reason;
        return report.kept.reason == Reason::none ? report.reason : report.kept.reason;
    }
    void start_anew() {
        frame.reset();
        world = {};
        device.stop_failing();
        settings = kSettings;
        calls_before = device.calls();
        start();
    }
    TestWorld::Stage stage;
    ecs::Entity lamp;
    std::uint64_t calls_before = 0;  // the frame was made
};

std::map<Reason, ReasonScenes::Scene> ReasonScenes::scenes() {
    return {
        {Reason::none, {}},
        {Reason::no_light_shadow, changed([this] { world.registry.remove<LightShadow>(lamp); })},
        {Reason::shadows_off, of_spot([](LightShadow& s) { s.enabled = false; })},
        {Reason::light_off, changed([this] { world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 0; }); })},
        {Reason::no_visible_receiver, changed([this] {
             world.move(stage.camera, {0, -4, 8});
         })},
        {Reason::no_caster, changed([this] { world.registry.remove<ShadowCaster>(stage.box); })},
        {Reason::below_display_step, changed([this] {
             settings.exposure_ev = 15.0f;
             world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 1.0e-3f; });
         })},
        {Reason::content_unchanged, {.frames = 2}},
        {Reason::refresh_held,
         {LightKind::spot,
          [](LightShadow& s) { s.refresh_error_px = 100.0f; },
          {},
          3,
          [this] { world.registry.patch<Transform>(stage.box, [](Transform& t) { t.translation_m.x += 0.001; }); }}},
        {Reason::map_too_coarse, {LightKind::spot, [](LightShadow& s) { s = {.max_error_px = 0.1f}; }}},
        {Reason::visibility_kept, {.frames = 10}},
        {Reason::resolution_clamped, of_spot([](LightShadow& s) { s.resolution_px = 1u << 20; })},
        {Reason::over_budget, changed([this] { settings.shadow_budget.bytes = 1; })},
        {Reason::budget_shrunk,
         {LightKind::spot, [](LightShadow& s) { s.resolution_px = 128; },
          [this] { settings.shadow_budget.bytes = 4 * 64 * 64; }}},
        {Reason::ray_budget,
         {LightKind::spot, [](LightShadow& s) { s.filter = ShadowFilter::exact; },
          [this] { settings.shadow_budget.rays = 1; }}},
        {Reason::rays_off,
         {LightKind::spot, [](LightShadow& s) { s.filter = ShadowFilter::exact; }, [this] { settings.rays = false; }}},
        {Reason::rays_cheaper,
         {LightKind::spot,
          [](LightShadow& s) { s.filter = ShadowFilter::exact, s.resolution_px = 2048; },
          {},
          3,
          [this] { world.registry.patch<Transform>(stage.box, [](Transform& t) { t.translation_m.x += 0.001; }); }}},
        {Reason::map_shrunk, refused(Kind::create_texture, "shadow map lamp", gl::Failure::out_of_memory)},
        {Reason::map_allocation_failed,
         changed([this] { device.fail_label("shadow map", gl::Failure::out_of_memory); })},
        {Reason::target_incomplete, refused(Kind::create_target, "shadow map lamp", gl::Failure::incomplete_target)},
        {Reason::depth_program_failed, refused(Kind::create_program, "depth opaque", gl::Failure::compile_failed)},
        {Reason::lighting_program_failed,
         changed([this] { device.fail_label("filters", gl::Failure::compile_failed); })},
        {Reason::filter_program_failed,
         changed([this] { device.fail_label("filters/pcf/hardware_2x2", gl::Failure::compile_failed); })},
        {Reason::filter_program_waits, changed([this] { settings.programs_per_frame = 0; })},
        {Reason::buffer_failed, refused(Kind::create_buffer, "shadow draw items", gl::Failure::out_of_memory)},
        {Reason::sampler_failed, refused(Kind::create_sampler, "shadow compare linear", gl::Failure::out_of_memory)},
        {Reason::tint_failed, changed([this] {
             world.add_mesh(kBlendedBox, {1, 1, 0}, true);
             device.fail_label("translucent casters", gl::Failure::out_of_memory);
         })},
        {Reason::projection_unsupported,
         tuned(LightKind::spot, {.projection = {.kind = LightProjection::orthographic}})},
        {Reason::eye_invalid, tuned(LightKind::directional, {.projection = {.eye_angle_rad = -1.0f}})},
        {Reason::range_invalid, tuned(LightKind::spot, {.projection = {.near_m = 2.0f, .far_m = 1.0f}})},
        {Reason::cascades_clamped, of_sun([](LightShadow& s) { s.cascades = 9; })},
        {Reason::warp_unsupported, tuned(LightKind::directional, {.cascades = {.warp = 2.0f}})},
        {Reason::splits_invalid, tuned(LightKind::directional, {.cascades = {.blend = 2.0f}})},
        {Reason::depths_unread,
         {.kind = LightKind::directional,
          .change = [this] { device.fail_label("view distances", gl::Failure::compile_failed); },
          .frames = 2,
          .tuning = {.cascades = {.splits = CascadeSplits::sampled}}}},
        {Reason::filter_cut,
         {.setting = [](LightShadow& s) { s.filter = ShadowFilter::pcf_grid; },
          .tuning = {.kernel = {.size_texel = 0}}}},
        {Reason::depth_coarse,
         tuned(LightKind::spot, {.projection = {.near_m = 1e-4f}, .maps = {.depth_format = DepthFormat::d16}})},
    };
}

TEST_F(ReasonScenes, EveryReasonIsGiven) {
    const std::map<Reason, Scene> all = scenes();
    for (const Reason reason : all_reasons()) {
        if (reason == Reason::fit_degenerate) continue;  // no world is known that comes so far: see below
        const auto scene = all.find(reason);
        ASSERT_NE(scene, all.end()) << "no scene gives " << reason_code(reason);
        EXPECT_STREQ(reason_code(given(scene->second)), reason_code(reason));
        start_anew();
    }
}

TEST(Reasons, PointsInInfinityHaveNoFit) {
    SceneSnapshot scene;
    scene.consumers.emplace_back();
    scene.lights.emplace_back().kind = LightKind::directional;
    scene.lights[0].intensity = 1.0f;
    scene.lights[0].has_shadow = true;
    scene.lights[0].shadow.cascades = 1;
    shadow::FitStages stages;
    stages.decide(scene, gl::RecordingDevice::default_info());
    shadow::ShadowFrame& frame = stages.frame;
    frame.sets.receiver_points_ws = {glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
    frame.sets.hulls.emplace_back();
    frame.sets.lights.emplace_back();
    frame.sets.lights[0].receiver_points = {0, 2};
    frame.sets.lights[0].hulls = {0, 1};
    stages.fit(scene);
    EXPECT_EQ(frame.statuses[0].skipped(), Reason::fit_degenerate);
    EXPECT_TRUE(frame.fitted.views.empty());
}

}  // namespace
}  // namespace gnomon
