#include "systems/shadow/passes/depth_draws.h"

#include <algorithm>
#include <utility>

#include "systems/extract/depth_runs.h"

namespace gnomon::shadow {
namespace {

/// Returns true if the point is out of the box; false if it has a NaN.
bool is_outside(const math::Aabb& box, const glm::dvec3& point) {
    return point.x < box.min.x || point.y < box.min.y || point.z < box.min.z || point.x > box.max.x ||
           point.y > box.max.y || point.z > box.max.z;
}

/// Returns the faces to be drawn of an opaque caster. From outside a solid, the nearest surface is always a front face,
/// so that one side is enough. From inside, there are only back faces. With the light in the caster's bounds, it may be
/// on either side, so that nothing is culled.
DrawnFaces faces_of(const InstanceItem& item, const DepthDraws::Way& way, bool solid) {
    if (!solid || !way.culls || way.sheets || item.winding.folded) return DrawnFaces::both;
    if (!way.parallel && !is_outside(item.bounds_ws, way.apex_ws_m)) return DrawnFaces::both;
    return item.winding.mirrored ? DrawnFaces::one_side_mirrored : DrawnFaces::one_side;
}

bool same_buffers(const EngineMesh& a, const EngineMesh& b) {
    return a.vertices == b.vertices && a.indices == b.indices && a.layout == b.layout;
}

/// Returns the mesh that a caster is drawn as: its own where the device has no room for the proxy.
std::uint32_t drawn_mesh(const SceneSnapshot& scene, const GpuScene& gpu, const DepthDraws::Casters& casters,
                         std::size_t i) {
    const std::uint32_t own = scene.instances[casters.instances[i]].mesh;
    if (casters.meshes.empty() || gpu.depth_facts(casters.meshes[i]).draws == 0) return own;
    return casters.meshes[i];
}

}  // namespace

void DepthDraws::clear() {
    items_.clear();
    records_.clear();
    batches_.clear();
    first_batch_ = 0;
    saved_ = open_saved_ = 0;
}

void DepthDraws::add(const SceneSnapshot& scene, const GpuScene& gpu, const Way& way, const Casters& casters) {
    const std::span<const std::uint32_t> all = casters.instances;
    const auto place_of = [&](std::size_t i) { return casters.layers.empty() ? 0u : casters.layers[i]; };
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        const InstanceItem& item = scene.instances[all[first]];
        const std::uint32_t mesh = drawn_mesh(scene, gpu, casters, first);
        for (end = first + 1; end < all.size() && drawn_mesh(scene, gpu, casters, end) == mesh;) ++end;
        const MeshDepthFacts& facts = gpu.depth_facts(mesh);
        if (facts.draws == 0) continue;
        if (mesh != item.mesh)
            for (std::size_t i = first; i < end; ++i)
                open_saved_ += gpu.mesh(scene.instances[all[i]].mesh).triangles - gpu.mesh(mesh).triangles;
        if (end - first == 1 && facts.index_count > 0) {  // the usual case by far where there are many draws
            const std::uint32_t triangle = way.triangles ? facts.first_index / 3 : 0;
            opaque_[static_cast<std::size_t>(faces_of(item, way, facts.solid))].push_back(
                {facts.index_count, 1, facts.first_index, facts.base_vertex,
                 static_cast<std::uint32_t>(items_.size())});
            items_.push_back({item.gpu_slot, place_of(first) | triangle << kLayerBits});
            continue;
        }
        add_several(scene, gpu, way, casters.part(first, end), mesh);
    }
}

