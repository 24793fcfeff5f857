#include <glm/gtc/quaternion.hpp>

#include "gnomon/components.h"
#include "systems/shadow/culling/static_dynamic_casters.h"
#include "systems/visibility/caster_trees.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/silent_device.h"
#include "tests/system/streamed_meshes.h"
#include "tests/unit/allocation_counter.h"

/// Frames while meshes come to the library, are replaced, and go: what is drawn again, what is reported, what it costs.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

constexpr int kRest = static_cast<int>(shadow::DynamicCasters::kStaticFrames) + 4;  // kept visibility is filled, too

/// Adds a lamp that shines straight down on two metres around x.
ecs::Entity add_down_light(TestWorld& world, double x_m, const std::string& name, ShadowFilter filter) {
    const ecs::Entity e = world.add_light(LightKind::spot, {x_m, 6, 0}, name);
    world.registry.patch<Transform>(e, [](Transform& t) { t.rotation = glm::quatLookAt(glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)); });
    world.registry.patch<Light>(e, [](Light& l) { l.inner_cone_rad = 0.2f, l.outer_cone_rad = 0.25f; });
    world.registry.patch<LightShadow>(e, [&](LightShadow& s) { s.filter = filter, s.resolution_px = 256; });
    return e;
}

class StreamingFrames : public FrameTest, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        world.add_mesh(kPlane, {}, false);
        world.add_camera({0, 16, 6}, {0, 0, 0});
        left = world.add_mesh(kBox, {-4, 1, 0}, true);
        world.add_mesh(kMaskedBox, {4, 1, 0}, true);
        lamp = add_down_light(world, -4, "left", GetParam());
        add_down_light(world, 4, "right", GetParam());
        for (int i = 0; i < kRest; ++i) step();
        ASSERT_EQ(drawn(), (std::pair(0u, 0u)));
    }
    /// Views that the last frame drew for the two lights.
    std::pair<std::uint32_t, std::uint32_t> drawn() const {
        return {light("left").counts.views_drawn, light("right").counts.views_drawn};
    }
    ecs::Entity left, lamp;
};

INSTANTIATE_TEST_SUITE_P(Filters, StreamingFrames, ::testing::Values(ShadowFilter::triangles, ShadowFilter::hard, ShadowFilter::exact),
                         [](const auto& test) { return std::to_string(static_cast<int>(test.param)); });

TEST_P(StreamingFrames, OnlyViewsThatShowAMeshAreDrawnWhenItComesAndGoes) {
    const std::uint32_t mesh = library.add(strip_mesh(3, 0.3f, 1, true));
    step();
    EXPECT_EQ(drawn(), (std::pair(0u, 0u)));
    EXPECT_TRUE(frame->report().still) << "nothing shows it yet";
    const ecs::Entity shown = world.add_mesh(mesh, {-4, 2, 0}, true);
    step();
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
    const ecs::Entity aside = world.add_mesh(library.add(scaled_mesh(kBox, 0.5f)), {0, 1, 0}, true);
    step();
    EXPECT_EQ(drawn(), (std::pair(0u, 0u)));
    for (int i = 0; i < kRest; ++i) step();
    library.remove(world.registry.get<MeshRef>(aside)->mesh);
    world.registry.destroy(aside);
    step();
    EXPECT_EQ(drawn(), (std::pair(0u, 0u)));
    world.registry.destroy(shown);
    library.remove(mesh);
    step();
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
    EXPECT_THAT(frame->report().dropped, IsEmpty());
}

TEST_P(StreamingFrames, AnotherMeshInTheSlotIsDrawn) {
    const std::uint32_t mesh = library.add(scaled_mesh(kBox, 0.5f));
    world.registry.patch<MeshRef>(left, [&](MeshRef& ref) { ref.mesh = mesh; });
    for (int i = 0; i < kRest; ++i) step();
    ASSERT_EQ(drawn(), (std::pair(0u, 0u)));
    library.replace(mesh, scaled_mesh(kBox, 0.75f));
    step();
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
    for (int i = 0; i < kRest; ++i) step();
    library.remove(mesh);
    ASSERT_EQ(library.add(scaled_mesh(kSolidBox, 0.5f)), mesh);
    step();
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
    // Negative control: without its version the other mesh would be taken for the old one.
    for (int i = 0; i < kRest; ++i) step();
    library.meshes[mesh] = scaled_mesh(kSolidBox, 0.75f);
    step();
    EXPECT_EQ(drawn(), (std::pair(0u, 0u)));
}

