#include <functional>
#include <set>

#include "engine/mesh/mesh_topology.h"
#include "gnomon/components.h"
#include "systems/shadow/passes/depth_draws.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/silent_device.h"
#include "tests/unit/allocation_counter.h"

/// One command draws all casters of a depth pass that need the same state, however many meshes they are.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kRecords = "shadow draw records";

/// Appends copies of a mesh of test_library(): each is a mesh of its own.
std::vector<std::uint32_t> copies(assets::MeshLibrary& library, std::uint32_t mesh, std::size_t count) {
    std::vector<std::uint32_t> made;
    for (std::size_t i = 0; i < count; ++i) {
        made.push_back(static_cast<std::uint32_t>(library.meshes.size()));
        library.meshes.push_back(assets::Mesh(library.meshes[mesh]));
    }
    return made;
}

class FewDraws : public FrameTest {
protected:
    void SetUp() override {
        open = copies(library, kBox, 3);
        solid = copies(library, kSolidBox, 4);
        masked = copies(library, kMaskedBox, 2);
        FrameTest::SetUp();
        world.add_mesh(kPlane, {0, 0, 0}, false);
        world.add_camera({0, 8, 14}, {0, 0, 0});
    }
    ecs::Entity add(std::uint32_t mesh, bool mirrored = false) {
        const double at = 0.7 * static_cast<double>(placed++);
        const ecs::Entity entity = world.add_mesh(mesh, {-4.5 + at, 1, 0.3 * at - 1.0}, true);
        if (mirrored) world.registry.patch<Transform>(entity, [](Transform& t) { t.scale.x = -1.0; });
        return entity;
    }
    void add_all() {
        for (const std::uint32_t mesh : open) add(mesh);
        for (const std::uint32_t mesh : masked) add(mesh);
        for (const std::uint32_t mesh : solid) add(mesh, mesh == solid[1]);
        add(solid[2], true);  // the same mesh, mirrored and not
    }
    ecs::Entity add_lamp(const std::function<void(ShadowTuning&)>& tune = {}, LightKind kind = LightKind::spot) {
        const ecs::Entity lamp = world.add_light(kind, kLightPlace_m, "lamp");
        edit_light(world.registry, lamp, [&](ShadowTuning& t) {
            t.reuse.economy = false;
            if (tune) tune(t);
        });
        return lamp;
    }
    std::vector<std::size_t> draws_by_command() const {
        const std::vector<Pass> passes = depth_passes();
        return passes.size() == 1 ? passes[0].draws_by_command : std::vector<std::size_t>{};
    }
    bool has_records() const {
        const auto labels = device.live_labels();
        return std::find(labels.begin(), labels.end(), kRecords) != labels.end();
    }
    std::vector<std::uint32_t> open, solid, masked;
    int placed = 0;
};

TEST_F(FewDraws, WithTheSameStateAreOneCommand) {
    std::vector<std::uint32_t> slots;
    add_lamp();
    std::vector<ecs::Entity> casters;
    for (const std::uint32_t mesh : solid) casters.push_back(add(mesh));
    step();
    EXPECT_THAT(draws_by_command(), ElementsAre(4u));
    for (const ecs::Entity caster : casters) slots.push_back(slot_of(caster));
    EXPECT_EQ(drawn_slots(depth_passes()[0]), slots);
    EXPECT_EQ(light("lamp").counts.draws, 4u);
    EXPECT_EQ(light("lamp").counts.draw_commands, 1u);
    EXPECT_EQ(light("lamp").counts.triangles, 4u * 12u);
}

TEST_F(FewDraws, AreTheseCommands) {
    add_all();
    add_lamp();
    step();
    ASSERT_THAT(depth_passes(), SizeIs(1));
    const Pass pass = depth_passes()[0];
    EXPECT_THAT(pass.draws_by_command, ElementsAre(3u, 3u, 2u, 2u)) << "open, solid, solid and mirrored, masked";
    std::vector<std::pair<gl::CullMode, bool>> modes;
    std::vector<std::string> programs;
    for (const gl::PipelineState& state : pass.pipelines) {
        modes.emplace_back(state.cull, state.front_is_clockwise);
        programs.push_back(device.program(state.program)->label);
    }
    using enum gl::CullMode;
    EXPECT_THAT(modes, ElementsAre(std::pair{none, false}, std::pair{back, false}, std::pair{back, true},
                                   std::pair{none, false}));
    EXPECT_THAT(programs, ElementsAre("depth opaque", "depth opaque", "depth opaque", "depth masked"));
    std::vector<gl::DrawMeshesIndirect> commands;
    for (const gl::Command& command : frame->commands().commands)
        if (const auto* draw = std::get_if<gl::DrawMeshesIndirect>(&command)) commands.push_back(*draw);
    ASSERT_THAT(commands, SizeIs(4));
    EXPECT_EQ(commands[0].first_record, 0u);
    EXPECT_EQ(commands[1].first_record, 3u);
    EXPECT_EQ(commands[2].first_record, 6u);
    EXPECT_EQ(commands[3].first_record, 8u);
    EXPECT_EQ(device.buffer(commands[0].records)->label, kRecords);
    EXPECT_EQ(commands[0].end_index, pass.draws[2].first_index + pass.draws[2].index_count);
    EXPECT_EQ(commands[0].end_item, 3u);
}

