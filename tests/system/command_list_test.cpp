#include "shaders/bindings.h"
#include "systems/shadow/publish/publish_lights.h"
#include "tests/oracle/fit_stages.h"
#include "tests/system/frame_fixture.h"

/// The whole first frame of the smallest shadowed scene, command by command.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 256;
constexpr std::uint32_t kWidth = 64, kHeight = 32;
constexpr std::uint32_t kAlign = 256;  // the recording device's alignment of uniforms, bytes

class CommandListTest : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.viewport_px = {kWidth, kHeight};
        world.add_mesh(kPlane, {0, 0, 0}, false);
        world.add_mesh(kBox, {0, 1, 0}, true);
        world.add_camera({0, 4, 8}, {0, 0, 0});
        const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = kMap_px; });
    }
    /// Returns the id of the only object of that kind and label that the frame made.
    std::uint32_t id(gl::ResourceCall::Kind kind, const std::string& label) const {
        std::uint32_t found = 0;
        for (const gl::ResourceCall& call : device.resource_calls()) {
            if (call.kind != kind || call.label != label || call.failed) continue;
            EXPECT_EQ(found, 0u) << "two of " << label;
            found = call.id;
        }
        EXPECT_NE(found, 0u) << "no " << label;
        return found;
    }
    gl::TextureHandle texture(const std::string& label) const {
        return {id(gl::ResourceCall::Kind::create_texture, label)};
    }
    gl::TargetHandle target(const std::string& label) const {
        return {id(gl::ResourceCall::Kind::create_target, label)};
    }
    gl::SamplerHandle sampler(const std::string& label) const {
        return {id(gl::ResourceCall::Kind::create_sampler, label)};
    }
    gl::BufferHandle buffer(const std::string& label) const {
        return {id(gl::ResourceCall::Kind::create_buffer, label)};
    }
    gl::ProgramHandle program(const std::string& label) const {
        return {id(gl::ResourceCall::Kind::create_program, label)};
    }
    /// Returns the least depth of what the lamp lights.
    float lit_depth() const {
        shadow::FitStages stages;
        stages.decide(frame->snapshot(), device.info());
        stages.select(frame->snapshot());
        return stages.frame.sets.lit_areas.at(0).farthest_depth;
    }
    std::vector<gl::Command> expected() const;
};

std::vector<gl::Command> CommandListTest::expected() const {
    using namespace gl;
    const BufferHandle instances = buffer("instances"), depth_items = buffer("shadow draw items"),
                       views = buffer("shadow views");
    const BufferHandle items = buffer("surface draw items"), uniforms = buffer("lighting uniforms"),
                       materials = buffer("materials");
    const BufferHandle vertices = buffer("scene vertices"), indices = buffer("scene indices"),
                       normals = buffer("triangle normals");
    const SamplerHandle point = sampler("surface"), mips = sampler("luminance"),
                        linear = sampler("shadow compare linear");
    const TextureHandle depth = texture("surface depth"), sum = texture("light sum");
    const Rect picture{0, 0, kWidth, kHeight}, map{0, 0, kMap_px, kMap_px}, luminance{0, 0, 256, 256};

    // Sizes: two 64-byte instances; one 8-byte draw item, then two; a depth view padded to the alignment. Then camera,
    // ambient and exposure, each padded, and one light record.
    constexpr std::uint32_t kInstances = 2 * 64, kDepthItems = 8, kView = kAlign, kItems = 2 * 8;
    constexpr std::uint32_t kLight = 13 * 16 + 8 * 144, kUniforms = 3 * kAlign + kLight;
    constexpr std::uint32_t kBoxFirst = 6, kBoxCount = 36, kPlaneCount = 6;
    const PipelineState depth_state{
        program("depth opaque"), CullMode::none, false, DepthTest::greater, true, true, Blend::off};
    const PipelineState surface{program("surface"), CullMode::back, false, DepthTest::greater, true, false, Blend::off};
    const auto screen = [&](const char* label, Blend blend, DepthTest test = DepthTest::off) {
        return SetPipeline{{program(label), CullMode::none, false, test, false, false, blend}};
    };
    return {
        UpdateBuffer{instances, 0, 0, kInstances},
        // the map
        UpdateBuffer{depth_items, 0, kInstances, kDepthItems},
        UpdateBuffer{views, 0, kInstances + kDepthItems, kView},
        BeginGroup{"shadow lamp 0"},
        BeginTimer{0},
        BeginPass{target("shadow map lamp"), map, true, 0.0f, false, {}},
        BindUniforms{0, views, 0, 96},
        BindTexels{bindings::kInstanceUnit, instances},
        BindMeshes{vertices, indices, depth_items},
        SetPipeline{depth_state},
        DrawMeshes{kBoxFirst, kBoxCount, 4, 0, 1},
        EndPass{},
        EndTimer{0},
        EndGroup{},
        // the surfaces
        UpdateBuffer{items, 0, kInstances + kDepthItems + kView, kItems},
        UpdateBuffer{uniforms, 0, kInstances + kDepthItems + kView + kItems, kUniforms},
        BeginGroup{"surfaces"},
        BeginTimer{0xfffffff0u},
        BeginPass{target("surfaces"), picture, true, 0.0f, true, {}},
        SetPipeline{surface},
        BindUniforms{0, uniforms, 0, 176},
        BindUniforms{3, uniforms, kAlign, 32},
        BindTexels{bindings::kInstanceUnit, instances},
        BindTexels{bindings::kTriangleNormalUnit, normals},
        BindMeshes{vertices, indices, items},
        BindTexture{0, texture("white"), sampler("scene texture")},
        BindUniforms{2, materials, 0, 48},
        DrawMeshes{kBoxFirst, kBoxCount, 4, 1, 1},  // the plane reaches farther
        DrawMeshes{0, kPlaneCount, 0, 0, 1},
        EndPass{},
        EndTimer{0xfffffff0u},
        EndGroup{},
        // the light
        BeginGroup{"lights"},
        BeginGroup{"lamp"},
        BeginTimer{1},
        BeginPass{target("light sum"), picture, false, 0.0f, false, {}},
        SetScissor{{0, 0, 56, 32}},  // the cone leaves some columns out
        screen("light LIGHT_SPOT shadow/filters/pcf/hardware_2x2.glsl", Blend::add, DepthTest::less),
        BindUniforms{0, uniforms, 0, 176},
        BindTexture{0, depth, point},
        BindTexture{1, texture("surface colour"), point},
        BindTexture{2, texture("surface normals"), point},
        BindTexture{3, texture("surface material"), point},
        BindUniforms{1, uniforms, 3 * kAlign, kLight},
        BindTexture{4, texture("shadow map lamp"), linear},
        DrawTriangle{lit_depth()},
        EndPass{},
        EndTimer{1},
        EndGroup{},
        EndGroup{},
        // the exposure
        BeginGroup{"exposure"},
        BeginTimer{0xfffffff1u},
        BeginPass{target("luminance"), luminance, false, 0.0f, false, {}},
        screen("luminance", Blend::off),
        BindTexture{0, depth, point},
        BindTexture{1, sum, point},
        BindUniforms{4, uniforms, 2 * kAlign, 16},
        DrawTriangle{},
        EndPass{},
        GenerateMips{texture("luminance")},
        BeginPass{target("picture"), picture, false, 0.0f, false, {}},
        screen("tonemap", Blend::off),
        BindTexture{0, sum, point},
        BindTexture{1, texture("luminance"), mips},
        BindTexture{2, depth, point},
        BindUniforms{0, uniforms, 0, 176},
        BindUniforms{3, uniforms, kAlign, 32},
        DrawTriangle{},
        EndPass{},
        EndTimer{0xfffffff1u},
        EndGroup{},
    };
}

