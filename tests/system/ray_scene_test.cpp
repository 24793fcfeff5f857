#include <map>

#include "gnomon/components.h"
#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/visibility/ray_records.h"
#include "tests/system/frame_fixture.h"

/// What a light with rays needs, and that no other light pays for it.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class RayScene : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    std::vector<std::string> ray_labels() const {
        std::vector<std::string> labels = map_labels(device, "ray ");
        for (const char* other : {"surface places", "verdicts of maps", "answers of rays", "pixels for rays"})
            for (const std::string& label : map_labels(device, other)) labels.push_back(label);
        return labels;
    }
    /// Counts the bytes that the last frame wrote into buffers with a label that begins so.
    std::uint64_t uploaded(const std::string& label) const {
        std::uint64_t bytes = 0;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* update = std::get_if<gl::UpdateBuffer>(&c);
            if (update && device.buffer(update->buffer)->label.starts_with(label)) bytes += update->size;
        }
        return bytes;
    }
    std::vector<std::uint32_t> storage_bindings() const {
        std::vector<std::uint32_t> found;
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* s = std::get_if<gl::BindStorage>(&c)) found.push_back(s->binding);
        return found;
    }
    /// Labels of buffers that are read as texels.
    std::vector<std::string> texels() const {
        std::vector<std::string> found;
        for (const gl::Command& c : frame->commands().commands)
            if (const auto* t = std::get_if<gl::BindTexels>(&c)) found.push_back(device.buffer(t->buffer)->label);
        return found;
    }
    TestWorld::Stage stage;
};

TEST_F(RayScene, LightsOfEveryOtherRowBuildCompileBindAndAllocateNothingOfIt) {
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (!row.rays) add_light(LightKind::spot, std::string(row.name), row.id);
    const ecs::Entity off = add_light(LightKind::spot, "off", ShadowFilter::exact);
    world.registry.patch<LightShadow>(off, [](LightShadow& s) { s.enabled = false; });
    step();
    EXPECT_THAT(ray_labels(), IsEmpty());
    constexpr std::uint32_t kMasks = 7;  // binding of the masks for `triangles`
    EXPECT_THAT(storage_bindings(), Each(kMasks));
    EXPECT_THAT(texels(), Each(::testing::AnyOf("caster triangles", "instances", "triangle normals")))
        << "of `triangles`, and of all surfaces";
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("exact"))));
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("places"))));
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("sheet"))));
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("peeled"))));
    EXPECT_THAT(map_labels(device, ", second"), IsEmpty());
    EXPECT_THAT(map_labels(device, ", bounds"), IsEmpty());
    const RayReport& rays = frame->report().rays;
    EXPECT_EQ(rays.bytes + rays.host_bytes + rays.list_bytes + rays.place_bytes, 0u);
    EXPECT_EQ(rays.sheet_bytes + rays.sheet_host_bytes, 0u);
}

TEST_F(RayScene, IsOneForAllLightsThatAsk) {
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    add_light(LightKind::directional, "sun", ShadowFilter::exact);
    add_light(LightKind::point, "bulb", ShadowFilter::exact);
    step();
    EXPECT_THAT(map_labels(device, "ray "), SizeIs(4)) << "trees, triangles, instances, the tree over them; no masks";
    EXPECT_THAT(map_labels(device, "surface places"), SizeIs(2)) << "a texture and a target";
    for (const char* what : {"ray trees of meshes", "ray triangles", "ray tree of instances", "ray instances"})
        EXPECT_THAT(texels(), Contains(what));
    for (const LightReport& light : frame->report().lights) {
        EXPECT_EQ(light.state, LightState::rendered) << light.name;
        EXPECT_TRUE(light.keeps_max_error) << light.name;
        EXPECT_EQ(light.predicted_error_px, 0.0) << light.name;
    }
}

