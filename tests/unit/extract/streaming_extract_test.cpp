#include <gmock/gmock.h>

#include "engine/mesh/mesh_shape.h"
#include "gnomon/components.h"
#include "tests/unit/extract/extracted_world.h"

/// What extraction makes of meshes that come to the library, are replaced, and go.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

class StreamingExtract : public ExtractedWorldTest {
protected:
    void SetUp() override {
        stage = world.add_stage();
        update();
    }
    const InstanceItem* item(ecs::Entity e) const {
        for (const InstanceItem& i : snapshot.instances)
            if (i.entity == e) return &i;
        return nullptr;
    }
    void update_lacking(std::vector<std::uint32_t> meshes) {
        const TransformReport& report = transforms.update(world.registry);
        extractor.update(world.registry, library, report, viewport_px, snapshot, meshes);
    }
    static assets::Mesh box() { return test_library().meshes[kBox]; }
    TestWorld::Stage stage;
};

TEST_F(StreamingExtract, AMeshThatNobodyShowsChangesNothing) {
    const std::uint64_t version = snapshot.version;
    const std::uint32_t mesh = library.add(box());
    update();
    EXPECT_EQ(snapshot.version, version);
    library.remove(mesh);
    update();
    EXPECT_EQ(snapshot.version, version);
}

TEST_F(StreamingExtract, AnotherMeshInTheSlotMakesItsInstancesNew) {
    const std::uint64_t plane_version = item(stage.plane)->version, box_version = item(stage.box)->version;
    library.replace(kBox, library.meshes[kPlane]);
    update();
    EXPECT_GT(item(stage.box)->version, box_version);
    EXPECT_EQ(item(stage.box)->mesh_version, library.version_of(kBox));
    EXPECT_EQ(item(stage.box)->bounds_ws.max.x, item(stage.box)->translation_ws_m.x + 10.0);
    EXPECT_EQ(item(stage.plane)->version, plane_version);
    EXPECT_EQ(snapshot.changed_instances.size(), 1u);
}

TEST_F(StreamingExtract, ARemovedMeshTakesItsInstancesAlongUntilAnotherComes) {
    library.remove(kBox);
    update();
    EXPECT_EQ(item(stage.box), nullptr);
    EXPECT_NE(item(stage.plane), nullptr);
    EXPECT_THAT(snapshot.dropped, ElementsAre(Field(&DroppedEntity::reason, DropReason::unknown_mesh)));
    EXPECT_EQ(library.add(box()), kBox) << "the slot is taken again";
    update();
    ASSERT_NE(item(stage.box), nullptr);
    EXPECT_EQ(item(stage.box)->version, snapshot.version);
    EXPECT_THAT(snapshot.dropped, IsEmpty());
}

TEST_F(StreamingExtract, AnEntityMayWaitForAMeshThatIsYetToCome) {
    const auto next = static_cast<std::uint32_t>(library.meshes.size());
    const ecs::Entity early = world.add_mesh(next, {0, 1, 0}, true);
    update();
    EXPECT_EQ(item(early), nullptr);
    EXPECT_EQ(library.add(box()), next);
    update();
    EXPECT_NE(item(early), nullptr);
}

TEST_F(StreamingExtract, InstancesOfMeshesThatTheDeviceLacksAreDroppedAndComeBack) {
    const std::uint64_t plane_version = item(stage.plane)->version;
    update_lacking({kBox});
    EXPECT_EQ(item(stage.box), nullptr);
    ASSERT_EQ(snapshot.dropped.size(), 1u);
    EXPECT_EQ(snapshot.dropped[0].entity, stage.box);
    EXPECT_EQ(snapshot.dropped[0].reason, DropReason::meshes_full);
    const std::uint64_t version = snapshot.version;
    update_lacking({kBox});
    EXPECT_EQ(snapshot.version, version) << "still";
    update();
    ASSERT_NE(item(stage.box), nullptr);
    EXPECT_EQ(item(stage.box)->version, snapshot.version) << "maps that lacked it are drawn again";
    EXPECT_EQ(item(stage.plane)->version, plane_version);
}

TEST_F(StreamingExtract, APoseIsNotTakenOverByAnotherMesh) {
    const auto soft_box = [&](float reach_m) {
        assets::Mesh mesh = box();
        auto deformer = std::make_shared<assets::Deformer>();
        assets::Deformer::Target target;
        target.positions.assign(mesh.vertices.size(), glm::vec3(reach_m, 0, 0));
        target.reach = {glm::dvec3(0.0), glm::dvec3(static_cast<double>(reach_m), 0.0, 0.0)};
        deformer->targets.push_back(target);
        mesh.deformer = std::move(deformer);
        return mesh;
    };
    const std::uint32_t mesh = library.add(soft_box(1.0f));
    const ecs::Entity soft = world.add_mesh(mesh, {0, 1, 0}, true);
    world.registry.emplace<MorphWeights>(soft, {{1.0f}});
    update();
    ASSERT_EQ(snapshot.poses.size(), 1u);
    const PoseItem before = snapshot.poses[0];
    library.replace(mesh, soft_box(5.0f));
    update();
    ASSERT_EQ(snapshot.poses.size(), 1u);
    EXPECT_GT(snapshot.poses[0].version, before.version);
    EXPECT_GT(snapshot.poses[0].since, before.since) << "how far it bent from the other mesh is unknown";
    EXPECT_GE(snapshot.poses[0].bounds_ms.max.x, 5.0);
    // Gone while its entity stays: nothing of the mesh is read.
    library.remove(mesh);
    world.registry.patch<MorphWeights>(soft, [](MorphWeights& w) { w.weights[0] = 0.5f; });
    update();
    EXPECT_THAT(snapshot.poses, IsEmpty());
}

TEST_F(StreamingExtract, AMeshThatWentLeavesItsShapeBehind) {
    assets::Mesh shaped = box();
    shaped.shape = assets::shape_of(shaped);
    const std::uint32_t mesh = library.add(std::move(shaped));
    const ecs::Entity e = world.add_mesh(mesh, {0, 1, 0}, true);
    update();
    const std::weak_ptr<const math::ShapeTree> shape = library.meshes[mesh].shape;
    ASSERT_EQ(snapshot.meshes.shapes.at(mesh), shape.lock());
    world.registry.destroy(e);
    update();
    library.remove(mesh);
    update();
    EXPECT_TRUE(shape.expired());
}

}  // namespace
}  // namespace gnomon