/// Adds casters of one mesh, in any number of draws. Casters with the same faces drawn become neighbours.
void DepthDraws::add_several(const SceneSnapshot& scene, const GpuScene& gpu, const Way& way, const Casters& run,
                             std::uint32_t mesh) {
    const MeshDepthFacts& facts = gpu.depth_facts(mesh);
    const auto count = static_cast<std::uint32_t>(run.instances.size());
    faces_.clear();
    for (const std::uint32_t i : run.instances) faces_.push_back(faces_of(scene.instances[i], way, facts.solid));
    order_.clear();
    std::array<std::uint32_t, kDrawnFaces> ends{};
    for (std::size_t faces = 0; faces < kDrawnFaces; ++faces) {
        for (std::uint32_t i = 0; i < count; ++i)
            if (faces_[i] == static_cast<DrawnFaces>(faces)) order_.push_back(i);
        ends[faces] = static_cast<std::uint32_t>(order_.size());
    }
    auto first_item = static_cast<std::uint32_t>(items_.size());
    bool has_items = false;
    for_each_depth_run(gpu, mesh, [&](const DepthRun& draw) {
        if (draw.mask && way.sheets) return;
        if (way.triangles || !has_items) {
            first_item = static_cast<std::uint32_t>(items_.size());
            add_items(scene, run, !way.triangles ? 0 : draw.engine ? kNoTriangle : draw.first_index / 3);
            has_items = true;
        }
        const std::int32_t base_vertex = draw.engine ? draw.engine->base_vertex : facts.base_vertex;
        const gl::MeshDrawRecord whole{draw.index_count, count, draw.first_index, base_vertex, first_item};
        if (draw.mask) return masked_.push_back({draw.mask, whole, static_cast<std::uint32_t>(masked_.size())});
        if (draw.engine) return engines_.push_back({draw.engine, whole});
        for (std::size_t faces = 0, from = 0; faces < kDrawnFaces; from = ends[faces++]) {
            if (ends[faces] == from) continue;
            gl::MeshDrawRecord part = whole;
            part.item_count = ends[faces] - static_cast<std::uint32_t>(from);
            part.first_item += static_cast<std::uint32_t>(from);
            opaque_[faces].push_back(part);
        }
    });
}

/// Adds an item per caster of a mesh, by order_.
void DepthDraws::add_items(const SceneSnapshot& scene, const Casters& run, std::uint32_t first_triangle) {
    for (const std::uint32_t i : order_) {
        const std::uint32_t layer = run.layers.empty() ? 0 : run.layers[i];
        items_.push_back({scene.instances[run.instances[i]].gpu_slot, layer | first_triangle << kLayerBits});
    }
}

DepthDraws::Batch& DepthDraws::begin_batch(DrawnFaces faces) {
    Batch& batch = batches_.emplace_back();
    batch.faces = faces;
    batch.draws.first = static_cast<std::uint32_t>(records_.size());
    return batch;
}

void DepthDraws::append(Batch& batch, std::span<const gl::MeshDrawRecord> records) {
    records_.insert(records_.end(), records.begin(), records.end());
    for (const gl::MeshDrawRecord& record : records) {
        batch.end_index = std::max(batch.end_index, std::uint64_t{record.first_index} + record.index_count);
        batch.end_item = std::max(batch.end_item, std::uint64_t{record.first_item} + record.item_count);
        batch.triangles += std::uint64_t{record.index_count} / 3 * record.item_count;
    }
    batch.draws.count += static_cast<std::uint32_t>(records.size());
}

IndexRange DepthDraws::end_group() {
    for (std::size_t faces = 0; faces < kDrawnFaces; ++faces) {
        if (opaque_[faces].empty()) continue;
        append(begin_batch(static_cast<DrawnFaces>(faces)), opaque_[faces]);
        opaque_[faces].clear();
    }
    std::sort(masked_.begin(), masked_.end(), [](const Masked& a, const Masked& b) {
        if (a.material != b.material) return a.material->uniform_offset < b.material->uniform_offset;
        return a.order < b.order;
    });
    for (std::size_t i = 0; i < masked_.size(); ++i) {
        const bool begins = i == 0 || masked_[i].material != masked_[i - 1].material;
        Batch& batch = begins ? begin_batch(DrawnFaces::both) : batches_.back();
        batch.mask = masked_[i].material;
        append(batch, {&masked_[i].record, 1});
    }
    masked_.clear();
    for (std::size_t i = 0; i < engines_.size(); ++i) {
        const bool begins = i == 0 || !same_buffers(*engines_[i].mesh, *engines_[i - 1].mesh);
        Batch& batch = begins ? begin_batch(DrawnFaces::both) : batches_.back();
        batch.engine = engines_[i].mesh;
        append(batch, {&engines_[i].record, 1});
    }
    engines_.clear();
    const auto end = static_cast<std::uint32_t>(batches_.size());
    const IndexRange range{first_batch_, end - first_batch_};
    first_batch_ = end;
    saved_ = std::exchange(open_saved_, 0);
    return range;
}

}  // namespace gnomon::shadow
