#include <algorithm>
#include <utility>

#include "systems/extract/scene_meshes.h"

/// Meshes that come and go: their places and uploads, and repetition after a failure.
namespace gnomon {

void SceneMeshes::follow(const SceneMaterials& materials, gl::CommandList& list) {
    ++calls_;
    const bool had_casters = static_cast<bool>(caster_triangles());
    if (library_->version != seen_) note_changes();
    if (!waiting_.empty()) place_waiting(materials, list);
    if (is_streaming_) vertex_arrays_.shrink(list);
    if (is_streaming_) triangle_arrays_.shrink(list);
    for (const std::uint32_t m : unwritten_)
        if (uploaded_[m].placed) write(m, list);
    unconfirmed_.insert(unconfirmed_.end(), unwritten_.begin(), unwritten_.end());
    unwritten_.clear();
    if (masks_ && !mask_buffer_.follow(*masks_, list)) drop_casters();
    if (had_casters && !caster_triangles()) provide_caster_triangles();
}

/// Takes removed and replaced meshes away, and lists new ones.
void SceneMeshes::note_changes() {
    if (!is_streaming_) drop_casters();  // they are made again with room for changes
    is_streaming_ = true;
    seen_ = library_->version;
    uploaded_.resize(library_->meshes.size());
    ranges_.resize(library_->meshes.size());
    for (std::uint32_t m = 0; m < uploaded_.size(); ++m) {
        const std::uint64_t version = library_->version_of(m);
        const bool is_new = !uploaded_[m].placed && uploaded_[m].version == 0;  // pushed back by hand
        if (uploaded_[m].version == version && !is_new) continue;
        take_away(m);
        uploaded_[m].version = version;
        if (!library_->meshes[m].indices.empty()) waiting_.push_back(m);
    }
    std::sort(waiting_.begin(), waiting_.end());
}

void SceneMeshes::take_away(std::uint32_t m) {
    std::erase(waiting_, m);
    if (!uploaded_[m].placed) return;
    std::erase(unwritten_, m);
    std::erase(unconfirmed_, m);
    vertex_arrays_.give(uploaded_[m].first_vertex, uploaded_[m].vertices);
    triangle_arrays_.give(uploaded_[m].first_triangle, uploaded_[m].triangles);
    submesh_places_.give(ranges_[m].first_submesh, ranges_[m].submesh_count);
    if (masks_) masks_->forget(m);
    if (bent_of(m)) bent_.erase(bent_at(m));
    uploaded_[m] = {};
    ranges_[m] = {};
    changed_.push_back(m);
}

void SceneMeshes::place_waiting(const SceneMaterials& materials, gl::CommandList& list) {
    bool may_grow = room_retry_.due(calls_);
    if (may_grow) {
        std::uint64_t vertices = 0, triangles = 0;
        for (const std::uint32_t m : waiting_) {
            vertices += library_->meshes[m].vertices.size();
            triangles += triangles_of(library_->meshes[m]);
        }
        vertex_arrays_.reserve(vertices, list);
        triangle_arrays_.reserve(triangles, list);
    }
    std::erase_if(waiting_, [&](std::uint32_t m) {
        if (!has_materials(m, materials)) return false;
        if (place(m, may_grow, list)) return true;
        if (may_grow) room_retry_.failed(calls_);
        may_grow = false;  // one refusal per frame is enough
        return false;
    });
}

bool SceneMeshes::has_materials(std::uint32_t m, const SceneMaterials& materials) const {
    const std::vector<assets::Submesh>& submeshes = library_->meshes[m].submeshes;
    return std::all_of(submeshes.begin(), submeshes.end(),
                       [&](const assets::Submesh& submesh) { return materials.has(submesh.material); });
}

/// Takes places for a mesh. Returns false without room.
bool SceneMeshes::place(std::uint32_t m, bool may_grow, gl::CommandList& list) {
    const assets::Mesh& mesh = library_->meshes[m];
    const auto vertices = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::uint32_t first_vertex = vertex_arrays_.take(vertices, may_grow, list);
    if (first_vertex == DeviceArrays::kNone) return false;
    const std::uint32_t first_triangle = triangle_arrays_.take(triangles_of(mesh), may_grow, list);
    const bool is_placed = first_triangle != DeviceArrays::kNone && provide_colours(mesh, may_grow);
    if (!is_placed) {
        vertex_arrays_.give(first_vertex, vertices);
        if (first_triangle != DeviceArrays::kNone) triangle_arrays_.give(first_triangle, triangles_of(mesh));
        return false;
    }
    add_range(m, first_vertex, first_triangle);
    unwritten_.push_back(m);
    return true;
}

/// Records the upload of a placed mesh.
void SceneMeshes::write(std::uint32_t m, gl::CommandList& list) {
    const assets::Mesh& mesh = library_->meshes[m];
    const Uploaded& uploaded = uploaded_[m];
    const std::vector<assets::Vertex>& vertices = *shape(m).vertices;
    // Buffers that never grew hold all that was placed in them, and take no writes.
    if (vertex_arrays_.is_writable()) {
        vertex_arrays_.write(kVertices, uploaded.first_vertex, std::span<const assets::Vertex>(vertices), list);
        texel_scratch_.clear();
        if (colours()) append_colours(mesh, texel_scratch_);
        if (colours())
            vertex_arrays_.write(kColours, uploaded.first_vertex, std::span<const glm::vec4>(texel_scratch_), list);
    }
    if (!triangle_arrays_.is_writable()) return;
    triangle_arrays_.write(kIndices, uploaded.first_triangle, whole_triangles(mesh), list);
    texel_scratch_.clear();
    append_plane_normals(vertices, mesh.indices, texel_scratch_);
    triangle_arrays_.write(kNormals, uploaded.first_triangle, std::span<const glm::vec4>(texel_scratch_), list);
    if (caster_triangles()) triangle_arrays_.write(kCasters, uploaded.first_triangle, caster_records(m, *masks_), list);
}

void SceneMeshes::drop_casters() {
    triangle_arrays_.drop(kCasters);
    mask_buffer_.drop();
    masks_.reset();
    for (Bent& bent : bent_) bent.triangles = {};
}

void SceneMeshes::submitted(bool executed) {
    const bool moved = vertex_arrays_.moved() || triangle_arrays_.moved();
    vertex_arrays_.submitted();
    triangle_arrays_.submitted();
    mask_buffer_.submitted();
    if (!executed) {
        for (Bent& bent : bent_) bent.version = kUnknown;
        if (moved) unwritten_.clear();
        for (std::uint32_t m = 0; m < uploaded_.size() && moved; ++m)
            if (uploaded_[m].placed) unwritten_.push_back(m);
        if (!moved) unwritten_.insert(unwritten_.end(), unconfirmed_.begin(), unconfirmed_.end());
        if (is_streaming_) drop_casters();
        triangle_arrays_.submitted();
        mask_buffer_.submitted();
    }
    unconfirmed_.clear();
}

}  // namespace gnomon
