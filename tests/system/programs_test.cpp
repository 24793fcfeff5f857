#include <array>

#include "systems/retry.h"
#include "tests/system/frame_fixture.h"

/// Programs exist only for what the scene uses.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

class Programs : public FrameTest {
protected:
    /// Labels of the programs made so far, sorted.
    std::vector<std::string> made() const {
        std::vector<std::string> labels;
        for (const gl::ResourceCall& call : device.resource_calls())
            if (call.kind == gl::ResourceCall::Kind::create_program) labels.push_back(call.label);
        std::sort(labels.begin(), labels.end());
        return labels;
    }
};

constexpr const char* kSpot2x2 = "light LIGHT_SPOT shadow/filters/pcf/hardware_2x2.glsl";

TEST_F(Programs, ALightWithoutShadowNeedsNoShadowProgram) {
    world.add_stage();
    world.add_light(LightKind::spot, kLightPlace_m, "lamp", false);
    step();
    EXPECT_THAT(made(), ElementsAre("light LIGHT_SPOT ", "luminance", "surface", "tonemap"));
}

TEST_F(Programs, OneShadowedSpotNeedsOneDepthProgramAndOneRow) {
    world.add_stage();
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(made(), ElementsAre("depth opaque", kSpot2x2, "luminance", "surface", "tonemap"));
}

TEST_F(Programs, NothingIsMadeTwice) {
    world.add_stage();
    for (int i = 0; i < 3; ++i) world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    for (int i = 0; i < 10; ++i) step();
    EXPECT_THAT(made(), ElementsAre("depth opaque", "kept light LIGHT_SPOT ", kSpot2x2, "luminance", "surface",
                                    "tonemap", "visibility LIGHT_SPOT shadow/filters/pcf/hardware_2x2.glsl"));
}

TEST_F(Programs, EachFilterInUseIsARow) {
    world.add_stage();
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::pcf_grid; });
    step();
    EXPECT_THAT(made(), Contains("light LIGHT_SPOT shadow/filters/pcf/pcf_grid.glsl"));
    EXPECT_THAT(made(), Not(Contains("light LIGHT_SPOT shadow/filters/pcf/hard.glsl")));
}

TEST_F(Programs, TheMaskedOneIsMadeWhenAMaskedCasterComes) {
    world.add_stage();
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    const ecs::Entity fence = world.add_mesh(kMaskedBox, {1, 1, 0}, false);
    step();
    EXPECT_THAT(made(), Not(Contains("depth masked"))) << "it does not cast yet";
    world.registry.destroy(fence);
    const ecs::Entity caster = world.add_mesh(kMaskedBox, {1, 1, 0}, true);
    step();
    EXPECT_THAT(made(), Contains("depth masked"));

    const std::vector<Pass> depth = depth_passes();
    ASSERT_EQ(depth.size(), 1u);
    ASSERT_EQ(depth[0].draws.size(), 2u);
    std::vector<std::string> used;
    for (const gl::PipelineState& state : depth[0].pipelines) used.push_back(device.program(state.program)->label);
    EXPECT_THAT(used, ElementsAre("depth opaque", "depth masked"));
    EXPECT_EQ(drawn_slots(depth[0]).back(), slot_of(caster));
}

TEST_F(Programs, AMeshOfBothMaterialsIsDrawnByBothPrograms) {
    world.add_mesh(kPlane, {0, 0, 0}, false);
    world.add_mesh(kMixedBox, {0, 1, 0}, true);
    world.add_camera({0, 4, 8}, {0, 0, 0});
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ASSERT_EQ(depth_passes().size(), 1u);
    const Pass pass = depth_passes()[0];
    ASSERT_EQ(pass.draws.size(), 2u);
    EXPECT_EQ(pass.draws[0].index_count, 18u);
    EXPECT_EQ(pass.draws[1].index_count, 18u);
    EXPECT_EQ(pass.draws[1].first_index, pass.draws[0].first_index + 18);
    EXPECT_EQ(light("lamp").counts.triangles, 12u);
}

TEST_F(Programs, OnlyMaskedSubmeshesPayForDiscardingAndForTheirTexture) {
    world.add_stage();
    for (const std::uint32_t mesh : {kSolidBox, kMaskedBox, kMixedBox})
        world.add_mesh(mesh, {0.8 * mesh - 2.0, 1.0, 0.5}, true);
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    const gl::ProgramDesc* program = nullptr;
    bool in_depth = false;
    std::uint32_t opaque = 0, masked = 0;
    for (const gl::Command& command : frame->commands().commands) {
        if (const auto* b = std::get_if<gl::BeginPass>(&command)) in_depth = device.target(b->target)->colours.empty();
        if (const auto* p = std::get_if<gl::SetPipeline>(&command)) program = device.program(p->state.program);
        std::vector<gl::DrawMeshes> draws;
        gl::append_mesh_draws(frame->commands(), command, draws);
        if (draws.empty() || !in_depth) continue;
        ASSERT_NE(program, nullptr);
        // What discards and what it reads stands between #ifdef MASKED and #else.
        const std::string& source = program->fragment;
        const bool discards = source.find("#define MASKED") != std::string::npos;
        EXPECT_EQ(discards, program->label == "depth masked");
        ASSERT_LT(source.find("#ifdef MASKED"), source.find("discard"));
        for (const char* cost : {"discard", "sampler2D", "fragment_uv"})
            EXPECT_EQ(source.find(cost, source.rfind("#else")), std::string::npos) << cost;
        for (const gl::DrawMeshes& draw : draws) (discards ? masked : opaque) += draw.index_count * draw.item_count;
    }
    EXPECT_EQ(opaque, 36u + 36u + 18u) << "the stage's box, the solid one, half of the mixed one";
    EXPECT_EQ(masked, 36u + 18u);
}