TEST_P(StreamingFrames, AMapThatMayBeStaleIsNotKeptForAnotherMesh) {
    if (GetParam() == ShadowFilter::exact) GTEST_SKIP() << "its maps are never stale";
    const std::uint32_t mesh = library.add(scaled_mesh(kBox, 0.5f));
    world.registry.patch<MeshRef>(left, [&](MeshRef& ref) { ref.mesh = mesh; });
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.refresh_error_px = 1000.0f; });
    const auto nudge = [&] {
        world.registry.patch<Transform>(left, [](Transform& t) { t.translation_m.x += 1.0e-4; });
        step();
    };
    for (int i = 0; i < 4; ++i) nudge();
    EXPECT_EQ(drawn(), (std::pair(0u, 0u))) << "held: so little cannot be seen";
    library.replace(mesh, scaled_mesh(kBox, 0.75f));
    nudge();
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
}

TEST_P(StreamingFrames, AMeshWithoutRoomIsReportedAndDrawnLater) {
    device.fail_label("scene vertices", gl::Failure::out_of_memory);
    const std::uint32_t mesh = library.add(strip_mesh(3, 0.3f, 1, false));
    const ecs::Entity late = world.add_mesh(mesh, {-4, 2, 0}, true);
    for (int i = 0; i < 2; ++i) {
        step();
        ASSERT_EQ(frame->report().dropped.size(), 1u);
        EXPECT_EQ(frame->report().dropped[0].entity, late);
        EXPECT_STREQ(reason_code(frame->report().dropped[0].reason), "meshes_full");
        EXPECT_EQ(drawn(), (std::pair(0u, 0u)));
        EXPECT_LE(light("left").state, LightState::reused) << "it is shadowed as before";
    }
    device.stop_failing();
    int frames = 0;
    do step();
    while (!frame->report().dropped.empty() && ++frames < 100);
    EXPECT_EQ(frames, static_cast<int>(Retry::kFrames) - 2);
    EXPECT_EQ(drawn(), (std::pair(1u, 0u)));
}

TEST_P(StreamingFrames, AFailedSubmissionIsRepeated) {
    world.add_mesh(library.add(strip_mesh(3, 0.3f, 1, false)), {-4, 2, 0}, true);
    for (int i = 0; i < kRest; ++i) step();
    const auto written = [&] {
        std::uint64_t bytes = 0;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* update = std::get_if<gl::UpdateBuffer>(&c);
            const gl::BufferDesc* buffer = update ? device.buffer(update->buffer) : nullptr;
            if (buffer && buffer->label == "scene vertices") bytes += update->size;
        }
        return bytes;
    };
    const std::uint32_t mesh = library.add(strip_mesh(4, 0.3f, 1, false));
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    step();
    ASSERT_EQ(frame->report().failure, gl::Failure::out_of_memory) << "the submission was the frame's first call";
    EXPECT_EQ(written(), 16u * 32);
    world.add_mesh(mesh, {-4, 3, 0}, true);
    step();
    EXPECT_EQ(written(), 16u * 32);
    EXPECT_EQ(light("left").state, LightState::rendered);
    step();
    EXPECT_EQ(written(), 0u);
}

TEST_P(StreamingFrames, RaysWriteTheTreesOfNewMeshesAlone) {
    if (GetParam() != ShadowFilter::exact) GTEST_SKIP() << "no rays";
    const auto written = [&](const char* label) {
        std::uint64_t bytes = 0;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* update = std::get_if<gl::UpdateBuffer>(&c);
            if (update && device.buffer(update->buffer)->label == label) bytes += update->size;
        }
        return bytes;
    };
    const auto add = [&](assets::Mesh made) {
        const std::uint32_t mesh = library.add(std::move(made));
        const ecs::Entity e = world.add_mesh(mesh, {-4, 2, 0}, true);
        step();
        return std::pair(mesh, e);
    };
    for (int i = 0; i < 2; ++i) {  // the second time as well as the first, when the buffers begin to grow
        add(strip_mesh(3, 0.3f, 1, true));
        EXPECT_EQ(written("ray triangles"), 6u * sizeof(rays::BvhTriangle)) << i;
        EXPECT_EQ(frame->report().rays.meshes_written, 1u);
        EXPECT_LE(written("ray trees of meshes"), 11u * sizeof(rays::BvhNode));
    }
    const auto last = add(strip_mesh(30, 0.05f, 0, false));
    const RayReport before = frame->report().rays;
    library.remove(last.first);
    world.registry.destroy(last.second);
    step();
    EXPECT_EQ(written("ray triangles"), 0u);
    EXPECT_EQ(frame->report().rays.triangles, before.triangles - 60);
    EXPECT_LT(frame->report().rays.host_bytes, before.host_bytes);
    EXPECT_EQ(frame->report().rays.bytes, before.bytes);
    const std::size_t made = device.calls();
    add(strip_mesh(30, 0.05f, 0, false));
    EXPECT_EQ(device.calls() - made, 1u) << "the submission; the places are there";
    EXPECT_EQ(written("ray triangles"), 60u * sizeof(rays::BvhTriangle));
}

