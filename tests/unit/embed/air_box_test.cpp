#include "systems/embed/air_box.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "systems/embed/scene_store.h"

/// Boxes of air beside casters in the scene behind gnomon::Shadows.
namespace gnomon::embed {
namespace {

constexpr std::array<glm::vec3, 3> kOneTriangle{glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
constexpr std::array<std::uint32_t, 3> kFace{0, 1, 2};

class AirBox : public ::testing::Test {
protected:
    void SetUp() override {
        mesh = store.add_mesh({.positions_m = kOneTriangle, .indices = kFace}).value();
        for (int i = 0; i < 12; ++i) casters.push_back(store.add_caster({.mesh = mesh}));
        updated();
    }
    static glm::dmat4 at(double x_m, double side_m = 2.0) {
        return glm::scale(glm::translate(glm::dmat4(1.0), {x_m, 0.0, 0.0}), glm::dvec3(side_m));
    }
    const SceneSnapshot& updated() {
        store.update(cameras);
        return store.snapshot();
    }
    const InstanceItem* air() const {
        for (const InstanceItem& item : store.snapshot().instances)
            if (is_air(item)) return &item;
        return nullptr;
    }
    SceneStore store;
    MeshId mesh;
    std::vector<CasterId> casters;
    std::vector<ConsumerItem> cameras{{.entity = {0, 1}, .name = "view"}};
};

TEST_F(AirBox, ReceivesInItsBoundsAndDoesNotCast) {
    store.add_air(
        {.world_from_box = glm::rotate(at(5.0), 0.785398163397, glm::dvec3(0.0, 0.0, 1.0)), .receive_layers = 4});
    const SceneSnapshot& scene = updated();
    EXPECT_TRUE(scene.air.any);
    EXPECT_TRUE(scene.air.fogs.empty());
    ASSERT_NE(air(), nullptr);
    EXPECT_FALSE(air()->casts);
    EXPECT_TRUE(air()->receives);
    EXPECT_EQ(air()->receive_layers, 4);
    EXPECT_NEAR(air()->bounds_ws.max.x, 5.0 + std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(air()->bounds_ws.max.z, 1.0, 1e-9);
    EXPECT_FALSE(scene.drawables.any_by_depth);
}

TEST_F(AirBox, ComesMovesAndGoesInPlace) {
    const CasterId box = store.add_air({.world_from_box = at(5.0)});
    EXPECT_EQ(updated().changed_instances.size(), 1u);
    const std::uint64_t version = store.snapshot().version, listed = store.snapshot().list_version;
    store.set_air(box, {.world_from_box = at(5.0)});
    EXPECT_EQ(updated().version, version) << "what is equal costs nothing";
    store.set_air(box, {.world_from_box = at(7.0)});
    EXPECT_EQ(updated().changed_instances.size(), 1u);
    EXPECT_EQ(air()->bounds_ws.max.x, 8.0);
    EXPECT_EQ(store.snapshot().list_version, listed);
    store.set_air(box, {.world_from_box = at(7.0), .receive_layers = 2});
    EXPECT_GT(updated().list_version, listed);
    EXPECT_EQ(air()->receive_layers, 2);
    store.remove(casters[3]);
    EXPECT_EQ(updated().instances.size(), 12u);
    EXPECT_NE(air(), nullptr);
    store.remove(box);
    EXPECT_EQ(updated().instances.size(), 11u);
    EXPECT_FALSE(store.snapshot().air.any);
}

TEST_F(AirBox, WithoutAPlaceIsNamedAndComesBack) {
    const CasterId box = store.add_air({.world_from_box = glm::dmat4(std::nan(""))});
    updated();
    ASSERT_EQ(store.dropped().size(), 1u);
    EXPECT_EQ(store.dropped()[0].caster, box);
    EXPECT_EQ(store.dropped()[0].reason, "non_finite_transform");
    for (const double side_m : {0.0, 1e300}) {
        store.set_air(box, {.world_from_box = at(0.0, side_m)});
        updated();
        EXPECT_EQ(air() == nullptr, side_m == 0.0);
    }
    store.set_air(box, {.world_from_box = at(0.0)});
    updated();
    EXPECT_TRUE(store.dropped().empty());
    EXPECT_NE(air(), nullptr);
}

TEST_F(AirBox, IsNoCasterAndACasterIsNone) {
    const CasterId box = store.add_air({.world_from_box = at(5.0)});
    updated();
    const std::uint64_t version = store.snapshot().version;
    store.set_caster(box, {.mesh = mesh});
    store.set_transform(box, at(9.0));
    store.redraw(box, {}, 0.0);
    store.set_air(casters[0], {.world_from_box = at(9.0)});
    EXPECT_EQ(updated().version, version);
    ASSERT_NE(air(), nullptr);
    EXPECT_EQ(air()->bounds_ws.max.x, 6.0);
}

}  // namespace
}  // namespace gnomon::embed
