#include "systems/shadow/frame/instance_layers.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gnomon::shadow
