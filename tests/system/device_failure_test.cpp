#include "engine/gl/device_recording.h"
#include "systems/retry.h"
#include "systems/shadow/maps/map_cache.h"
#include "tests/system/frame_fixture.h"

/// A device that refuses what is requested of it. The frame goes on, the light is lit, and the report gives the reason.
/// The shadow is back within a second after the fault has ended.
namespace gnomon {
namespace {

using ::testing::_;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::NiceMock;
using ::testing::Return;
using ::testing::SizeIs;

/// Passes every call on to a recording device unless a test sets something else.
class MockDevice : public gl::Device {
public:
    MockDevice() {
        ON_CALL(*this, create_texture).WillByDefault([this](const auto& d, auto b) { return recording.create_texture(d, b); });
        ON_CALL(*this, create_sampler).WillByDefault([this](const auto& d) { return recording.create_sampler(d); });
        ON_CALL(*this, create_buffer).WillByDefault([this](const auto& d, auto b) { return recording.create_buffer(d, b); });
        ON_CALL(*this, create_program).WillByDefault([this](const auto& d) { return recording.create_program(d); });
        ON_CALL(*this, create_target).WillByDefault([this](const auto& d) { return recording.create_target(d); });
        ON_CALL(*this, submit).WillByDefault([this](const auto& l) { return recording.submit(l); });
    }
    MOCK_METHOD(gl::Created<gl::TextureHandle>, create_texture, (const gl::TextureDesc&, std::span<const std::byte>), (override));
    MOCK_METHOD(gl::Created<gl::SamplerHandle>, create_sampler, (const gl::SamplerDesc&), (override));
    MOCK_METHOD(gl::Created<gl::BufferHandle>, create_buffer, (const gl::BufferDesc&, std::span<const std::byte>), (override));
    MOCK_METHOD(gl::Created<gl::ProgramHandle>, create_program, (const gl::ProgramDesc&), (override));
    MOCK_METHOD(gl::Created<gl::TargetHandle>, create_target, (const gl::TargetDesc&), (override));
    MOCK_METHOD(gl::SubmitResult, submit, (const gl::CommandList&), (override));

    const gl::DeviceInfo& info() const override { return recording.info(); }
    std::uint64_t compiled_programs() const override { return recording.compiled_programs(); }
    void destroy(gl::TextureHandle h) override { recording.destroy(h); }
    void destroy(gl::SamplerHandle h) override { recording.destroy(h); }
    void destroy(gl::BufferHandle h) override { recording.destroy(h); }
    void destroy(gl::ProgramHandle h) override { recording.destroy(h); }
    void destroy(gl::TargetHandle h) override { recording.destroy(h); }
    bool read_texture(gl::TextureHandle t, std::uint32_t l, std::span<std::byte> out) override { return recording.read_texture(t, l, out); }
    gl::Readback read_buffer(gl::BufferHandle b, std::span<std::byte> out) override { return recording.read_buffer(b, out); }
    void set_timing(gl::TimingMode mode) override { recording.set_timing(mode); }
    std::vector<gl::Timing> take_timings() override { return recording.take_timings(); }
    void finish() override { recording.finish(); }

