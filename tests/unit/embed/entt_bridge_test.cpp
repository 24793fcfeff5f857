#include "gnomon/entt.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/unit/embed/registry_stand_in.h"

namespace gnomon {
namespace {

struct Place {
    glm::dvec3 at_m{0.0};
};
struct Model {
    MeshId mesh;
    bool casts = true;
};
struct Lamp {
    float intensity = 100.0f;
};

struct Traits {
    using Transform = Place;
    using Caster = Model;
    using Light = Lamp;
    static glm::dmat4 world(const Place& place) {
        glm::dmat4 matrix(1.0);
        matrix[3] = glm::dvec4(place.at_m, 1.0);
        return matrix;
    }
    static CasterDesc caster(const Model& model) { return {.mesh = model.mesh, .casts = model.casts}; }
    static LightDesc light(const Lamp& lamp, const glm::dmat4& world) {
        return {.light = {.intensity = lamp.intensity}, .position_m = glm::dvec3(world[3])};
    }
};

/// Stands for Shadows, and counts its calls.
struct Told {
    std::map<std::uint32_t, CasterDesc> casters;
    std::map<std::uint32_t, LightDesc> lights;
    std::uint32_t next = 0;
    int calls = 0;
    CasterId add_caster(const CasterDesc& desc) { return ++calls, casters[next] = desc, CasterId{next++, 1}; }
    void set_caster(CasterId id, const CasterDesc& desc) { ++calls, casters.at(id.index) = desc; }
    void remove(CasterId id) { ++calls, casters.erase(id.index); }
    LightId add_light(const LightDesc& desc) { return ++calls, lights[next] = desc, LightId{next++, 1}; }
    void set_light(LightId id, const LightDesc& desc) { ++calls, lights.at(id.index) = desc; }
    void remove(LightId id) { ++calls, lights.erase(id.index); }
};

class EnttBridgeTest : public ::testing::Test {
protected:
    stand_in::Registry registry;
    Told told;
    EnttBridge<stand_in::Registry, Traits, Told> bridge{told, registry};

    stand_in::Entity add_model(const glm::dvec3& at_m) {
        const auto entity = registry.create();
        registry.emplace(entity, Place{at_m});
        registry.emplace(entity, Model{MeshId{7, 1}});
        return entity;
    }
};

TEST_F(EnttBridgeTest, HandsOverWhatHasPlaceAndModel) {
    const auto entity = add_model({1.0, 2.0, 3.0});
    EXPECT_TRUE(told.casters.empty()) << "before sync()";
    bridge.sync();
    ASSERT_EQ(told.casters.size(), 1u);
    const CasterDesc& desc = told.casters.at(bridge.caster(entity).index);
    EXPECT_EQ(desc.mesh, (MeshId{7, 1}));
    EXPECT_EQ(glm::dvec3(desc.world_from_mesh[3]), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_TRUE(told.lights.empty());
    EXPECT_FALSE(bridge.light(entity));
}

TEST_F(EnttBridgeTest, TakesComponentsInAnyOrder) {
    const auto entity = registry.create();
    registry.emplace(entity, Lamp{5.0f});
    bridge.sync();
    EXPECT_TRUE(told.lights.empty()) << "it has no place yet";
    registry.emplace(entity, Place{{0.0, 4.0, 0.0}});
    bridge.sync();
    ASSERT_EQ(told.lights.size(), 1u);
    EXPECT_EQ(told.lights.begin()->second.position_m.y, 4.0);
    EXPECT_EQ(told.lights.begin()->second.light.intensity, 5.0f);
}

TEST_F(EnttBridgeTest, TellsWhatChangedAndNothingElse) {
    const auto moved = add_model({0.0, 0.0, 0.0});
    add_model({5.0, 0.0, 0.0});
    bridge.sync();
    told.calls = 0;
    bridge.sync();
    EXPECT_EQ(told.calls, 0) << "nothing changed";
    registry.patch<Place>(moved, [](Place& place) { place.at_m.x = -1.0; });
    bridge.sync();
    EXPECT_EQ(told.calls, 1);
    EXPECT_EQ(told.casters.at(bridge.caster(moved).index).world_from_mesh[3].x, -1.0);
}

TEST_F(EnttBridgeTest, RemovesWhatLostAComponentOrItsEntity) {
    const auto first = add_model({0.0, 0.0, 0.0}), second = add_model({1.0, 0.0, 0.0});
    registry.emplace(second, Lamp{});
    bridge.sync();
    EXPECT_EQ(told.casters.size(), 2u);
    EXPECT_EQ(told.lights.size(), 1u);
    registry.remove<Model>(first);
    registry.destroy(second);
    bridge.sync();
    EXPECT_TRUE(told.casters.empty());
    EXPECT_TRUE(told.lights.empty());
    EXPECT_FALSE(bridge.caster(first));
}

TEST_F(EnttBridgeTest, SaysNothingOfWhatCameAndWentBetweenTwoFrames) {
    const auto entity = add_model({0.0, 0.0, 0.0});
    registry.destroy(entity);
    bridge.sync();
    EXPECT_EQ(told.calls, 0);
}

TEST_F(EnttBridgeTest, TakesWhatWasThereBeforeByTouch) {
    stand_in::Registry filled;
    const auto entity = filled.create();
    filled.emplace(entity, Place{});
    filled.emplace(entity, Model{});
    Told shadows;
    {
        EnttBridge<stand_in::Registry, Traits, Told> late(shadows, filled);
        late.sync();
        EXPECT_TRUE(shadows.casters.empty());
        late.touch(entity);
        late.sync();
        EXPECT_EQ(shadows.casters.size(), 1u);
    }
    filled.patch<Place>(entity, [](Place&) {});  // no bridge listens now
}

}  // namespace
}  // namespace gnomon
