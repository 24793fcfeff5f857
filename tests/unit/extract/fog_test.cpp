#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "gnomon/components.h"
#include "tests/unit/extract/extracted_world.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class FogExtractTest : public ExtractedWorldTest {
protected:
    void SetUp() override { stage = world.add_stage(); }
    ecs::Entity add_fog(const FogVolume& fog = {}, const glm::dvec3& at_m = {0.0, 2.0, 0.0}) {
        const ecs::Entity e = world.registry.create();
        world.registry.emplace<Transform>(e, {.translation_m = at_m});
        world.registry.emplace<FogVolume>(e, fog);
        return e;
    }
    const InstanceItem* air() const {
        for (const InstanceItem& item : snapshot.instances)
            if (is_air(item)) return &item;
        return nullptr;
    }
    TestWorld::Stage stage;
};

TEST_F(FogExtractTest, IsAReceiverInItsBoxWithoutASurface) {
    const ecs::Entity fog = add_fog({.half_extent_m = {1.0, 2.0, 3.0}, .shadow_layers = 4});
    update();
    ASSERT_NE(air(), nullptr);
    EXPECT_TRUE(snapshot.air.any);
    EXPECT_EQ(air()->entity, fog);
    EXPECT_EQ(air()->bounds_ws, (math::Aabb{{-1.0, 0.0, -3.0}, {1.0, 4.0, 3.0}}));
    EXPECT_TRUE(air()->receives);
    EXPECT_EQ(air()->receive_layers, 4);
    EXPECT_FALSE(air()->casts);
    EXPECT_FALSE(shows_surface(*air()));
    ASSERT_THAT(snapshot.air.fogs, SizeIs(1));
    EXPECT_EQ(&snapshot.instances[snapshot.air.fogs[0].instance], air());
    EXPECT_EQ(snapshot.air.fogs[0].extinction_per_m, FogVolume{}.extinction_per_m);
}

TEST_F(FogExtractTest, WithoutExtinctionOnlyReceives) {
    add_fog({.extinction_per_m = 0.0f});
    update();
    EXPECT_NE(air(), nullptr);
    EXPECT_THAT(snapshot.air.fogs, IsEmpty());
}

TEST_F(FogExtractTest, MovesAndChangesInPlace) {
    const ecs::Entity fog = add_fog();
    update();
    const std::uint64_t version = air()->version, listed = snapshot.list_version;
    update();
    EXPECT_EQ(air()->version, version);
    EXPECT_THAT(snapshot.changed_instances, IsEmpty());
    world.move(fog, {0.0, 7.0, 0.0});
    update();
    EXPECT_GT(air()->version, version);
    EXPECT_EQ(snapshot.list_version, listed);
    EXPECT_EQ(air()->bounds_ws.max.y, 12.0);
    EXPECT_THAT(snapshot.changed_instances, SizeIs(1));
    const std::uint64_t moved = snapshot.version;
    world.registry.patch<FogVolume>(fog, [](FogVolume& f) { f.extinction_per_m = 0.5f, f.receives_shadow = false; });
    update();
    EXPECT_GT(snapshot.version, moved);
    EXPECT_FALSE(air()->receives);
    EXPECT_EQ(snapshot.air.fogs.at(0).extinction_per_m, 0.5f);
    EXPECT_THAT(snapshot.changed_instances, SizeIs(1));
}

TEST_F(FogExtractTest, ComesAndGoes) {
    const std::size_t surfaces = [&] { return update(), snapshot.instances.size(); }();
    EXPECT_FALSE(snapshot.air.any);
    // Few of many are taken in and out in place.
    for (int i = 0; i < 12; ++i) world.add_mesh(kBox, {2.0 * i, 0.5, 0.0}, true);
    update();
    const ecs::Entity fog = add_fog();
    update();
    expect_as_if_made_anew("come");
    EXPECT_THAT(snapshot.instances, SizeIs(surfaces + 13));
    ASSERT_THAT(snapshot.air.fogs, SizeIs(1));
    EXPECT_EQ(&snapshot.instances[snapshot.air.fogs[0].instance], air());
    world.registry.remove<FogVolume>(fog);
    update();
    expect_as_if_made_anew("gone");
    EXPECT_EQ(air(), nullptr);
    EXPECT_FALSE(snapshot.air.any);
    EXPECT_THAT(snapshot.air.fogs, IsEmpty());
    world.registry.emplace<FogVolume>(fog);
    update();
    expect_as_if_made_anew("come again");
    EXPECT_NE(air(), nullptr);
    // A box before it in the list goes: what it shows is that of the same box of fog.
    world.registry.destroy(stage.box);
    update();
    expect_as_if_made_anew("another gone");
    EXPECT_EQ(&snapshot.instances[snapshot.air.fogs.at(0).instance], air());
    world.registry.destroy(fog);
    update();
    EXPECT_EQ(air(), nullptr);
}

TEST_F(FogExtractTest, OutOfRangeIsDroppedUntilItIsNot) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const ecs::Entity fog = add_fog();
    const FogVolume bad[] = {{.half_extent_m = {1.0, 0.0, 1.0}},
                             {.half_extent_m = {1.0, static_cast<double>(kNan), 1.0}},
                             {.extinction_per_m = -0.1f},
                             {.extinction_per_m = kNan},
                             {.albedo = {0.5f, 1.5f, 0.5f}},
                             {.anisotropy = 1.0f},
                             {.anisotropy = kNan}};
    for (const FogVolume& numbers : bad) {
        world.registry.patch<FogVolume>(fog, [&](FogVolume& f) { f = numbers; });
        update();
        EXPECT_EQ(air(), nullptr);
        EXPECT_THAT(snapshot.dropped, ElementsAre(Field(&DroppedEntity::reason, DropReason::absurd_fog)));
        EXPECT_STREQ(reason_code(snapshot.dropped[0].reason), "absurd_fog");
        world.registry.patch<FogVolume>(fog, [](FogVolume& f) { f = {}; });
        update();
        EXPECT_NE(air(), nullptr) << "control";
        EXPECT_THAT(snapshot.dropped, IsEmpty());
    }
    world.registry.patch<Transform>(fog, [](Transform& t) { t.scale = glm::dvec3(0.0); });
    update();
    EXPECT_EQ(air(), nullptr);
    EXPECT_THAT(snapshot.dropped, ElementsAre(Field(&DroppedEntity::reason, DropReason::zero_scale)));
    world.registry.patch<Transform>(fog,
                                    [&](Transform& t) { t.scale = glm::dvec3(1.0), t.translation_m.x = std::nan(""); });
    update();
    EXPECT_EQ(air(), nullptr);
    EXPECT_THAT(snapshot.dropped, ElementsAre(Field(&DroppedEntity::reason, DropReason::non_finite_transform)));
}

TEST_F(FogExtractTest, OfAnEntityWithAMeshIsDropped) {
    world.registry.emplace<FogVolume>(stage.box);
    update();
    EXPECT_EQ(air(), nullptr);
    EXPECT_THAT(snapshot.dropped, ElementsAre(Field(&DroppedEntity::reason, DropReason::absurd_fog)));
    world.registry.remove<MeshRef>(stage.box);
    update();
    expect_as_if_made_anew("without its mesh");
    EXPECT_NE(air(), nullptr);
    EXPECT_THAT(snapshot.dropped, IsEmpty());
}

}  // namespace
}  // namespace gnomon
