#include "systems/shadow/frame/instance_layers.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/extract/scene_tree.h"
#include "systems/extract/splice_instances.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {
namespace {

SceneSnapshot scene_of(std::size_t instances) {
    SceneSnapshot scene;
    for (std::uint32_t i = 0; i < instances; ++i) {
        InstanceItem item;
        item.casts = i % 2 == 0;
        item.receives = i % 3 != 0;
        item.visible = i % 5 != 0;
        item.cast_layers = static_cast<ShadowLayers>(1u << i % 4);
        item.receive_layers = static_cast<ShadowLayers>(1u << i % 7);
        scene.instances.push_back(item);
    }
    scene.version = scene.list_version = 1;
    return scene;
}

void expect_of_each(const SceneSnapshot& scene, const InstanceLayers& layers) {
    for (ShadowLayers of_light = 0; of_light < 16; ++of_light) {
        LightItem light;
        light.shadow.layers = of_light;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
            const InstanceItem& item = scene.instances[i];
            EXPECT_EQ(layers.casts_under(light, i), casts_under(light, item)) << i;
            EXPECT_EQ(layers.shows_shadows_of(light, i), item.visible && receives_under(light, item)) << i;
        }
    }
}

TEST(InstanceLayers, AreThoseOfEachInstance) {
    InstanceLayers layers;
    for (const std::size_t count : {0u, 1u, 210u, 7u}) {
        const SceneSnapshot scene = scene_of(count);
        layers.update(scene);
        expect_of_each(scene, layers);
    }
}

TEST(InstanceLayers, AreReadAgainWhenTheListChangesOrIsNotCounted) {
    SceneSnapshot scene = scene_of(10);
    InstanceLayers layers;
    layers.update(scene);
    const auto change_and_update = [&](std::uint64_t list_version) {
        for (InstanceItem& item : scene.instances) item.casts = !item.casts;
        scene.list_version = list_version;
        layers.update(scene);
    };
    change_and_update(2);
    expect_of_each(scene, layers);
    for (int uncounted = 0; uncounted < 2; ++uncounted) {
        change_and_update(0);
        expect_of_each(scene, layers);
    }
    change_and_update(3);
    expect_of_each(scene, layers);
    change_and_update(3);
    LightItem light;
    light.shadow.layers = kAllShadowLayers;
    EXPECT_NE(layers.casts_under(light, 0), casts_under(light, scene.instances[0])) << "an unchanged list is not read";
}

TEST(InstanceLayers, FollowInstancesThatCameAndWentAndReadThoseAlone) {
    std::mt19937_64 random(print_seed());
    const auto below = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count)(random); };
    SceneSnapshot scene = scene_of(20);
    for (std::uint32_t i = 0; i < 20; ++i) scene.instances[i].entity = {3 * i, 0};
    build_tree(scene);
    InstanceLayers layers;
    layers.update(scene);
    InstanceSplice splice;
    for (int round = 0; round < 300; ++round) {
        ++scene.version;
        splice.clear();
        const std::size_t most = below(4);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (below(20) < most) splice.removed.push_back(i);
        const SceneSnapshot others = scene_of(below(6));
        std::uint32_t index = static_cast<std::uint32_t>(below(30));
        for (InstanceItem item : others.instances) {
            item.entity = {index, 1};
            item.cast_layers = static_cast<ShadowLayers>(1u << below(7));
            item.receive_layers = static_cast<ShadowLayers>(1u << below(7));
            index += 1u + static_cast<std::uint32_t>(below(30));
            splice.added.push_back(item);
        }
        splice_instances(scene, splice);
        layers.update(scene);
        InstanceLayers anew;
        anew.update(scene);
        for (ShadowLayers bit = 0; bit < 8; ++bit) {
            LightItem light;
            light.shadow.layers = static_cast<ShadowLayers>(1u << bit);
            ASSERT_EQ(layers.all_show_shadows_of(light), anew.all_show_shadows_of(light)) << round;
        }
        expect_of_each(scene, layers);
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(InstanceLayers, AreAllReadWhereMoreThanASpliceChangedTheList) {
    SceneSnapshot scene = scene_of(10);
    build_tree(scene);
    InstanceLayers layers, late;
    layers.update(scene);
    late.update(scene);
    const auto remove_first = [&] {
        ++scene.version;
        InstanceSplice splice;
        splice.removed = {0};
        splice_instances(scene, splice);
    };
    remove_first();
    scene.instances[2].casts = !scene.instances[2].casts;
    scene.renew_list();  // in the same version
    layers.update(scene);
    expect_of_each(scene, layers);
    remove_first();
    late.update(scene);  // the step before was not seen
    expect_of_each(scene, late);
    // A list that is no longer counted is read, whatever step came before.
    remove_first();
    scene.instances[2].casts = !scene.instances[2].casts;
    scene.renew_list();
    scene.list_version = 0;
    late.update(scene);
    expect_of_each(scene, late);
    scene.list_version = scene.version;
    late.update(scene);
    // The control: after a splice, changes of other instances are not read.
    remove_first();
    scene.instances[2].casts = !scene.instances[2].casts;
    late.update(scene);
    LightItem light;
    light.shadow.layers = kAllShadowLayers;
    EXPECT_NE(late.casts_under(light, 2), casts_under(light, scene.instances[2]));
}

}  // namespace
}  // namespace gnomon::shadow
