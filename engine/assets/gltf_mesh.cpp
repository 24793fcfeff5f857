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
#include "engine/assets/openmesh_parts.h"
#include "engine/math/finite.h"
#include "engine/math/shape_tree.h"
#include "engine/mesh/inner_box.h"
#include "engine/mesh/mesh_shape.h"
#include "engine/mesh/mesh_topology.h"

namespace gnomon::assets::gltf {
namespace {

/// Accessors of a primitive's vertices. Primitives that share all of them share their vertices.
struct VertexSource {
    int position = kNone, normal = kNone, uv = kNone, colour = kNone;  // accessors
    int material = kNone;  // if it transforms texture coordinates, otherwise kNone
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

/// Tests an attribute's type (glTF 2.0, table 3.7.2.1; KHR_mesh_quantization, "extended attribute types").
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

    std::vector<MeshPlace> places() { return std::move(places_); }

private:
    Mesh load(std::size_t index) {
        const tinygltf::Mesh& source = document_.model.meshes[index];
        Mesh mesh;
        mesh.name = source.name;
        blocks_.clear();
        missing_normals_.clear();
        nowhere_.clear();
        DeformerBuilder deformer(document_);
        deformer_ = &deformer;
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            where_ = pointer("meshes", index, "primitives", p);
            const nlohmann::json& raw = document_.json["meshes"][index]["primitives"][p];
            append_primitive(source.primitives[p], raw.value("indices", kNone), mesh);
        }
        places_.push_back(place_of(source, mesh, pointer("meshes", index)));
        if (std::find(missing_normals_.begin(), missing_normals_.end(), true) != missing_normals_.end()) {
            fill_normals(mesh, missing_normals_);
        }
        for (const std::uint32_t vertex : mesh.indices) {
            const glm::dvec3 position{mesh.vertices[vertex].position_ms};
            mesh.bounds_ms.min = glm::min(mesh.bounds_ms.min, position);
            mesh.bounds_ms.max = glm::max(mesh.bounds_ms.max, position);
        }
        const bool all_white = std::all_of(mesh.colours.begin(), mesh.colours.end(),
                                           [](const glm::vec4& colour) { return colour == glm::vec4(1.0f); });
        if (all_white) mesh.colours = {};
        mesh.topology = analyse_topology(mesh, openmesh_parts);
        mesh.deformer = deformer.finish(mesh, pointer("meshes", index));
        if (!mesh.deformer) mesh.shape = shape_of(mesh);
        if (!mesh.deformer) mesh.inner_ms = inner_box(mesh);
        if (mesh.shape) document_.charge(mesh.shape->bytes(), pointer("meshes", index));
        return mesh;
    }

    /// Moves the mesh closer to its own origin if it lies too far away for floats.
    MeshPlace place_of(const tinygltf::Mesh& source, Mesh& mesh, const std::string& where) {
        MeshPlace place = near_origin(mesh);
        if (place == MeshPlace{}) return place;
        for (const tinygltf::Primitive& primitive : source.primitives) {
            if (primitive.targets.empty() && attribute_of(primitive, "JOINTS_0") < 0) continue;
            fail("position.too_large", where, "a coordinate of a mesh that bends is beyond 1e6");
        }
        document_.take("position.large", where, "coordinates are beyond 1e6, so it is kept nearer to its origin");
        return place;
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
        leave_out_nowhere(submesh, mesh);
        if (submesh.index_count > 0) mesh.submeshes.push_back(submesh);
    }