    gl::RecordingDevice recording;
};

class DeviceFailure : public ::testing::TestWithParam<LightKind> {
protected:
    void SetUp() override {
        auto made = FrameSystem::create(device, library);
        ASSERT_TRUE(made);
        frame = std::move(made).value();
        stage = world.add_stage();
        lamp = world.add_light(GetParam(), kLightPlace_m, "lamp");
        world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = kSize_px; });
        world.look_lights_up();
    }
    void TearDown() override {
        frame.reset();
        device.recording.check_leaks();
        for (const gl::Finding& f : device.recording.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    void step() { frame->run(world.registry, settings); }
    const LightReport& report() const { return frame->report().lights.at(0); }
    std::vector<Pass> passes() const { return passes_of(frame->commands(), device.recording); }
    std::vector<Pass> depth_passes() const { return depth_passes_of(frame->commands(), device.recording); }
    /// Labels of the programs of the light's own passes.
    std::vector<std::string> light_programs() const {
        std::vector<std::string> labels;
        for (const Pass& p : passes())
            if (p.group == "lamp")
                for (const gl::PipelineState& s : p.pipelines) labels.push_back(device.recording.program(s.program)->label);
        return labels;
    }
    /// Expects that the picture is drawn whole: surfaces, one pass for the light without shadow, exposure.
    void expect_lit(Reason why) {
        std::vector<std::string> groups;
        for (const Pass& p : passes())
            if (!p.is_depth) groups.push_back(p.group);
        EXPECT_THAT(groups, ::testing::ElementsAre("surfaces", "lamp", "exposure", "exposure"));
        ASSERT_THAT(light_programs(), SizeIs(1));
        EXPECT_EQ(light_programs()[0].find("filters"), std::string::npos) << light_programs()[0] << " samples a map";
        EXPECT_EQ(report().state, LightState::skipped);
        EXPECT_STREQ(reason_code(report().reason), reason_code(why));
    }
    void expect_shadowed() {
        ASSERT_THAT(light_programs(), SizeIs(1));
        EXPECT_THAT(light_programs()[0], HasSubstr("filters"));
        EXPECT_TRUE(report().state == LightState::rendered || report().state == LightState::reused) << reason_code(report().reason);
    }
    void end_fault() {
        ::testing::Mock::VerifyAndClearExpectations(&device);
        for (int i = 0; i < 60; ++i) step();
        expect_shadowed();
    }

    static constexpr std::uint32_t kSize_px = 512;
    NiceMock<MockDevice> device;
    assets::MeshLibrary library = test_library();
    TestWorld world;
    TestWorld::Stage stage;
    ecs::Entity lamp;
    std::unique_ptr<FrameSystem> frame;
    FrameSettings settings{{640, 360}, {}, true, false};
};

const auto is_map = Field(&gl::TextureDesc::label, HasSubstr("shadow map"));
const auto is_map_target = Field(&gl::TargetDesc::label, HasSubstr("shadow map"));

template <class H>
auto refusal(gl::Failure failure) {
    return Return(gl::Created<H>{{}, failure, "refused by the test"});
}

TEST_P(DeviceFailure, WithoutOneTheLightIsShadowed) {
    step();
    expect_shadowed();
    EXPECT_EQ(report().state, LightState::rendered);
}

TEST_P(DeviceFailure, NoMapOfAnySizeLeavesTheLightLit) {
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(is_map, _))
        .Times(1 + static_cast<int>(shadow::MapCache::kHalvings))
        .WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) {
        step();
        expect_lit(Reason::map_allocation_failed);
        EXPECT_THAT(depth_passes(), IsEmpty());
        EXPECT_EQ(report().counts.bytes, 0u);
    }
    end_fault();
}

TEST_P(DeviceFailure, TheLargestMapAloneFailingGivesASmallerOne) {
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(Field(&gl::TextureDesc::width, kSize_px), _))
        .WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    step();
    EXPECT_EQ(report().state, LightState::degraded);
    EXPECT_STREQ(reason_code(report().reason), "map_shrunk");
    EXPECT_GT(report().counts.views_drawn, 0u);
    for (const Pass& p : depth_passes()) EXPECT_EQ(p.begin.viewport.width, static_cast<std::int32_t>(kSize_px / 2));
    EXPECT_THAT(light_programs(), Contains(HasSubstr("filters")));
    end_fault();
    EXPECT_EQ(report().counts.texels % (kSize_px * kSize_px), 0u) << "of the requested size again";
}

