#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/mesh/deformer.h"

namespace gnomon::assets::gltf {

/// Accessors of a primitive that deform it. Primitives that share all attributes share their vertices.
struct DeformingSource {
    std::vector<std::array<int, 2>> sets;     // JOINTS_n and WEIGHTS_n
    std::vector<std::array<int, 2>> targets;  // POSITION and NORMAL; kNone if absent
    auto operator<=>(const DeformingSource&) const = default;
};

/// Reads the accessors of a primitive. A set of joints without weights, or the reverse, ends the list with a warning.
DeformingSource deforming_source(Document& document, const tinygltf::Primitive& primitive, const std::string& where);

/// Builds a mesh's Deformer from blocks of vertices, in order.
class DeformerBuilder {
public:
    explicit DeformerBuilder(Document& document) : document_(document) {}

    /// Appends the next `count` vertices. Normalises each vertex's weights to a sum of 1; a vertex without weights
    /// follows its first joint. Throws Failure on accessors that glTF does not allow here.
    void append(const DeformingSource& source, std::size_t count, const std::string& where);

    /// Returns the result for a mesh with all vertices; null if nothing deforms it.
    std::shared_ptr<const Deformer> finish(const Mesh& mesh, const std::string& where);

private:
    using Numbers = std::vector<std::vector<float>>;  // per set, four per vertex
    void fill_up(std::vector<glm::vec3>& part, const std::string& where);
    void append_plain(std::size_t count);
    void append_vertex(const Numbers& joints, const Numbers& weights, std::size_t vertex, const std::string& where);
    void append_joints(const DeformingSource& source, std::size_t count, const std::string& where);
    void append_target(std::size_t index, const std::array<int, 2>& source, std::size_t count,
                       const std::string& where);

    Document& document_;
    Deformer deformer_;
    bool skinned_ = false;
    std::size_t vertices_ = 0;
};

}  // namespace gnomon::assets::gltf
