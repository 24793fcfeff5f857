#include "engine/assets/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <map>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_deformer.h"
#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_triangles.h"
#include "engine/assets/mesh_shape.h"
#include "engine/assets/mesh_topology.h"

namespace gnomon::assets::gltf {
namespace {

/// Primitives that share all of this share their vertices.
struct VertexSource {
    int position = kNone, normal = kNone, uv = kNone;  // accessors
    int material = kNone;                              // where it transforms texture coordinates, else kNone
    DeformingSource deforming;
    auto operator<=>(const VertexSource&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads <=>
};

struct VertexBlock {
    std::uint32_t first = 0, count = 0;
};

int attribute_of(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

/// glTF 2.0 table 3.7.2.1 and KHR_mesh_quantization table "extended attribute types".
bool is_allowed(const tinygltf::Accessor& accessor, int type, std::initializer_list<int> core, bool quantized) {
    if (accessor.type != type) return false;
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return true;
    if (std::find(core.begin(), core.end(), accessor.componentType) != core.end() && accessor.normalized) return true;
    return quantized && accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

class MeshLoader {
public:
    MeshLoader(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene)
        : document_(document),
          uv_sources_(uv_sources),
          scene_(scene),
          quantized_(document.uses_extension("KHR_mesh_quantization")) {}

    void load_all() {
        for (std::size_t i = 0; i < document_.model.meshes.size(); ++i) {
            scene_.meshes.push_back(load(i));
        }
    }

private:
    Mesh load(std::size_t index) {
        const tinygltf::Mesh& source = document_.model.meshes[index];
        Mesh mesh;
        mesh.name = source.name;
        blocks_.clear();
        missing_normals_.clear();
        DeformerBuilder deformer(document_);
        deformer_ = &deformer;
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            where_ = pointer("meshes", index, "primitives", p);
            const nlohmann::json& raw = document_.json["meshes"][index]["primitives"][p];
            append_primitive(source.primitives[p], raw.value("indices", kNone), mesh);
        }
        if (std::find(missing_normals_.begin(), missing_normals_.end(), true) != missing_normals_.end()) {
            fill_normals(mesh, missing_normals_);
        }
        for (const std::uint32_t vertex : mesh.indices) {
            const glm::dvec3 position{mesh.vertices[vertex].position_ms};
            mesh.bounds_ms.min = glm::min(mesh.bounds_ms.min, position);
            mesh.bounds_ms.max = glm::max(mesh.bounds_ms.max, position);
        }
        mesh.topology = analyse_topology(mesh);
        mesh.deformer = deformer.finish(mesh, pointer("meshes", index));
        if (!mesh.deformer) mesh.shape = shape_of(mesh);
        if (mesh.shape) document_.charge(mesh.shape->bytes(), pointer("meshes", index));
        return mesh;
    }

    void append_primitive(const tinygltf::Primitive& primitive, int index_accessor, Mesh& mesh) {
        if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            fail("primitive.mode", where_ + "/mode", "must lie between 0 and 6");
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            document_.warn(where_ + ": points and lines are left out");
            return;
        }
        const VertexBlock block = vertices_of(primitive, mesh);
        const std::size_t corner_count = index_accessor >= 0
                                             ? document_.model.accessors[static_cast<std::size_t>(index_accessor)].count
                                             : block.count;
        const std::size_t triangles = triangle_count(primitive.mode, corner_count);
        triangles_ += triangles;
        if (triangles_ > kMaxTriangles) fail("total.triangles", where_, "the scene has too many triangles");
        document_.charge(triangles * 3 * sizeof(std::uint32_t), where_);
        if (triangles == 0) {
            document_.warn(where_ + ": has no triangle");
            return;
        }
        std::vector<std::uint32_t> corners;
        if (index_accessor >= 0) corners = checked_indices(index_accessor, block.count);
        Submesh submesh;
        submesh.first_index = static_cast<std::uint32_t>(mesh.indices.size());
        submesh.index_count = static_cast<std::uint32_t>(triangles * 3);
        submesh.material = material_of(primitive);
        append_triangles(primitive.mode, corners, corner_count, block.first, mesh.indices);
        mesh.submeshes.push_back(submesh);
    }

    std::vector<std::uint32_t> checked_indices(int accessor, std::uint32_t vertex_count) const {
        std::vector<std::uint32_t> corners = read_indices(document_, accessor);
        for (const std::uint32_t corner : corners) {
            if (corner >= vertex_count) {
                fail("index.out_of_range", where_ + "/indices",
                     "index " + std::to_string(corner) + " of " + std::to_string(vertex_count) + " vertices");
            }
        }
        return corners;
    }

    std::uint32_t material_of(const tinygltf::Primitive& primitive) {
        if (primitive.material >= 0) return static_cast<std::uint32_t>(primitive.material);
        const std::size_t file_materials = document_.model.materials.size();
        if (scene_.materials.size() == file_materials) scene_.materials.emplace_back();  // the default material
        return static_cast<std::uint32_t>(file_materials);
    }

    VertexBlock vertices_of(const tinygltf::Primitive& primitive, Mesh& mesh) {
        VertexSource source;
        source.position = attribute_of(primitive, "POSITION");
        source.normal = attribute_of(primitive, "NORMAL");
        if (source.position < 0) fail("primitive.no_position", where_ + "/attributes", "POSITION is missing");
        const UvSource uv_source =
            primitive.material >= 0 ? uv_sources_[static_cast<std::size_t>(primitive.material)] : UvSource{};
        source.uv = attribute_of(primitive, "TEXCOORD_" + std::to_string(uv_source.set));
        if (uv_source.transform != UvSource{}.transform) source.material = primitive.material;
        source.deforming = deforming_source(document_, primitive, where_);
        const auto known = blocks_.find(source);
        if (known != blocks_.end()) return known->second;

        VertexBlock block{static_cast<std::uint32_t>(mesh.vertices.size()), 0};
        read_positions(source, mesh, block);
        read_normals(source, mesh, block);
        read_uvs(source.uv, uv_source.transform, mesh, block);
        deformer_->append(source.deforming, block.count, where_);
        blocks_.emplace(source, block);
        return block;
    }

    const tinygltf::Accessor& attribute(int accessor, const char* name, int type,
                                        std::initializer_list<int> core) const {
        const auto& found = document_.model.accessors[static_cast<std::size_t>(accessor)];
        if (!is_allowed(found, type, core, quantized_)) {
            fail("attribute.type", where_ + "/attributes/" + name,
                 "its accessor has a type that glTF does not allow here");
        }
        return found;
    }

    std::vector<float> same_count_floats(int accessor, const char* name, std::size_t count) const {
        if (document_.model.accessors[static_cast<std::size_t>(accessor)].count != count) {
            fail("attribute.count", where_ + "/attributes/" + name, "holds another number of elements than POSITION");
        }
        return read_floats(document_, accessor);
    }

    void read_positions(const VertexSource& source, Mesh& mesh, VertexBlock& block) {
        const auto& accessor = attribute(source.position, "POSITION", TINYGLTF_TYPE_VEC3, {});
        document_.charge(accessor.count * sizeof(Vertex), where_ + "/attributes/POSITION");
        block.count = static_cast<std::uint32_t>(accessor.count);
        const std::vector<float> numbers = read_floats(document_, source.position);
        mesh.vertices.resize(block.first + accessor.count);
        for (std::size_t i = 0; i < accessor.count; ++i) {
            const glm::vec3 position(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
            const glm::vec3 size = glm::abs(position);
            if (std::max({size.x, size.y, size.z}) > kMaxPosition_ms) {
                fail("position.too_large", where_ + "/attributes/POSITION", "a coordinate is beyond 1e6");
            }
            mesh.vertices[block.first + i].position_ms = position;
        }
    }

    void read_normals(const VertexSource& source, Mesh& mesh, const VertexBlock& block) {
        missing_normals_.resize(mesh.vertices.size(), source.normal < 0);
        if (source.normal < 0) return;
        attribute(source.normal, "NORMAL", TINYGLTF_TYPE_VEC3, {});
        const std::vector<float> numbers = same_count_floats(source.normal, "NORMAL", block.count);
        for (std::size_t i = 0; i < block.count; ++i) {
            const glm::dvec3 normal(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
            const double length = glm::length(normal);
            missing_normals_[block.first + i] = !(length > 0.0);
            if (length > 0.0) mesh.vertices[block.first + i].normal_ms = glm::vec3(normal / length);
        }
    }

    void read_uvs(int accessor, const glm::mat3x2& transform, Mesh& mesh, const VertexBlock& block) {
        if (accessor < 0) return;
        attribute(accessor, "TEXCOORD", TINYGLTF_TYPE_VEC2,
                  {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT});
        const std::vector<float> numbers = same_count_floats(accessor, "TEXCOORD", block.count);
        for (std::size_t i = 0; i < block.count; ++i) {
            const glm::vec2 uv = transform * glm::vec3(numbers[2 * i], numbers[2 * i + 1], 1.0f);
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
                fail("accessor.not_finite", where_, "a texture coordinate is not finite after its transform");
            }
            mesh.vertices[block.first + i].uv = uv;
        }
    }

    Document& document_;
    const std::vector<UvSource>& uv_sources_;
    SceneData& scene_;
    bool quantized_;
    std::size_t triangles_ = 0;
    std::string where_;
    std::map<VertexSource, VertexBlock> blocks_;  // of the mesh at hand
    std::vector<bool> missing_normals_;
    DeformerBuilder* deformer_ = nullptr;         // of the same mesh
};

}  // namespace

void load_meshes(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene) {
    MeshLoader(document, uv_sources, scene).load_all();
}

}  // namespace gnomon::assets::gltf