TEST_F(FewDraws, AreOffOneCommandEachInTheSameOrder) {
    add_all();
    const ecs::Entity lamp = add_lamp([](ShadowTuning& t) { t.maps.multi_draw = false; });
    step();
    ASSERT_THAT(depth_passes(), SizeIs(1));
    const Pass off = depth_passes()[0];
    EXPECT_THAT(off.draws_by_command, Each(1u));
    EXPECT_FALSE(has_records()) << "nothing is made for what is off";
    const LightCounts counts = light("lamp").counts;
    EXPECT_EQ(counts.draw_commands, counts.draws);
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.maps.multi_draw = true; });
    step();
    const Pass on = depth_passes().at(0);
    EXPECT_LT(on.draws_by_command.size(), off.draws_by_command.size());
    EXPECT_EQ(on.draws, off.draws);
    EXPECT_EQ(on.pipelines, off.pipelines);
    EXPECT_EQ(light("lamp").counts.draws, counts.draws);
    EXPECT_EQ(light("lamp").counts.triangles, counts.triangles);
}

TEST_F(FewDraws, OfOneMeshNeedNoRecords) {
    add(solid[0]);
    add(solid[0]);
    add(masked[0]);
    add_lamp();
    step();
    EXPECT_THAT(draws_by_command(), ElementsAre(1u, 1u)) << "instances are one draw";
    EXPECT_FALSE(has_records());
}

TEST_F(FewDraws, AreSingleOnesWithoutRoomForRecords) {
    add_all();
    add_lamp([](ShadowTuning& t) { t.reuse.economy = false; });
    device.fail_label(kRecords, gl::Failure::out_of_memory);
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_THAT(depth_passes().at(0).draws_by_command, Each(1u));
    const std::vector<gl::DrawMeshes> single = depth_passes()[0].draws;
    const std::uint64_t calls = device.calls();
    step();
    EXPECT_EQ(device.calls(), calls + 1) << "only the submission: the buffer is not asked for in every frame";
    device.stop_failing();
    for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) step();
    EXPECT_THAT(depth_passes().at(0).draws_by_command, Contains(3u));
    EXPECT_EQ(depth_passes()[0].draws, single);
}

TEST_F(FewDraws, ServeEveryFaceOfALayeredCube) {
    add_all();
    const ecs::Entity lamp = add_lamp({}, LightKind::point);
    step();
    std::uint32_t drawn = 0;
    for (const Pass& pass : depth_passes()) {
        EXPECT_LE(pass.draws_by_command.size(), 4u);
        for (const gl::DrawMeshes& draw : pass.draws) drawn += draw.item_count;
    }
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.maps.cube_route = CubeRoute::layered_geometry; });
    step();
    const std::vector<Pass> passes = depth_passes();
    const Pass& whole = passes.back();
    EXPECT_THAT(whole.draws_by_command, ElementsAre(3u, 3u, 2u, 2u));
    std::uint32_t layered = 0;
    for (const gl::DrawMeshes& draw : whole.draws) layered += draw.item_count;
    EXPECT_EQ(layered, drawn) << "an item per caster and face that shows it";
    EXPECT_EQ(light("lamp").counts.draw_commands, 4u);
}

TEST_F(FewDraws, KeepMovingCastersApartWhereACopyHasTheOthers) {
    for (const std::uint32_t mesh : solid) add(mesh);
    std::vector<ecs::Entity> movers;
    for (const std::uint32_t mesh : open) movers.push_back(add(mesh));
    const ecs::Entity lamp = add_lamp([](ShadowTuning& t) { t.reuse.economy = true; });
    // Copies of larger maps cost more than so few triangles.
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px = 32; });
    bool filled = false, copied = false;
    for (int i = 0; i < 8; ++i) {
        for (const ecs::Entity mover : movers)
            world.registry.patch<Transform>(mover, [&](Transform& t) { t.translation_m.y = 1.0 + 0.01 * i; });
        step();
        std::size_t copies_made = 0;
        for (const gl::Command& command : frame->commands().commands)
            copies_made += std::holds_alternative<gl::CopyTexture>(command) ? 1 : 0;
        const std::vector<Pass> passes = depth_passes();
        if (copies_made == 0) continue;
        if (passes.size() == 2) {
            filled = true;
            EXPECT_THAT(passes[0].draws_by_command, ElementsAre(4u));
        } else {
            copied = true;
        }
        EXPECT_THAT(passes.back().draws_by_command, ElementsAre(3u));
    }
    EXPECT_TRUE(filled);
    EXPECT_TRUE(copied);
}

