#include "systems/embed/layered_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "systems/embed/scene_store.h"
#include "systems/extract/scene_tree.h"

namespace gnomon::embed {
namespace {

constexpr std::array<glm::vec3, 3> kTriangle{glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
constexpr std::array<std::uint32_t, 3> kOneFace{0, 1, 2};

class LayeredSceneTest : public ::testing::Test {
protected:
    LayeredSceneTest() { mesh = store.add_mesh({.positions_m = kTriangle, .indices = kOneFace}).value(); }
    CasterId add(const glm::dvec3& at_m, ShadowLayers cast, ShadowLayers receive) {
        return store.add_caster({.mesh = mesh, .world_from_mesh = at(at_m), .cast_layers = cast, .receive_layers = receive});
    }
    static glm::dmat4 at(const glm::dvec3& at_m) { return glm::translate(glm::dmat4(1.0), at_m); }
    void update() {
        store.update(cameras);
        layered.update(store.snapshot(), cameras);
    }
    /// Expects the followed scene to be as a new one.
    void expect_whole(const char* when) const {
        SCOPED_TRACE(when);
        LayeredScene fresh(layered.layers());
        fresh.update(store.snapshot(), cameras);
        const SceneSnapshot &a = layered.snapshot(), &b = fresh.snapshot();
        EXPECT_EQ(a.version, b.version);
        EXPECT_EQ(a.list_version, b.list_version);
        EXPECT_TRUE(has_tree(a));
        ASSERT_EQ(a.instances.size(), b.instances.size());
        for (std::size_t i = 0; i < a.instances.size(); ++i) {
            EXPECT_EQ(a.instances[i].casts, b.instances[i].casts) << i;
            EXPECT_EQ(a.instances[i].receives, b.instances[i].receives) << i;
            EXPECT_EQ(a.instances[i].version, b.instances[i].version) << i;
            EXPECT_EQ(a.instances[i].bounds_ws.max, b.instances[i].bounds_ws.max) << i;
        }
        const auto everywhere = [](const math::Aabb&) { return math::Overlap::partial; };
        std::size_t visited = 0;
        visit_instances(a, everywhere, [&](std::uint32_t) { ++visited; });
        EXPECT_EQ(visited, a.instances.size());
    }

    SceneStore store;
    MeshId mesh;
    std::vector<ConsumerItem> cameras{{.entity = {0, 1}}};
    LayeredScene layered{{.cast = 1, .receive = 2}};
};

TEST_F(LayeredSceneTest, FollowsEveryChangeOfTheWhole) {
    const CasterId first = add({0.0, 0.0, 0.0}, 1, 1), second = add({2.0, 0.0, 0.0}, 2, 2);
    update();
    const std::vector<InstanceItem>& seen = layered.snapshot().instances;
    EXPECT_TRUE(seen[0].casts && !seen[0].receives);
    EXPECT_TRUE(!seen[1].casts && seen[1].receives);
    expect_whole("made");
    store.set_transform(second, at({5.0, 0.0, 0.0}));
    update();
    EXPECT_EQ(seen[1].bounds_ws.max.x, 6.0);
    EXPECT_FALSE(seen[1].casts);
    expect_whole("moved");
    store.set_caster(first, {.mesh = mesh, .cast_layers = 2});
    update();
    EXPECT_FALSE(seen[0].casts);
    expect_whole("set");
    store.set_transform(second, at({6.0, 0.0, 0.0}));
    store.update(cameras);  // it does not see this one
    store.set_transform(first, at({7.0, 0.0, 0.0}));
    update();
    expect_whole("after a frame that was left out");
    store.remove(first);
    update();
    ASSERT_EQ(seen.size(), 1u);
    expect_whole("removed");
}

TEST_F(LayeredSceneTest, ViewsAreAlikeWhereNoCasterTellsThem) {
    add({0.0, 0.0, 0.0}, 1, 1);
    const CasterId second = add({2.0, 0.0, 0.0}, 3, 1);
    update();
    LayersInUse in_use;
    in_use.update(store.snapshot());
    EXPECT_TRUE(in_use.are_alike({}, {.cast = 1, .receive = 1}));
    EXPECT_TRUE(in_use.are_alike({.cast = 4, .receive = 4}, {.cast = 8, .receive = 8})) << "both see none";
    EXPECT_FALSE(in_use.are_alike({.cast = 2, .receive = 1}, {.cast = 1, .receive = 1}));
    EXPECT_FALSE(in_use.are_alike({.cast = 1, .receive = 2}, {.cast = 1, .receive = 1}));
    EXPECT_FALSE(in_use.are_alike({}, {.cast = 2}));
    store.set_caster(second, {.mesh = mesh, .casts = false});
    update();
    in_use.update(store.snapshot());
    EXPECT_TRUE(in_use.are_alike({.cast = 2, .receive = 1}, {.cast = 4, .receive = 1})) << "what casts nothing does not count";
}

}  // namespace
}  // namespace gnomon::embed
