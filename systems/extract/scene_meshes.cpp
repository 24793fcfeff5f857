#include "systems/extract/scene_meshes.h"

#include <algorithm>
#include <utility>

#include "systems/filled_buffer.h"

namespace gnomon {
namespace {

const DeviceArrays::Array kVertexArray{"scene vertices", sizeof(assets::Vertex), true};
const DeviceArrays::Array kColourArray{"vertex colours", sizeof(glm::vec4), true};
const DeviceArrays::Array kIndexArray{"scene indices", 3 * sizeof(std::uint32_t), false};
const DeviceArrays::Array kNormalArray{"triangle normals", sizeof(glm::vec4), true};
const DeviceArrays::Array kCasterArray{"caster triangles", sizeof(CasterTriangle), true};

std::vector<glm::vec4> plane_normals(const assets::MeshLibrary& library) {
    std::vector<glm::vec4> normals;
    for (const assets::Mesh& mesh : library.meshes) append_plane_normals(mesh.vertices, mesh.indices, normals);
    return normals;
}

/// Returns a colour per vertex of the library; empty if no mesh has colours.
std::vector<glm::vec4> vertex_colours(const assets::MeshLibrary& library) {
    std::vector<glm::vec4> colours;
    const bool any = std::any_of(library.meshes.begin(), library.meshes.end(),
                                 [](const assets::Mesh& mesh) { return !mesh.colours.empty(); });
    for (const assets::Mesh& mesh : library.meshes)
        if (any) append_colours(mesh, colours);
    return colours;
}

/// Returns the use of buffers with shapes: they change only if some mesh is deformable.
gl::BufferUse shape_use(const assets::MeshLibrary& library) {
    const bool bends = std::any_of(library.meshes.begin(), library.meshes.end(),
                                   [](const assets::Mesh& mesh) { return mesh.deformer != nullptr; });
    return bends ? gl::BufferUse::updated : gl::BufferUse::fixed;
}

}  // namespace

gl::Failure SceneMeshes::create(gl::Device& device, const assets::MeshLibrary& library) {
    device_ = &device;
    library_ = &library;
    vertex_arrays_ = DeviceArrays(device);
    triangle_arrays_ = DeviceArrays(device);
    mask_buffer_ = MaskBuffer(device, "caster masks");
    seen_ = library.version;
    std::vector<assets::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t m = 0; m < library.meshes.size(); ++m) {
        const assets::Mesh& mesh = library.meshes[m];
        add_range(m, static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(indices.size() / 3));
        const auto triangles = whole_triangles(mesh);
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        indices.insert(indices.end(), triangles.begin(), triangles.end());
    }
    const gl::BufferUse use = shape_use(library);
    gl::Failure failure = gl::Failure::none;
    const auto put = [&](DeviceArrays& arrays, std::size_t at, DeviceArrays::Array array, const auto& values,
                         gl::BufferUse how) {
        if (failure != gl::Failure::none) return;
        const auto made = filled_buffer(device, array.label, values, how, array.texels);
        failure = made.failure;
        array.buffer = made.handle;
        arrays.put(at, array);
    };
    put(vertex_arrays_, kVertices, kVertexArray, vertices, use);
    put(triangle_arrays_, kIndices, kIndexArray, indices, gl::BufferUse::fixed);
    put(triangle_arrays_, kNormals, kNormalArray, plane_normals(library), use);
    const std::vector<glm::vec4> colours = vertex_colours(library);
    if (!colours.empty()) put(vertex_arrays_, kColours, kColourArray, colours, gl::BufferUse::fixed);
    const auto places = static_cast<std::uint32_t>(vertices.size());
    const auto triangles = static_cast<std::uint32_t>(indices.size() / 3);
    vertex_arrays_.start(places, places, false);
    triangle_arrays_.start(triangles, triangles, false);
    return failure;
}

/// Writes down where a mesh lies. It has been placed.
void SceneMeshes::add_range(std::uint32_t m, std::uint32_t first_vertex, std::uint32_t first_triangle) {
    if (m >= ranges_.size()) {
        ranges_.resize(m + std::size_t{1});
        uploaded_.resize(m + std::size_t{1});
    }
    const assets::Mesh& mesh = library_->meshes[m];
    uploaded_[m] = {library_->version_of(m), first_vertex,       static_cast<std::uint32_t>(mesh.vertices.size()),
                    first_triangle,          triangles_of(mesh), true};
    MeshRange& range = ranges_[m];
    range = range_of(*library_, mesh);
    range.base_vertex = static_cast<std::int32_t>(first_vertex);
    range.first_index = 3 * first_triangle;
    range.first_submesh = submesh_places_.take(range.submesh_count);
    if (range.first_submesh == RangeList::kNone) {
        submesh_places_.resize(submesh_places_.end() + range.submesh_count);
        range.first_submesh = submesh_places_.take(range.submesh_count);
        submeshes_.resize(submesh_places_.places());
    }
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const assets::Submesh& submesh = mesh.submeshes[s];
        submeshes_[range.first_submesh + s] = {range.first_index + submesh.first_index, submesh.index_count,
                                               submesh.material};
    }
    if (mesh.deformer) bent_.insert(bent_at(m), Bent{m, 0, mesh.vertices, {}});
    changed_.push_back(m);
}

void SceneMeshes::put_engine_mesh(std::uint32_t mesh, const EngineMesh& of) {
    if (mesh >= engine_meshes_.size()) engine_meshes_.resize(mesh + std::size_t{1});
    if (mesh >= ranges_.size()) {
        ranges_.resize(mesh + std::size_t{1});
        uploaded_.resize(mesh + std::size_t{1});
    }
    take_away(mesh);  // what had the number before
    engine_meshes_[mesh] = of;
    ranges_[mesh] = {};
    ranges_[mesh].triangles = of.index_count / 3;
    if (of.index_count > 0) ranges_[mesh].most_reflected = most_reflected({});
    changed_.push_back(mesh);
}