TEST_P(StreamingFrames, TreesWithoutRoomAreReportedAndMadeLater) {
    if (GetParam() != ShadowFilter::exact) GTEST_SKIP() << "no rays";
    for (const char* label : {"ray trees of meshes", "ray triangles", "ray masks"}) {
        SCOPED_TRACE(label);
        const std::uint64_t before = frame->report().rays.triangles;
        device.fail_label(label, gl::Failure::out_of_memory);
        world.add_mesh(library.add(strip_mesh(300, 0.005f, 1, false)), {-4, 2, 0}, true);
        step();
        EXPECT_EQ(light("left").reason, Reason::buffer_failed);
        device.stop_failing();
        for (std::uint64_t i = 0; i <= Retry::kFrames + 1; ++i) step();
        EXPECT_NE(light("left").reason, Reason::buffer_failed);
        EXPECT_LE(light("left").state, LightState::reused);
        EXPECT_EQ(frame->report().rays.triangles, before + 600);
    }
}

/// Allocations of frames that add a mesh, that remove one, and that do neither, in a world with `residents` other meshes.
struct Allocations {
    std::size_t adding = 0, removing = 0, resting = 0;
};
Allocations allocations_with(std::uint32_t residents, ShadowFilter filter) {
    SilentDevice silent;
    assets::MeshLibrary library = test_library();
    auto made = FrameSystem::create(silent, library);
    TestWorld world;
    world.add_mesh(kPlane, {}, false);
    world.add_camera({0, 16, 6}, {0, 0, 0});
    for (std::uint32_t i = 0; i < residents; ++i)
        world.add_mesh(library.add(strip_mesh(2, 0.3f, 0, false)), {0.02 * i - 4, 1, 4}, true);
    add_down_light(world, -4, "left", filter);
    add_down_light(world, 4, "right", filter);
    world.look_lights_up();  // what is kept of still pictures is made when they are still
    Allocations most;
    constexpr int kRounds = 8, kPeriod = 2 * kRest;
    for (int i = 0; i < kRounds * kPeriod; ++i) {
        static_assert(kPeriod > 60);
        std::size_t* of = &most.resting;
        std::uint32_t mesh = 0;
        if (i % kPeriod == 0) mesh = library.add(strip_mesh(3, 0.3f, 0, false)), of = &most.adding;
        if (i % kPeriod == 0) world.add_mesh(mesh, {-4, 2, 0}, true);
        if (i % kPeriod == kRest) {
            of = &most.removing;
            ecs::Entity last;
            world.registry.each<MeshRef>([&](ecs::Entity e, const MeshRef&) { last = e.index > last.index || last == ecs::kNull ? e : last; });
            library.remove(world.registry.get<MeshRef>(last)->mesh);
            world.registry.destroy(last);
        }
        const std::size_t before = allocation_count();
        made.value()->run(world.registry, {.viewport_px = {640, 360}, .exposure_ev = {}});
        if (i >= (kRounds - 2) * kPeriod) *of = std::max(*of, allocation_count() - before);
    }
    return most;
}

TEST_P(StreamingFrames, FramesWithoutChangesAllocateNothingAndOthersNoMoreInALargeWorld) {
    const Allocations few = allocations_with(20, GetParam()), many = allocations_with(400, GetParam());
    EXPECT_EQ(few.resting, 0u);
    EXPECT_EQ(many.resting, 0u);
    EXPECT_GT(few.removing, 0u) << "the counter counts";
    std::cout << "adding " << few.adding << " " << many.adding << ", removing " << few.removing << " " << many.removing << "\n";
    EXPECT_LE(many.adding, few.adding + 30);
    EXPECT_LE(many.removing, few.removing + 30);
}

}  // namespace
}  // namespace gnomon