void expect_same(const std::vector<gl::Command>& actual, const std::vector<gl::Command>& wanted) {
    for (std::size_t i = 0; i < std::max(actual.size(), wanted.size()); ++i) {
        const std::string is = i < actual.size() ? gl::to_text(actual[i]) : "nothing";
        const std::string should_be = i < wanted.size() ? gl::to_text(wanted[i]) : "nothing";
        ASSERT_TRUE(i < actual.size() && i < wanted.size() && actual[i] == wanted[i])
            << "command " << i << "\n  is        " << is << "\n  should be " << should_be;
    }
}

TEST_F(CommandListTest, TheFirstFrameOfTwoEntitiesAndASpotIsExactlyThis) {
    step();
    expect_same(frame->commands().commands, expected());
    ASSERT_EQ(device.submissions().size(), 1u);
    EXPECT_EQ(device.submissions()[0], frame->commands());
}

TEST_F(CommandListTest, TheSecondFrameIsTheSameWithoutUploadOfInstancesAndWithoutTheMap) {
    step();
    std::vector<gl::Command> wanted = expected();
    constexpr std::ptrdiff_t kInstancesAndMap = 14;
    wanted.erase(wanted.begin(), wanted.begin() + kInstancesAndMap);
    for (gl::Command& c : wanted)  // payload offsets shift
        if (auto* update = std::get_if<gl::UpdateBuffer>(&c)) update->first -= 2 * 64 + 8 + kAlign;
    step();
    expect_same(frame->commands().commands, wanted);
}

TEST_F(CommandListTest, TheSameWorldGivesTheSameListOnAFreshDevice) {
    step();
    const gl::CommandList first = frame->commands();
    gl::RecordingDevice other;
    {
        TestWorld same;
        same.add_mesh(kPlane, {0, 0, 0}, false);
        same.add_mesh(kBox, {0, 1, 0}, true);
        same.add_camera({0, 4, 8}, {0, 0, 0});
        const ecs::Entity lamp = same.add_light(LightKind::spot, kLightPlace_m, "lamp");
        same.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = kMap_px; });
        auto again = FrameSystem::create(other, library);
        ASSERT_TRUE(again);
        again.value()->run(same.registry, settings);
        EXPECT_EQ(again.value()->commands(), first);
    }
    EXPECT_EQ(other.live_count(), 0u);
}

TEST_F(CommandListTest, AnotherLightChangesTheList) {
    world.add_light(LightKind::point, {0, 3, 0}, "second", false);
    step();
    EXPECT_NE(frame->commands().commands, expected());
}

TEST_F(CommandListTest, APresentedFrameEndsWithOneBlitToTheWindow) {
    settings.present = true;
    step();
    std::vector<gl::Command> wanted = expected();
    const gl::Rect all{0, 0, kWidth, kHeight};
    wanted.push_back(gl::Blit{target("picture"), {}, all, all});
    expect_same(frame->commands().commands, wanted);
}

}  // namespace
}  // namespace gnomon