TEST_P(DeviceFailure, NoLayersOfTranslucentCastersLeaveTheShadowAsItIs) {
    world.add_mesh(kBlendedBox, {0.5, 2.0, 0.0}, true);
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(Field(&gl::TextureDesc::label, HasSubstr("translucent")), _))
        .WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    for (int i = 0; i < 3; ++i) {
        step();
        ASSERT_THAT(light_programs(), SizeIs(1));
        EXPECT_THAT(light_programs()[0], HasSubstr("filters"));
        EXPECT_THAT(light_programs()[0], ::testing::Not(HasSubstr("tinted")));
        EXPECT_STREQ(reason_code(report().reason), "tint_failed");
    }
    end_fault();
    EXPECT_THAT(light_programs()[0], HasSubstr("tinted"));
}

TEST_P(DeviceFailure, NoProgramForTranslucentCastersLeavesTheShadowAsItIs) {
    world.add_mesh(kBlendedBox, {0.5, 2.0, 0.0}, true);
    EXPECT_CALL(device, create_program).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_program(Field(&gl::ProgramDesc::label, HasSubstr("translucent"))))
        .WillRepeatedly(refusal<gl::ProgramHandle>(gl::Failure::compile_failed));
    step();
    ASSERT_THAT(light_programs(), SizeIs(1));
    EXPECT_THAT(light_programs()[0], ::testing::Not(HasSubstr("tinted")));
    EXPECT_STREQ(reason_code(report().reason), "tint_failed");
    end_fault();
    EXPECT_THAT(light_programs()[0], HasSubstr("tinted"));
}

TEST_P(DeviceFailure, AnIncompleteTargetLeavesTheLightLitAndNothingBehind) {
    EXPECT_CALL(device, create_target).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_target(is_map_target)).WillOnce(refusal<gl::TargetHandle>(gl::Failure::incomplete_target));
    step();
    expect_lit(Reason::target_incomplete);
    EXPECT_THAT(map_labels(device.recording), IsEmpty());
    end_fault();
}

TEST_P(DeviceFailure, TheLastOfSeveralTargetsFailingLeavesNothingBehind) {
    if (GetParam() == LightKind::spot) GTEST_SKIP() << "a spot has one target";
    EXPECT_CALL(device, create_target).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_target(is_map_target))
        .WillOnce([this](const auto& d) { return device.recording.create_target(d); })
        .WillOnce([this](const auto& d) { return device.recording.create_target(d); })
        .WillOnce(refusal<gl::TargetHandle>(gl::Failure::incomplete_target));
    step();
    expect_lit(Reason::target_incomplete);
    EXPECT_THAT(map_labels(device.recording), IsEmpty());
    end_fault();
}

TEST_P(DeviceFailure, ADepthShaderThatDoesNotCompileLeavesTheLightLit) {
    EXPECT_CALL(device, create_program).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_program(Field(&gl::ProgramDesc::label, "depth opaque")))
        .WillOnce(refusal<gl::ProgramHandle>(gl::Failure::compile_failed));
    for (int i = 0; i < 3; ++i) {  // requested once, not in every frame
        step();
        expect_lit(Reason::depth_program_failed);
        EXPECT_THAT(depth_passes(), IsEmpty());
    }
    end_fault();
}

TEST_P(DeviceFailure, AMaskedDepthShaderThatDoesNotCompileLeavesOnlyItsLightsLit) {
    EXPECT_CALL(device, create_program).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_program(Field(&gl::ProgramDesc::label, "depth masked")))
        .WillOnce(refusal<gl::ProgramHandle>(gl::Failure::link_failed));
    world.add_mesh(kMaskedBox, {1, 1, 0}, true);
    step();
    expect_lit(Reason::depth_program_failed);
    end_fault();
}

