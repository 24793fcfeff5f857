#pragma once
#include <cstdint>
#include <span>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Calls run(mesh, first, count) for each longest run of equal meshes in `items` (indices into scene.instances). Items
/// sorted by mesh give one run, hence one instanced draw, per mesh.
template <class Run>
void for_each_mesh_run(const SceneSnapshot& scene, std::span<const std::uint32_t> items, Run&& run) {
    std::uint32_t first = 0;
    while (first < items.size()) {
        const std::uint32_t mesh = scene.instances[items[first]].mesh;
        std::uint32_t end = first + 1;
        while (end < items.size() && scene.instances[items[end]].mesh == mesh) ++end;
        run(mesh, first, end - first);
        first = end;
    }
}

}  // namespace gnomon
