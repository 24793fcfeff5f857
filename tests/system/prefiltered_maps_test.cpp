#include "systems/shadow/passes/prefilter_pass.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"

/// What a light with a prefiltered map makes, records and keeps, and that no other light pays for it.
namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::uint32_t kSize_px = 256, kBlur_texel = 5;

class PrefilteredMaps : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    ecs::Entity add_light(LightKind kind, const std::string& name, ShadowFilter filter) {
        const ecs::Entity light = world.add_light(kind, kind == LightKind::point ? glm::dvec3(0, 4, 0) : kLightPlace_m, name);
        choose(light, [filter](LightShadow& s) {
            s.filter = filter;
            s.resolution_px = kSize_px;
        });
        choose(light, [](ShadowTuning& t) { t.kernel.size_texel = kBlur_texel; });
        return light;
    }
    template <class Change>
    void choose(ecs::Entity light, Change change) {
        edit_light(world.registry, light, change);
    }
    /// Returns the passes that convert depths to moments, by their groups.
    std::vector<Pass> conversions() const {
        std::vector<Pass> found = passes();
        std::erase_if(found, [](const Pass& pass) { return pass.group.rfind("moments ", 0) != 0; });
        return found;
    }
    std::size_t mip_generations() const {
        std::size_t count = 0;
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* mips = std::get_if<gl::GenerateMips>(&c))
                count += device.texture(mips->texture)->label.find("moments") != std::string::npos;
        return count;
    }
    TestWorld::Stage stage;
};

TEST_F(PrefilteredMaps, OfOneSpotAreExactlyTheseCommands) {
    add_light(LightKind::spot, "lamp", ShadowFilter::vsm);
    step();
    const auto& all = frame->commands().commands;
    const auto first = std::find(all.begin(), all.end(), gl::Command(gl::BeginGroup{"moments lamp 0"}));
    ASSERT_NE(first, all.end());
    const auto id = [&](const std::string& label, gl::ResourceCall::Kind kind) {
        for (const gl::ResourceCall& call : device.resource_calls())
            if (call.kind == kind && call.label == label) return call.id;
        ADD_FAILURE() << label;
        return 0u;
    };
    using Kind = gl::ResourceCall::Kind;
    const gl::BufferHandle records{id("shadow moment records", Kind::create_buffer)};
    const gl::TextureHandle depth{id("shadow map lamp", Kind::create_texture)}, scratch{id("shadow map lamp, scratch", Kind::create_texture)};
    const gl::TargetHandle half{id("shadow map lamp, scratch", Kind::create_target)}, whole{id("shadow map lamp, moments", Kind::create_target)};
    const gl::PipelineState converts{{id("moments shadow/filters/prefiltered/vsm.glsl PERSPECTIVE 1", Kind::create_program)}},
        blurs{{id("moments blur", Kind::create_program)}};
    const gl::Rect map{0, 0, kSize_px, kSize_px};
    const std::vector<gl::Command> wanted{
        gl::BeginGroup{"moments lamp 0"},
        gl::BeginTimer{0},
        gl::BindUniforms{0, records, 0, sizeof(shadow::MomentRecord)},
        gl::BeginPass{half, map, false, 0.0f, false, {}},
        gl::SetPipeline{converts},
        gl::BindTexture{0, depth, {}},
        gl::DrawTriangle{},
        gl::EndPass{},
        gl::BeginPass{whole, map, false, 0.0f, false, {}},
        gl::SetPipeline{blurs},
        gl::BindTexture{0, scratch, {}},
        gl::DrawTriangle{},
        gl::EndPass{},
        gl::EndTimer{0},
        gl::EndGroup{},
    };
    ASSERT_GE(static_cast<std::size_t>(all.end() - first), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ(first[static_cast<std::ptrdiff_t>(i)], wanted[i]) << i << ": " << gl::to_text(first[static_cast<std::ptrdiff_t>(i)]);
    EXPECT_TRUE(std::holds_alternative<gl::UpdateBuffer>(first[-1])) << "their records";
    // The lighting pass reads the moments, with their own sampler.
    const gl::TextureHandle moments{id("shadow map lamp, moments", Kind::create_texture)};
    EXPECT_NE(std::find(all.begin(), all.end(), gl::Command(gl::BindTexture{4, moments, {id("shadow moments", Kind::create_sampler)}})), all.end());
}

TEST_F(PrefilteredMaps, OfASoftFilterHaveMipmapsForAsLongAsTheSourceHasASize) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::pcss_moments);
    step();
    EXPECT_THAT(conversions(), SizeIs(2));
    EXPECT_EQ(mip_generations(), 0u);
    const std::uint64_t plain = light("lamp").counts.bytes;
    choose(lamp, [](Light& l) { l.source_radius_m = 0.05f; });
    step();
    EXPECT_EQ(mip_generations(), 1u);
    EXPECT_GT(light("lamp").counts.bytes, plain);
    choose(lamp, [](Light& l) {
        l.source_radius_m = 0.0f;
        l.sun_radius_rad = 0.1f;  // not a spot's business
    });
    step();
    EXPECT_EQ(mip_generations(), 0u);
    EXPECT_EQ(light("lamp").counts.bytes, plain);
}

TEST_F(PrefilteredMaps, AreMadeForNoLightOfAnotherRow) {
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (!row.moments) add_light(LightKind::spot, std::string(row.name), row.id);
    step();
    EXPECT_THAT(conversions(), IsEmpty());
    for (const std::string& label : device.live_labels()) EXPECT_THAT(label, ::testing::Not(HasSubstr("moment")));
}

