#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/deformer.h"
#include "engine/assets/gltf_document.h"

namespace gnomon::assets::gltf {

/// The accessors of a primitive that bend it. Primitives that share all attributes share their vertices.
struct DeformingSource {
    std::vector<std::array<int, 2>> sets;     // JOINTS_n and WEIGHTS_n
    std::vector<std::array<int, 2>> targets;  // POSITION and NORMAL, kNone where it has none
    auto operator<=>(const DeformingSource&) const = default;
};

/// Sets without weights, and the other way round, end the list with a warning.
DeformingSource deforming_source(Document& document, const tinygltf::Primitive& primitive, const std::string& where);

/// Gathers a mesh's Deformer, block of vertices by block, in order.
class DeformerBuilder {
public:
    explicit DeformerBuilder(Document& document) : document_(document) {}

    /// The next `count` vertices. Weights of a vertex are made to sum to 1; one without any follows its first joint.
    /// Throws Failure on accessors that glTF does not allow here.
    void append(const DeformingSource& source, std::size_t count, const std::string& where);

    /// Null if nothing bends the mesh, which has all its vertices now.
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