std::vector<SceneMeshes::Bent>::iterator SceneMeshes::bent_at(std::uint32_t mesh) {
    return std::lower_bound(bent_.begin(), bent_.end(), mesh,
                            [](const Bent& bent, std::uint32_t wanted) { return bent.mesh < wanted; });
}

SceneMeshes::Bent* SceneMeshes::bent_of(std::uint32_t mesh) {
    const auto at = bent_at(mesh);
    return at != bent_.end() && at->mesh == mesh ? &*at : nullptr;
}

SceneMeshes::Shape SceneMeshes::shape(std::uint32_t mesh) const {
    const assets::Mesh& rest = library_->meshes[mesh];
    const std::uint64_t version = library_->version_of(mesh);
    const auto bent = std::lower_bound(bent_.begin(), bent_.end(), mesh,
                                       [](const Bent& b, std::uint32_t wanted) { return b.mesh < wanted; });
    if (bent == bent_.end() || bent->mesh != mesh) return {&rest.vertices, &rest.indices, 0, version};
    return {&bent->vertices, &rest.indices, bent->version, version};
}

/// Creates the buffer of colours, all white, with the first mesh that has some. Returns false without room for it.
bool SceneMeshes::provide_colours(const assets::Mesh& mesh, bool may_grow) {
    if (mesh.colours.empty() || colours()) return true;
    if (!may_grow) return false;
    const std::vector<glm::vec4> white(vertex_arrays_.places(), glm::vec4(1.0f));
    DeviceArrays::Array array = kColourArray;
    array.buffer = filled_buffer(*device_, array.label, white, gl::BufferUse::updated, array.texels).handle;
    vertex_arrays_.put(kColours, array);
    return static_cast<bool>(colours());
}

bool SceneMeshes::provide_caster_triangles() {
    if (caster_triangles() || !casters_retry_.due(++caster_calls_)) return static_cast<bool>(caster_triangles());
    std::vector<CasterTriangle> triangles(triangle_arrays_.places());
    RayMasks masks(*library_);
    for (std::uint32_t m = 0; m < uploaded_.size(); ++m) {
        if (!is_current(m)) continue;
        const std::span<const CasterTriangle> records = caster_records(m, masks);
        std::copy(records.begin(), records.end(), triangles.begin() + uploaded_[m].first_triangle);
    }
    const gl::BufferUse use = is_streaming_ ? gl::BufferUse::updated : shape_use(*library_);
    DeviceArrays::Array array = kCasterArray;
    array.buffer = filled_buffer(*device_, array.label, triangles, use, array.texels).handle;
    triangle_arrays_.put(kCasters, array);
    if (array.buffer && !masks.words().empty() && !mask_buffer_.make(masks.words(), !is_streaming_)) {
        device_->destroy(array.buffer);
        triangle_arrays_.put(kCasters, {});
    }
    if (!caster_triangles()) casters_retry_.failed(caster_calls_);
    for (Bent& bent : bent_)
        if (!caster_triangles()) bent.triangles = {};
    masks.forget_changes();
    masks_.reset();
    if (caster_triangles() && is_streaming_) masks_ = std::move(masks);
    if (!is_streaming_) caster_scratch_ = {};
    return static_cast<bool>(caster_triangles());
}

/// Returns the records of a placed mesh in its pose on the device. Valid until the next call.
std::span<const CasterTriangle> SceneMeshes::caster_records(std::uint32_t m, RayMasks& masks) {
    Bent* bent = bent_of(m);
    std::vector<CasterTriangle>& records = bent ? bent->triangles : caster_scratch_;
    records.clear();
    append_caster_triangles(*library_, m, uploaded_[m].first_triangle, masks, records);
    if (bent) put_corners(library_->meshes[m].indices, *bent);
    return records;
}

/// Writes the mesh's bent corners into its triangle records.
void SceneMeshes::put_corners(const std::vector<std::uint32_t>& indices, Bent& bent) {
    for (std::size_t i = 0; i < 3 * bent.triangles.size(); ++i)
        bent.triangles[i / 3].corners[i % 3].position_ms = bent.vertices[indices[i]].position_ms;
}

void SceneMeshes::upload(Bent& bent, gl::CommandList& list) {
    const Uploaded& uploaded = uploaded_[bent.mesh];
    const std::vector<std::uint32_t>& indices = library_->meshes[bent.mesh].indices;
    vertex_arrays_.write(kVertices, uploaded.first_vertex, std::span<const assets::Vertex>(bent.vertices), list);
    texel_scratch_.clear();
    append_plane_normals(bent.vertices, indices, texel_scratch_);
    triangle_arrays_.write(kNormals, uploaded.first_triangle, std::span<const glm::vec4>(texel_scratch_), list);
    if (!caster_triangles()) return;
    put_corners(indices, bent);
    triangle_arrays_.write(kCasters, uploaded.first_triangle, std::span<const CasterTriangle>(bent.triangles), list);
}

void SceneMeshes::update_poses(const SceneSnapshot& snapshot, gl::CommandList& list) {
    for (Bent& bent : bent_) {
        if (!is_current(bent.mesh)) continue;
        const PoseItem* pose = pose_of(snapshot, bent.mesh);
        const std::uint64_t wanted = pose ? pose->version : 0;
        if (bent.version == wanted) continue;
        if (pose)
            assets::deform(library_->meshes[bent.mesh], pose->pose(), bent.vertices);
        else
            bent.vertices = library_->meshes[bent.mesh].vertices;
        bent.version = wanted;
        upload(bent, list);
    }
}

}  // namespace gnomon