TEST_P(DeviceFailure, AFilterThatDoesNotCompileLeavesOneTapOfTheSameMap) {
    EXPECT_CALL(device, create_program).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_program(Field(&gl::ProgramDesc::label, HasSubstr("filters/pcf/hardware_2x2"))))
        .WillOnce(refusal<gl::ProgramHandle>(gl::Failure::compile_failed));
    for (int i = 0; i < 3; ++i) {  // requested once, not in every frame
        step();
        EXPECT_EQ(report().state, LightState::degraded);
        EXPECT_STREQ(reason_code(report().reason), "filter_program_failed");
        EXPECT_THAT(light_programs(), ::testing::ElementsAre(HasSubstr("filters/pcf/hard.glsl")));
        EXPECT_GT(report().counts.views, 0u);
    }
    end_fault();
    EXPECT_THAT(light_programs(), ::testing::ElementsAre(HasSubstr("filters/pcf/hardware_2x2.glsl")));
}

TEST_P(DeviceFailure, ALightingShaderThatDoesNotCompileInAnyFormLeavesTheLightLit) {
    EXPECT_CALL(device, create_program).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_program(Field(&gl::ProgramDesc::label, HasSubstr("filters"))))
        .WillOnce(refusal<gl::ProgramHandle>(gl::Failure::compile_failed))
        .WillOnce(refusal<gl::ProgramHandle>(gl::Failure::link_failed));
    for (int i = 0; i < 3; ++i) {
        step();
        expect_lit(Reason::lighting_program_failed);
    }
    end_fault();
}

TEST_P(DeviceFailure, ACompareSamplerThatFailsLeavesTheLightLit) {
    EXPECT_CALL(device, create_sampler).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_sampler(Field(&gl::SamplerDesc::compare, true)))
        .WillRepeatedly(refusal<gl::SamplerHandle>(gl::Failure::out_of_memory));
    step();
    expect_lit(Reason::sampler_failed);
    EXPECT_THAT(map_labels(device.recording), IsEmpty());
    end_fault();
}

TEST_P(DeviceFailure, BuffersOfTheDepthPassesThatFailLeaveTheLightLit) {
    for (const char* label : {"shadow draw items", "shadow views"}) {
        EXPECT_CALL(device, create_buffer).Times(::testing::AnyNumber());
        EXPECT_CALL(device, create_buffer(Field(&gl::BufferDesc::label, label), _))
            .WillRepeatedly(refusal<gl::BufferHandle>(gl::Failure::out_of_memory));
        frame.reset();
        frame = std::move(FrameSystem::create(device, library)).value();
        step();
        expect_lit(Reason::buffer_failed);
        EXPECT_THAT(depth_passes(), IsEmpty());
        end_fault();
        world.registry.emplace<Transform>(stage.box, *world.registry.get<Transform>(stage.box));
    }
}

TEST_P(DeviceFailure, AnInstanceBufferThatCannotGrowDropsTheNewInstancesOnly) {
    step();
    EXPECT_CALL(device, create_buffer).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_buffer(Field(&gl::BufferDesc::label, "instances"), _))
        .WillRepeatedly(refusal<gl::BufferHandle>(gl::Failure::out_of_memory));
    const ecs::Entity newcomer = world.add_mesh(kBox, {1.5, 1, 0}, false);
    for (int i = 0; i < 2; ++i) {
        step();
        expect_shadowed();
        std::uint32_t drawn = 0;
        for (const Pass& p : passes())
            if (p.group == "surfaces")
                for (const gl::DrawMeshes& d : p.draws) drawn += d.item_count;
        EXPECT_EQ(drawn, 2u);
        ASSERT_EQ(frame->report().dropped.size(), 1u);
        EXPECT_EQ(frame->report().dropped[0].entity, newcomer);
        EXPECT_EQ(frame->report().dropped[0].reason, DropReason::instances_full);
    }
    world.registry.destroy(newcomer);
    const ecs::Entity caster = world.add_mesh(kBox, {1.5, 1, 0}, true);
    world.add_mesh(kBox, {1.5, 1, 1}, true);
    step();
    expect_lit(Reason::buffer_failed);
    ASSERT_TRUE(world.registry.alive(caster));
    end_fault();
    std::uint32_t drawn = 0;
    for (const Pass& p : passes())
        if (p.group == "surfaces")
            for (const gl::DrawMeshes& d : p.draws) drawn += d.item_count;
    EXPECT_EQ(drawn, 4u);
    EXPECT_TRUE(frame->report().dropped.empty());
}

