#include "systems/extract/scene_tree.h"

namespace gnomon {

void build_tree(SceneSnapshot& scene) {
    scene.tree.build(static_cast<std::uint32_t>(scene.instances.size()),
                     [&scene](std::uint32_t i) { return scene.instances[i].bounds_ws; });
    scene.tree_version = scene.version;
}

void refit_tree(SceneSnapshot& scene) {
    for (const std::uint32_t i : scene.changed_instances) scene.tree.move(i, scene.instances[i].bounds_ws);
    scene.tree.refit();
    scene.tree_version = scene.version;
}

}  // namespace gnomon