    void leave_out_nowhere(Submesh& submesh, Mesh& mesh) {
        const auto is_nowhere = [&](std::uint32_t corner) { return corner < nowhere_.size() && nowhere_[corner]; };
        std::size_t kept = submesh.first_index;
        for (std::size_t i = submesh.first_index; i < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            if (is_nowhere(a) || is_nowhere(b) || is_nowhere(c)) continue;
            mesh.indices[kept++] = a;
            mesh.indices[kept++] = b;
            mesh.indices[kept++] = c;
        }
        const std::size_t lost = (mesh.indices.size() - kept) / 3;
        if (lost == 0) return;
        mesh.indices.resize(kept);
        submesh.index_count = static_cast<std::uint32_t>(kept - submesh.first_index);
        document_.take("position.not_finite", where_ + "/attributes/POSITION",
                       std::to_string(lost) + " triangles with a corner that is no number are left out");
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
        if (scene_.materials.size() == file_materials) scene_.materials.emplace_back();  // default material
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
        if (uv_source.wanted && source.uv < 0)
            document_.warn(where_ + "/attributes: TEXCOORD_" + std::to_string(uv_source.set) +
                           " is missing, so the texture's first corner is taken");
        source.colour = attribute_of(primitive, "COLOR_0");
        if (uv_source.transform != UvSource{}.transform) source.material = primitive.material;
        source.deforming = deforming_source(document_, primitive, where_);
        const auto known = blocks_.find(source);
        if (known != blocks_.end()) return known->second;

        VertexBlock block{static_cast<std::uint32_t>(mesh.vertices.size()), 0};
        read_positions(source, mesh, block);
        read_normals(source, mesh, block);
        read_uvs(source.uv, uv_source.transform, mesh, block);
        read_colours(source.colour, mesh, block);
        deformer_->append(source.deforming, block.count, where_);
        blocks_.emplace(source, block);
        return block;
    }

    const tinygltf::Accessor& accessor_of(int accessor) const {
        return document_.model.accessors[static_cast<std::size_t>(accessor)];
    }

    /// Reads an optional attribute. Returns nothing, with a warning, if its accessor violates the specification.
    std::vector<float> optional_floats(int accessor, const char* name, bool is_right, std::size_t count,
                                       bool normalised = false) {
        const std::string where = where_ + "/attributes/" + name;
        if (!is_right) {
            document_.take("attribute.left_out", where,
                           "its accessor has a type that glTF does not allow here, left out");
            return {};
        }
        if (accessor_of(accessor).count != count) {
            document_.take("attribute.left_out", where, "holds another number of elements than POSITION, left out");
            return {};
        }
        const int view = accessor_of(accessor).bufferView;
        if (view >= 0 &&
            !document_
                 .buffers[static_cast<std::size_t>(document_.model.bufferViews[static_cast<std::size_t>(view)].buffer)]
                 .available) {
            document_.take("attribute.left_out", where, "its buffer has no data, left out");
            return {};
        }
        return read_any_floats(document_, accessor, normalised);
    }

    void warn_of_no_number(std::size_t count, const char* name, const char* taken_as) {
        if (count == 0) return;
        document_.take("attribute.not_finite", where_ + "/attributes/" + name,
                       std::to_string(count) + " that are no numbers are taken as " + taken_as);
    }