TEST_P(DeviceFailure, NoInstanceBufferAtAllIsStillAFrame) {
    EXPECT_CALL(device, create_buffer).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_buffer(Field(&gl::BufferDesc::label, "instances"), _))
        .WillRepeatedly(refusal<gl::BufferHandle>(gl::Failure::out_of_memory));
    step();
    expect_lit(Reason::buffer_failed);
    end_fault();
}

TEST_P(DeviceFailure, AFailedSubmissionIsDrawnAndUploadedAgain) {
    EXPECT_CALL(device, submit)
        .WillOnce(Return(gl::SubmitResult{gl::Failure::out_of_memory, 0}))
        .WillRepeatedly([this](const auto& l) { return device.recording.submit(l); });
    step();
    EXPECT_EQ(frame->report().failure, gl::Failure::out_of_memory);
    const auto instances_uploaded = [&] {
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* u = std::get_if<gl::UpdateBuffer>(&c); u && device.recording.buffer(u->buffer)->label == "instances") return true;
        return false;
    };
    const std::size_t views = depth_passes().size();
    EXPECT_TRUE(instances_uploaded());
    step();
    EXPECT_EQ(frame->report().failure, gl::Failure::none);
    EXPECT_THAT(depth_passes(), SizeIs(views)) << "what the failed one drew is not trusted";
    EXPECT_TRUE(instances_uploaded());
    step();
    EXPECT_EQ(report().state, LightState::reused);
    EXPECT_FALSE(instances_uploaded());
}

TEST_P(DeviceFailure, ALargerMapThatCannotBeHadKeepsTheOneThereIs) {
    step();
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(is_map, _)).WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = 2 * kSize_px; });
    step();
    EXPECT_EQ(report().state, LightState::degraded);
    EXPECT_STREQ(reason_code(report().reason), "map_shrunk");
    EXPECT_THAT(light_programs(), Contains(HasSubstr("filters")));
    end_fault();
    EXPECT_EQ(report().counts.texels % (4 * kSize_px * kSize_px), 0u);
}

TEST_P(DeviceFailure, WithoutRoomForSharesAllPixelsAreLookedUpByArea) {
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) {
        s.filter = ShadowFilter::triangles;
        s.antialias = true;
    });
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(Field(&gl::TextureDesc::label, HasSubstr("lit shares")), _))
        .WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    step();
    expect_shadowed();
    ::testing::Mock::VerifyAndClearExpectations(&device);
    step();
    EXPECT_GT(light_programs().size(), 1u) << "middles, marks and areas";
}

TEST_P(DeviceFailure, APictureThatCannotBeAllocatedIsNoPictureAndReturns) {
    EXPECT_CALL(device, create_texture).Times(::testing::AnyNumber());
    EXPECT_CALL(device, create_texture(Field(&gl::TextureDesc::label, "light sum"), _))
        .WillRepeatedly(refusal<gl::TextureHandle>(gl::Failure::out_of_memory));
    step();
    std::vector<std::uint8_t> pixels;
    EXPECT_FALSE(frame->read_picture(pixels));
    end_fault();
    EXPECT_TRUE(frame->read_picture(pixels));
}

std::string kind_name(const ::testing::TestParamInfo<LightKind>& param) {
    switch (param.param) {
        case LightKind::directional: return "Directional";
        case LightKind::spot: return "Spot";
        case LightKind::point: return "Point";
        case LightKind::rectangle: return "Rectangle";
        case LightKind::disc: return "Disc";
        case LightKind::sphere: return "Sphere";
        case LightKind::tube: return "Tube";
    }
    return "Unknown";
}
INSTANTIATE_TEST_SUITE_P(EachKind, DeviceFailure, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point, LightKind::rectangle),
                         kind_name);

}  // namespace
}  // namespace gnomon