TEST_F(FewDraws, OfMapsWithTrianglesKeepStaticCastersFirst) {
    for (const std::uint32_t mesh : open) add(mesh);
    std::vector<ecs::Entity> movers;
    for (const std::uint32_t mesh : solid) movers.push_back(add(mesh));
    const ecs::Entity lamp = add_lamp();
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::triangles; });
    for (int i = 0; i < 3; ++i) {
        for (const ecs::Entity mover : movers)
            world.registry.patch<Transform>(mover, [&](Transform& t) { t.translation_m.y = 1.0 + 0.01 * i; });
        step();
    }
    EXPECT_THAT(draws_by_command(), ElementsAre(3u, 4u));
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::hardware_2x2; });
    movers.push_back(add(open[0]));
    for (int i = 0; i < 3; ++i) {
        world.registry.patch<Transform>(movers.back(), [&](Transform& t) { t.translation_m.y = 1.0 + 0.01 * i; });
        step();
    }
    EXPECT_THAT(draws_by_command(), ElementsAre(4u, 4u)) << "depths alone have no order: moving ones join the others";
}

TEST_F(FewDraws, OfSheetsAreTheSameForBothMaps) {
    add_all();
    const ecs::Entity lamp = add_lamp();
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::exact; });
    step();
    std::vector<Pass> drawn;
    for (const Pass& pass : depth_passes())
        if (!pass.draws.empty()) drawn.push_back(pass);
    ASSERT_THAT(drawn, SizeIs(2)) << "the nearest, and what is behind";
    EXPECT_THAT(drawn[0].draws_by_command, ElementsAre(7u)) << "both faces of all, and none that is masked";
    EXPECT_EQ(drawn[0].draws, drawn[1].draws);
    EXPECT_EQ(drawn[0].draws_by_command, drawn[1].draws_by_command);
}

TEST_F(FewDraws, AllocateNothingOnceWarm) {
    add_all();
    for (const LightKind kind : {LightKind::spot, LightKind::point}) add_lamp({}, kind);
    SilentDevice silent;
    auto made = FrameSystem::create(silent, library);
    ASSERT_TRUE(made);
    std::size_t allocations = 0;
    for (int i = 0; i < 8; ++i) {
        const std::size_t before = allocation_count();
        made.value()->run(world.registry, settings);
        allocations = allocation_count() - before;
    }
    EXPECT_EQ(allocations, 0u);
}

/// A thousand meshes in every state that casters can need.
class ManyMeshes : public FrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    static constexpr std::size_t kOfEach = 250;
    void SetUp() override {
        const auto open = copies(library, kBox, kOfEach), solid = copies(library, kSolidBox, 2 * kOfEach),
                   masked = copies(library, kMaskedBox, kOfEach);
        FrameTest::SetUp();
        world.add_mesh(kPlane, {0, 0, 0}, false);
        world.add_camera({0, 12, 20}, {0, 0, 0});
        std::size_t n = 0;
        for (const auto& meshes : {open, solid, masked})
            for (const std::uint32_t mesh : meshes) {
                const glm::dvec3 at(0.5 * static_cast<double>(n % 32) - 8.0, 1.0,
                                    0.5 * static_cast<double>(n / 32) - 8.0);
                const ecs::Entity entity = world.add_mesh(mesh, at, true);
                if (n++ % 2 == 1) world.registry.patch<Transform>(entity, [](Transform& t) { t.scale.x = -1.0; });
            }
        lamp = world.add_light(GetParam(), kLightPlace_m, "lamp");
        edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    }
    /// Commands of each pass that draws, less the programs that it uses.
    std::vector<std::size_t> commands_beyond_programs() const {
        std::vector<std::size_t> beyond;
        for (const Pass& pass : depth_passes()) {
            std::set<std::uint32_t> programs;
            for (const gl::PipelineState& state : pass.pipelines) programs.insert(state.program.id);
            if (!pass.draws.empty()) beyond.push_back(pass.draws_by_command.size() - programs.size());
        }
        return beyond;
    }
    ecs::Entity lamp;
};