    void read_positions(const VertexSource& source, Mesh& mesh, VertexBlock& block) {
        const auto& accessor = accessor_of(source.position);
        if (!is_allowed(accessor, TINYGLTF_TYPE_VEC3, {}, quantized_)) {
            fail("attribute.type", where_ + "/attributes/POSITION",
                 "its accessor has a type that glTF does not allow here");
        }
        document_.charge(accessor.count * sizeof(Vertex), where_ + "/attributes/POSITION");
        block.count = static_cast<std::uint32_t>(accessor.count);
        const std::vector<float> numbers = read_any_floats(document_, source.position);
        mesh.vertices.resize(block.first + accessor.count);
        for (std::size_t i = 0; i < accessor.count; ++i) {
            const glm::vec3 position(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
            if (math::is_finite(position)) {
                mesh.vertices[block.first + i].position_ms = position;
                continue;
            }
            nowhere_.resize(mesh.vertices.size(), false);
            nowhere_[block.first + i] = true;
        }
    }

    void read_normals(const VertexSource& source, Mesh& mesh, const VertexBlock& block) {
        missing_normals_.resize(mesh.vertices.size(), true);
        if (source.normal < 0) return;
        const std::vector<float> numbers =
            optional_floats(source.normal, "NORMAL",
                            is_allowed(accessor_of(source.normal), TINYGLTF_TYPE_VEC3, {}, quantized_), block.count);
        std::size_t no_number = 0;
        for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
            const glm::dvec3 normal(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
            const double length = glm::length(normal);
            if (!std::isfinite(length)) ++no_number;
            if (!(length > 0.0) || !std::isfinite(length)) continue;
            missing_normals_[block.first + i] = false;
            mesh.vertices[block.first + i].normal_ms = glm::vec3(normal / length);
        }
        warn_of_no_number(no_number, "NORMAL", "missing");
    }

    void read_uvs(int accessor, const glm::mat3x2& transform, Mesh& mesh, const VertexBlock& block) {
        if (accessor < 0) return;
        const bool is_right =
            is_allowed(accessor_of(accessor), TINYGLTF_TYPE_VEC2,
                       {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}, quantized_);
        const std::vector<float> numbers = optional_floats(accessor, "TEXCOORD", is_right, block.count);
        std::size_t no_number = 0;
        for (std::size_t i = 0; 2 * i < numbers.size(); ++i) {
            const glm::vec2 uv = transform * glm::vec3(numbers[2 * i], numbers[2 * i + 1], 1.0f);
            if (std::isfinite(uv.x) && std::isfinite(uv.y))
                mesh.vertices[block.first + i].uv = uv;
            else
                ++no_number;
        }
        warn_of_no_number(no_number, "TEXCOORD", "0");
    }

    /// Reads colours. Once one primitive has colours the whole mesh has them; other vertices are white.
    void read_colours(int accessor, Mesh& mesh, const VertexBlock& block) {
        if (!mesh.colours.empty()) mesh.colours.resize(mesh.vertices.size(), glm::vec4(1.0f));
        if (accessor < 0) return;
        const auto& found = accessor_of(accessor);
        const bool floats = found.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool integers = found.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                              found.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        const bool is_right =
            (found.type == TINYGLTF_TYPE_VEC3 || found.type == TINYGLTF_TYPE_VEC4) && (floats || integers);
        if (is_right && integers && !found.normalized)
            document_.take("attribute.not_normalised", where_ + "/attributes/COLOR_0", "integers, taken as normalised");
        const std::vector<float> numbers = optional_floats(accessor, "COLOR_0", is_right, block.count, integers);
        if (numbers.empty()) return;
        const std::size_t had = mesh.colours.size();
        document_.charge((mesh.vertices.size() - had) * sizeof(glm::vec4), where_ + "/attributes/COLOR_0");
        mesh.colours.resize(mesh.vertices.size(), glm::vec4(1.0f));
        const std::size_t width = found.type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
        std::size_t no_number = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (std::isfinite(numbers[i]))
                mesh.colours[block.first + i / width][static_cast<int>(i % width)] = std::clamp(numbers[i], 0.0f, 1.0f);
            else
                ++no_number;
        }
        warn_of_no_number(no_number, "COLOR_0", "1");
    }

    Document& document_;
    const std::vector<UvSource>& uv_sources_;
    SceneData& scene_;
    bool quantized_;
    std::size_t triangles_ = 0;
    std::string where_;
    std::map<VertexSource, VertexBlock> blocks_;  // current mesh
    std::vector<bool> missing_normals_;
    std::vector<bool> nowhere_;  // vertices that are not finite; may be shorter
    std::vector<MeshPlace> places_;
    DeformerBuilder* deformer_ = nullptr;  // current mesh
};

}  // namespace

std::vector<MeshPlace> load_meshes(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene) {
    MeshLoader loader(document, uv_sources, scene);
    loader.load_all();
    return loader.places();
}

}  // namespace gnomon::assets::gltf
