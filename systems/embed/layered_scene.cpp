#include "systems/embed/layered_scene.h"

#include "systems/extract/scene_tree.h"

namespace gnomon::embed {

void LayersInUse::update(const SceneSnapshot& scene) {
    if (scene.list_version == list_version_) return;
    list_version_ = scene.list_version;
    cast_.reset();
    receive_.reset();
    for (const InstanceItem& item : scene.instances) {
        if (item.casts) cast_.set(item.cast_layers);
        if (item.receives) receive_.set(item.receive_layers);
    }
}

bool LayersInUse::are_alike(const ViewLayers& a, const ViewLayers& b) const {
    if (a == b) return true;
    for (std::size_t set = 0; set < kSets; ++set) {
        if (cast_.test(set) && ((set & a.cast) != 0) != ((set & b.cast) != 0)) return false;
        if (receive_.test(set) && ((set & a.receive) != 0) != ((set & b.receive) != 0)) return false;
    }
    return true;
}

void LayeredScene::restrict_layers(InstanceItem& item) const {
    item.casts = item.casts && (item.cast_layers & layers_.cast) != 0;
    item.receives = item.receives && (item.receive_layers & layers_.receive) != 0;
}

void LayeredScene::update(const SceneSnapshot& whole, std::span<const ConsumerItem> consumers) {
    scene_.consumers.assign(consumers.begin(), consumers.end());
    if (scene_.version == whole.version) return;
    const bool is_next = scene_.version + 1 == whole.version && scene_.list_version == whole.list_version;
    scene_.lights = whole.lights;
    scene_.changed_instances = whole.changed_instances;
    scene_.version = whole.version;
    if (is_next) {
        for (const std::uint32_t i : whole.changed_instances) {
            scene_.instances[i] = whole.instances[i];
            restrict_layers(scene_.instances[i]);
        }
        return refit_tree(scene_);
    }
    scene_.instances = whole.instances;
    for (InstanceItem& item : scene_.instances) restrict_layers(item);
    scene_.gpu_slot_count = whole.gpu_slot_count;
    scene_.drawables = whole.drawables;
    scene_.air = whole.air;
    scene_.list_version = whole.list_version;
    scene_.meshes = whole.meshes;
    scene_.tree = whole.tree;
    scene_.tree_version = whole.tree_version;
}

}  // namespace gnomon::embed