INSTANTIATE_TEST_SUITE_P(Kinds, ManyMeshes,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

TEST_P(ManyMeshes, AreAsManyCommandsPerViewAsProgramsAndTwoMore) {
    for (const ShadowFilter filter : {ShadowFilter::hardware_2x2, ShadowFilter::triangles, ShadowFilter::exact}) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = filter, s.resolution_px = 128; });
        edit_light(world.registry, lamp, [](ShadowTuning& t) { t.maps.multi_draw = true; });
        step();
        ASSERT_THAT(commands_beyond_programs(), Not(IsEmpty()));
        EXPECT_THAT(commands_beyond_programs(), Each(::testing::Le(2u)));
        edit_light(world.registry, lamp, [](ShadowTuning& t) { t.maps.multi_draw = false; });
        step();
        EXPECT_THAT(commands_beyond_programs(), Contains(::testing::Gt(200u))) << "or there was nothing to merge";
    }
}

/// Meshes in buffers of engines, gathered without a frame.
class EngineMeshDraws : public ::testing::Test {
protected:
    void SetUp() override {
        library = test_library();
        auto made = GpuScene::create(device, library);
        ASSERT_TRUE(made);
        gpu.emplace(std::move(made).value());
        for (std::uint32_t i = 0; i < buffers.size(); ++i)
            buffers[i] = device.create_buffer({.label = "engine", .size = 4096}, {}).handle;
    }
    void TearDown() override {
        for (const gl::BufferHandle buffer : buffers) device.destroy(buffer);
    }
    void add(std::uint32_t mesh) {
        InstanceItem item;
        item.mesh = mesh;
        item.gpu_slot = static_cast<std::uint32_t>(scene.instances.size());
        item.bounds_ws = {glm::dvec3(-1.0), glm::dvec3(1.0)};
        casters.push_back(item.gpu_slot);
        scene.instances.push_back(item);
    }
    gl::RecordingDevice device;
    assets::MeshLibrary library;
    std::optional<GpuScene> gpu;
    std::array<gl::BufferHandle, 3> buffers{};
    SceneSnapshot scene;
    std::vector<std::uint32_t> casters;
};

TEST_F(EngineMeshDraws, AreOneBatchPerBuffersAndComeLast) {
    const auto first = static_cast<std::uint32_t>(gpu->mesh_count());
    const gl::MeshLayout layout{.stride = 12};
    gpu->put_engine_mesh(first, {buffers[0], buffers[1], layout, 0, 3, 0});
    gpu->put_engine_mesh(first + 1, {buffers[0], buffers[1], layout, 3, 6, 5});
    gpu->put_engine_mesh(first + 2, {buffers[2], buffers[1], layout, 0, 3, 0});
    gpu->put_engine_mesh(first + 3, {buffers[0], buffers[1], layout, 0, 3, 0});
    gpu->put_engine_mesh(first + 3, {});  // taken back
    for (std::uint32_t mesh = first; mesh < first + 4; ++mesh) add(mesh);
    add(kMixedBox);
    shadow::DepthDraws draws;
    draws.add(scene, *gpu, {.triangles = true, .culls = true, .parallel = true}, {casters, {}, {}});
    const auto batches = draws.batches(draws.end_group());
    ASSERT_EQ(batches.size(), 4u);
    EXPECT_TRUE(!batches[0].mask && !batches[0].engine) << "the opaque half";
    EXPECT_TRUE(batches[1].mask && !batches[1].engine) << "the masked half";
    EXPECT_EQ(batches[2].draws.count, 2u) << "in the same buffers";
    EXPECT_EQ(batches[3].draws.count, 1u);
    EXPECT_EQ(batches[3].engine, gpu->engine_mesh(first + 2));
    const auto second = draws.records()[batches[2].draws.first + 1];
    EXPECT_EQ(second, (gl::MeshDrawRecord{6, 1, 3, 5, second.first_item}));
    EXPECT_EQ(draws.items()[second.first_item],
              (shadow::DepthItem{1, shadow::DepthDraws::kNoTriangle << shadow::DepthDraws::kLayerBits}));
}

TEST_F(EngineMeshDraws, FactsOfAMeshFollowItsMaterials) {
    EXPECT_EQ(gpu->depth_facts(kBox).draws, 1u);
    EXPECT_EQ(gpu->depth_facts(kMixedBox).draws, 2u);
    EXPECT_TRUE(gpu->depth_facts(kMixedBox).masked);
    EXPECT_FALSE(gpu->depth_facts(kBox).masked);
    EXPECT_EQ(gpu->depth_facts(kBlendedBox).draws, 0u);
    EXPECT_TRUE(gpu->depth_facts(kSolidBox).solid);
    library.remove(kBox);
    gl::CommandList list;
    gpu->update_meshes(list);
    EXPECT_EQ(gpu->depth_facts(kBox).draws, 0u);
}

}  // namespace
}  // namespace gnomon