TEST_F(PrefilteredMaps, OfAStillLightAreKeptAndNothingIsConverted) {
    add_light(LightKind::directional, "sun", ShadowFilter::evsm4);
    add_light(LightKind::point, "bulb", ShadowFilter::moments);
    step();
    EXPECT_THAT(conversions(), SizeIs(2 * (light("sun").counts.views + light("bulb").counts.views)));
    step();
    EXPECT_THAT(conversions(), IsEmpty());
    EXPECT_EQ(light("sun").state, LightState::reused);
}

TEST_F(PrefilteredMaps, AreMadeAnewWithoutTheirDepthsWhereOnlyTheyChange) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::evsm2);
    step();
    choose(lamp, [](ShadowTuning& t) { t.moments.exponent = 10.0f; });
    step();
    EXPECT_THAT(conversions(), SizeIs(2));
    EXPECT_THAT(depth_passes(), IsEmpty());
    choose(lamp, [](ShadowTuning& t) { t.moments.bleeding = 0.4f; });
    step();
    EXPECT_THAT(conversions(), IsEmpty()) << "only a lookup's";
    choose(lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    step();
    EXPECT_THAT(conversions(), SizeIs(2));
}

TEST_F(PrefilteredMaps, OfACubeAreMadeAnewWhereAFaceOrOneBesideItChanges) {
    const ecs::Entity bulb = add_light(LightKind::point, "bulb", ShadowFilter::vsm);
    step();
    const std::uint32_t views = light("bulb").counts.views;
    ASSERT_GE(views, 2u);
    world.move(stage.box, {0.3, 1.0, 0.0});
    step();
    const std::size_t drawn = depth_passes().size(), converted = conversions().size() / 2;
    EXPECT_GE(drawn, 1u);
    EXPECT_GE(converted, drawn);
    EXPECT_LE(converted, views);
    choose(bulb, [](ShadowTuning& t) { t.kernel.size_texel = 1; });
    step();
    EXPECT_THAT(conversions(), SizeIs(light("bulb").counts.views)) << "nothing to blur: one pass each";
}

TEST_F(PrefilteredMaps, CountMomentsScratchAndMipmapsAmongTheLightsBytes) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::vsm);
    constexpr std::uint64_t kTexels = std::uint64_t{kSize_px} * kSize_px, kDepth = 4, kTwoFloats = 8, kTwoShorts = 4;
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kTexels * (kDepth + 2 * kTwoFloats));
    choose(lamp, [](ShadowTuning& t) { t.moments.bits = 16; });
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kTexels * (kDepth + 2 * kTwoShorts));
    choose(lamp, [](ShadowTuning& t) { t.kernel.size_texel = 1; });
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kTexels * (kDepth + kTwoShorts));
    EXPECT_EQ(mip_generations(), 0u);
    choose(lamp, [](ShadowTuning& t) { t.moments.levels = 2; });
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kTexels * (kDepth + kTwoShorts) + kTexels / 4 * kTwoShorts);
    EXPECT_EQ(mip_generations(), 1u);
    step();
    EXPECT_EQ(mip_generations(), 0u);
    choose(lamp, [](LightShadow& s) { s.filter = ShadowFilter::hard; });
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kTexels * kDepth);
    EXPECT_THAT(map_labels(device), SizeIs(2)) << "depth and its target";
}

TEST_F(PrefilteredMaps, OfTheSunHaveMipmapsMadeOnceForAllCascades) {
    const ecs::Entity sun = add_light(LightKind::directional, "sun", ShadowFilter::vsm);
    choose(sun, [](ShadowTuning& t) { t.moments.levels = 3; });
    step();
    EXPECT_GT(light("sun").counts.views_drawn, 1u);
    EXPECT_EQ(mip_generations(), 1u);
}

TEST_F(PrefilteredMaps, ThatFindNoRoomAreTriedSmallerAndTheReportSaysSo) {
    device.fail_label("shadow map lamp, moments", gl::Failure::out_of_memory);
    add_light(LightKind::spot, "lamp", ShadowFilter::vsm);
    add_light(LightKind::spot, "other", ShadowFilter::hard);
    step();
    EXPECT_EQ(light("lamp").state, LightState::skipped);
    EXPECT_EQ(light("lamp").reason, Reason::map_allocation_failed);
    EXPECT_EQ(light("lamp").counts.bytes, 0u);
    EXPECT_EQ(light("other").state, LightState::rendered);
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

TEST_F(PrefilteredMaps, WithoutTheirProgramTheDepthsAreReadAndItIsTriedAgain) {
    device.fail_label("moments blur", gl::Failure::compile_failed);
    add_light(LightKind::spot, "lamp", ShadowFilter::vsm);
    step();
    EXPECT_EQ(light("lamp").state, LightState::degraded);
    EXPECT_EQ(light("lamp").reason, Reason::filter_program_failed);
    EXPECT_THAT(depth_passes(), SizeIs(1));
    EXPECT_THAT(conversions(), IsEmpty());
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_EQ(light("lamp").state, LightState::reused) << "its depths stood";
    EXPECT_THAT(conversions(), SizeIs(2));
}

TEST_F(PrefilteredMaps, AreBlendedBySamplersOfTheirOwnSettings) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::vsm);
    choose(lamp, [](ShadowTuning& t) { t.moments.anisotropy = 8; });
    add_light(LightKind::spot, "other", ShadowFilter::vsm);
    step();
    std::vector<gl::SamplerHandle> samplers;
    for (const gl::Command& c : frame->commands().commands)
        if (const auto* bind = std::get_if<gl::BindTexture>(&c); bind && bind->unit == 4 && bind->texture)
            samplers.push_back(bind->sampler);
    ASSERT_THAT(samplers, SizeIs(2));
    EXPECT_NE(samplers[0], samplers[1]);
}

}  // namespace
}  // namespace gnomon
