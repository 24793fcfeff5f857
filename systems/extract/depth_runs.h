#pragma once
#include <cstdint>

#include "systems/extract/gpu_scene.h"

namespace gnomon {

/// Indices that one draw of a depth pass reads.
struct DepthRun {
    std::uint32_t first_index = 0, index_count = 0;
    const GpuScene::MaterialInfo* mask = nullptr;  // material of a masked run; null: opaque
    const EngineMesh* engine = nullptr;            // mesh in other buffers; null: it is in the scene's
};

/// Calls `use(DepthRun)` for each draw of a mesh. Adjacent opaque submeshes are one draw, masked ones one each.
/// Translucent ones are left out.
template <class Use>
void for_each_depth_run(const GpuScene& gpu, std::uint32_t mesh, Use&& use) {
    if (const EngineMesh* engine = gpu.engine_mesh(mesh))
        return use(DepthRun{engine->first_index, engine->index_count, nullptr, engine});
    const GpuScene::MeshRange& range = gpu.mesh(mesh);
    DepthRun opaque;
    const auto flush = [&] {
        if (opaque.index_count > 0) use(opaque);
        opaque = {};
    };
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(range.first_submesh + s);
        const GpuScene::MaterialInfo& material = gpu.material(submesh.material);
        const bool solid = material.alpha_mode == assets::AlphaMode::opaque && !material.transmits;
        if (solid && opaque.index_count > 0 && opaque.first_index + opaque.index_count == submesh.first_index) {
            opaque.index_count += submesh.index_count;
            continue;
        }
        flush();
        if (solid) opaque = {submesh.first_index, submesh.index_count};
        if (material.alpha_mode == assets::AlphaMode::mask && !material.transmits)
            use(DepthRun{submesh.first_index, submesh.index_count, &material, nullptr});
    }
    flush();
}

}  // namespace gnomon