TEST_F(RayScene, SaysItsBytes) {
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    world.add_mesh(kMaskedBox, {1, 1, 1}, true);
    step();
    EXPECT_THAT(map_labels(device, "ray masks"), SizeIs(1));
    constexpr std::uint32_t kMasks = 7;
    std::map<std::string, std::uint64_t> sizes;
    for (const gl::Command& c : frame->commands().commands) {
        if (const auto* s = std::get_if<gl::BindStorage>(&c); s && s->binding == kMasks)
            sizes[device.buffer(s->buffer)->label] = device.buffer(s->buffer)->size;
        const auto* t = std::get_if<gl::BindTexels>(&c);
        if (t && device.buffer(t->buffer)->label.starts_with("ray "))
            sizes[device.buffer(t->buffer)->label] = device.buffer(t->buffer)->size;
    }
    EXPECT_THAT(sizes, SizeIs(5));
    std::uint64_t held = 0;
    for (const auto& [label, size] : sizes) held += size;
    EXPECT_EQ(frame->report().rays.bytes, held);
    EXPECT_EQ(frame->report().rays.instances, 2u) << "the plane does not cast";
    EXPECT_EQ(frame->report().rays.triangles, 24u);
}

TEST_F(RayScene, SaysTheBytesOfItsPicturesAndOfWhatSheetsAreDrawnFrom) {
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    step();
    std::map<std::string, std::uint64_t> made;  // by label: what it was made as last
    for (const gl::ResourceCall& call : device.resource_calls())
        if (call.kind == gl::ResourceCall::Kind::create_texture || call.kind == gl::ResourceCall::Kind::create_buffer)
            made[call.label] = call.bytes;
    const auto bytes = [&](const char* label) {
        EXPECT_GT(made[label], 0u) << label;
        return made[label];
    };
    const RayReport& rays = frame->report().rays;
    EXPECT_EQ(rays.list_bytes, bytes("verdicts of maps") + bytes("answers of rays") + bytes("pixels for rays"));
    EXPECT_EQ(rays.place_bytes, bytes("surface places"));
    EXPECT_EQ(rays.sheet_bytes, bytes("shadow sheet items") + bytes("shadow sheet views"));
    EXPECT_GE(rays.sheet_host_bytes, 12 * sizeof(shadow::CasterTopology::Facet)) << "a box";
    const RayReport before = rays;
    for (int i = 0; i < 3; ++i) step();
    EXPECT_TRUE(frame->report().still);
    EXPECT_EQ(frame->report().rays.list_bytes, before.list_bytes) << "still";
    EXPECT_EQ(frame->report().rays.sheet_bytes, before.sheet_bytes);
}

TEST_F(RayScene, IsWrittenOnlyWhereSomethingMoved) {
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    step();
    EXPECT_GT(uploaded("ray "), 0u);
    step();
    EXPECT_EQ(uploaded("ray "), 0u) << "a still frame";
    EXPECT_EQ(light("lamp").state, LightState::reused);
    world.move(stage.camera, {0.5, 4, 8});
    step();
    EXPECT_EQ(uploaded("ray "), 0u) << "the camera alone moved";
    world.move(stage.box, {0.2, 1, 0});
    step();
    EXPECT_TRUE(frame->report().rays.instances_written);
    EXPECT_EQ(frame->report().rays.meshes_written, 0u);
    EXPECT_EQ(uploaded("ray tree of instances") + uploaded("ray instances"), uploaded("ray ")) << "no mesh";
    step();
    EXPECT_FALSE(frame->report().rays.instances_written);
    const ecs::Entity second = world.add_mesh(kSolidBox, {2, 1, 0}, true);
    step();
    EXPECT_EQ(frame->report().rays.instances, 2u) << "a mesh that was in no tree";
    EXPECT_EQ(frame->report().rays.triangles, 24u);
    world.registry.remove<ShadowCaster>(second);
    step();
    EXPECT_EQ(frame->report().rays.instances, 1u);
}

TEST_F(RayScene, IsFreedWithTheLastLightThatAsks) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    const std::size_t map_objects = map_labels(device).size();
    choose(lamp, ShadowFilter::exact);
    step();
    world.move(stage.camera, {0, -400, 8});
    step();
    EXPECT_THAT(map_labels(device, "ray "), SizeIs(4)) << "nobody sees it now, but it may be seen again";
    world.move(stage.camera, {0, 4, 8});
    choose(lamp, ShadowFilter::triangles);
    step();
    EXPECT_THAT(ray_labels(), IsEmpty());
    EXPECT_EQ(map_labels(device).size(), map_objects);
    EXPECT_EQ(frame->report().rays.bytes, 0u);
}