TEST_F(Programs, BlendedRowsAreMadeOnlyWhereABlendedSurfaceIsSeen) {
    world.add_stage();
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(made(), Not(Contains("blended base")));
    world.add_mesh(kBlendedBox, {1, 1, 0}, false);
    step();
    EXPECT_THAT(made(), Contains("blended base"));
    EXPECT_THAT(made(), Contains("blended light LIGHT_SPOT shadow/filters/pcf/hardware_2x2.glsl"));
}

TEST_F(Programs, BeyondAFramesShareWaitAndTheirLightsAreLookedUpWithOneTap) {
    world.add_stage();
    constexpr std::array kFilters = {ShadowFilter::pcf_grid, ShadowFilter::poisson, ShadowFilter::pcss};
    for (std::size_t i = 0; i < kFilters.size(); ++i) {
        const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp" + std::to_string(i));
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = kFilters[i]; });
    }
    world.look_lights_up();
    settings.programs_per_frame = 1;
    const auto waiting = [&] {
        std::vector<std::string> names;
        for (const LightReport& l : frame->report().lights) {
            if (l.reason != Reason::filter_program_waits) continue;
            EXPECT_EQ(l.state, LightState::degraded);
            EXPECT_EQ(l.counts.views, 1u);
            names.push_back(l.name);
        }
        return names;
    };
    step();
    EXPECT_THAT(waiting(), ElementsAre("lamp1", "lamp2"));
    EXPECT_THAT(made(), Contains("light LIGHT_SPOT shadow/filters/pcf/hard.glsl")) << "what stands in never waits";
    const std::size_t first = made().size();
    step();
    EXPECT_THAT(waiting(), ElementsAre("lamp2"));
    step();
    EXPECT_THAT(waiting(), ElementsAre());
    EXPECT_EQ(made().size(), first + 2);
    step();
    EXPECT_EQ(made().size(), first + 2);
}

/// Adds a light with rays, which has three programs: each of them counts.
TEST_F(Programs, OfALightOfSeveralComeOneAfterTheOther) {
    world.add_stage();
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::exact; });
    settings.programs_per_frame = 1;
    const auto own = [&] {
        std::vector<std::string> labels = made();
        std::erase_if(labels, [](const std::string& label) {
            return label.find("LIGHT_SPOT") == std::string::npos || label.find("filters/pcf/hard") != std::string::npos;
        });
        return labels.size();
    };
    for (std::size_t frames = 1; frames <= 3; ++frames) {
        step();
        EXPECT_EQ(own(), frames);
        EXPECT_EQ(light("lamp").reason == Reason::filter_program_waits, frames < 3) << frames;
        EXPECT_EQ(light("lamp").filter.filter, frames < 3 ? ShadowFilter::hard : ShadowFilter::exact);
    }
}

TEST_F(Programs, ThatMakeMomentsAndDoNotCompileLeaveOneTapOfTheDepths) {
    world.add_stage();
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::vsm; });
    device.fail_label("moments ", gl::Failure::compile_failed);
    for (int i = 0; i < 3; ++i) {
        step();
        EXPECT_EQ(light("lamp").state, LightState::degraded);
        EXPECT_STREQ(reason_code(light("lamp").reason), "filter_program_failed");
        EXPECT_EQ(light("lamp").counts.views, 1u);
        EXPECT_THAT(made(), Contains("light LIGHT_SPOT shadow/filters/pcf/hard.glsl"));
        EXPECT_THAT(made(), Not(Contains("light LIGHT_SPOT shadow/filters/prefiltered/vsm.glsl")));
        const auto& all = frame->commands().commands;
        const auto bind = std::find_if(all.begin(), all.end(), [](const gl::Command& c) {
            const auto* texture = std::get_if<gl::BindTexture>(&c);
            return texture && texture->unit == 4;
        });
        ASSERT_NE(bind, all.end());
        EXPECT_EQ(device.texture(std::get<gl::BindTexture>(*bind).texture)->label, "shadow map lamp");
    }
    device.stop_failing();
    for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) step();
    EXPECT_THAT(made(), Contains("light LIGHT_SPOT shadow/filters/prefiltered/vsm.glsl"));
    EXPECT_TRUE(light("lamp").state != LightState::degraded) << reason_code(light("lamp").reason);
}

}  // namespace
}  // namespace gnomon