TEST_F(RayScene, WithoutRoomForItTheMapIsLookedUpOnceThenByTrianglesAndItIsTriedAgain) {
    for (const char* what : {"ray trees of meshes", "ray triangles", "ray tree of instances", "ray instances"}) {
        SCOPED_TRACE(what);
        device.fail_label(what, gl::Failure::out_of_memory);
        const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::exact);
        step();
        EXPECT_EQ(light("lamp").state, LightState::degraded);
        EXPECT_EQ(light("lamp").reason, Reason::buffer_failed);
        EXPECT_GT(light("lamp").predicted_error_px, 0.0) << "as a map by itself has";
        EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("filters/pcf/hard")));
        for (int i = 0; i < 2; ++i) {
            step();
            EXPECT_EQ(light("lamp").state, LightState::degraded);
            EXPECT_EQ(light("lamp").reason, Reason::buffer_failed);
            EXPECT_EQ(light("lamp").filter.filter, ShadowFilter::triangles);
        }
        EXPECT_EQ(light("lamp").counts.views_drawn, 0u) << "nothing changes while there is no room";
        device.stop_failing();
        for (std::uint64_t i = 2; i < Retry::kFrames; ++i) step();
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        EXPECT_EQ(light("lamp").predicted_error_px, 0.0);
        world.registry.destroy(lamp);
        step();
        EXPECT_THAT(ray_labels(), IsEmpty());
    }
}

TEST_F(RayScene, WithoutRoomALightWhoseContractAsksForRaysIsHeldToWhatMapsGive) {
    device.fail_label("ray triangles", gl::Failure::out_of_memory);
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::automatic);
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) {
        s.max_error_px = 0.01f;
        s.resolution_px = 0;
    });
    step();
    EXPECT_EQ(light("lamp").reason, Reason::buffer_failed);
    const int frames = static_cast<int>(Retry::kFrames) + 3;  // enough for another attempt
    for (int i = 0; i < frames; ++i) {
        step();
        EXPECT_EQ(light("lamp").filter.filter, ShadowFilter::triangles) << i;
        EXPECT_EQ(light("lamp").state, LightState::degraded) << i;
        EXPECT_EQ(light("lamp").reason, Reason::buffer_failed) << i;
    }
    device.stop_failing();
    for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) step();
    EXPECT_EQ(light("lamp").filter.filter, ShadowFilter::exact);
    EXPECT_EQ(light("lamp").predicted_error_px, 0.0);
}

TEST_F(RayScene, WithoutRoomASunThatAskedForNoMapHasOneAFrameLater) {
    device.fail_label("ray triangles", gl::Failure::out_of_memory);
    const ecs::Entity sun = add_light(LightKind::directional, "sun", ShadowFilter::exact);
    edit_light(world.registry, sun, [](ShadowTuning& t) { t.projection.kind = LightProjection::perspective; });
    step();
    EXPECT_EQ(light("sun").state, LightState::skipped) << "there is nothing to look up";
    EXPECT_EQ(light("sun").reason, Reason::buffer_failed);
    step();
    EXPECT_EQ(light("sun").state, LightState::degraded);
    EXPECT_EQ(light("sun").reason, Reason::buffer_failed);
    EXPECT_EQ(light("sun").filter.filter, ShadowFilter::triangles);
}

TEST_F(RayScene, WithoutRoomForPlacesTheMapIsLookedUpOnceAndThatIsSaid) {
    device.fail_label("surface places", gl::Failure::out_of_memory);
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    step();
    EXPECT_EQ(light("lamp").state, LightState::degraded);
    EXPECT_EQ(light("lamp").reason, Reason::buffer_failed);
    device.stop_failing();
    step();
    EXPECT_EQ(light("lamp").state, LightState::reused);
}

TEST_F(RayScene, IsWrittenAgainAfterASubmissionThatFailed) {
    add_light(LightKind::spot, "lamp", ShadowFilter::exact);
    step();
    world.move(stage.box, {0.2, 1, 0});
    device.fail_from(device.calls(), gl::Failure::out_of_memory, true);
    step();
    device.stop_failing();
    step();
    EXPECT_GT(uploaded("ray tree of instances"), 0u);
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

}  // namespace
}  // namespace gnomon
