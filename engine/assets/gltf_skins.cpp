#include "engine/assets/gltf_skins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_error.h"
#include "engine/math/shape_tree.h"
#include "engine/mesh/deformer.h"
#include "engine/mesh/mesh_shape.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMatrixNumbers = 16;

std::vector<glm::dmat4x3> inverse_bind_of(Document& document, const json& raw, std::size_t joints,
                                          const std::string& where) {
    const std::int32_t index = raw.value("inverseBindMatrices", kNone);
    if (index == kNone) return std::vector<glm::dmat4x3>(joints, glm::dmat4x3(1.0));
    const std::string at = where + "/inverseBindMatrices";
    const auto& accessor = document.model.accessors[static_cast<std::size_t>(index)];
    if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fail("skin.inverse_bind_type", at, "must be MAT4 of floats");
    if (accessor.count < joints) fail("skin.inverse_bind_count", at, "holds fewer matrices than there are joints");
    document.charge(joints * sizeof(glm::dmat4x3), at);
    const std::vector<float> numbers = read_floats(document, index);
    std::vector<glm::dmat4x3> matrices(joints);
    for (std::size_t j = 0; j < joints; ++j)
        for (std::size_t column = 0; column < 4; ++column) {
            const float* from = numbers.data() + kMatrixNumbers * j + 4 * column;
            matrices[j][static_cast<int>(column)] = {from[0], from[1], from[2]};
            if (from[3] != (column == 3 ? 1.0f : 0.0f)) document.warn(at + ": last rows count as 0 0 0 1");
        }
    return matrices;
}

class SkinLoader {
public:
    SkinLoader(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene)
        : document_(document),
          scene_nodes_(scene_nodes),
          scene_(scene),
          placed_(scene.meshes.size(), false),
          still_(scene.meshes.size(), kNone) {}

    void load() {
        const json skins = document_.json.value("skins", json::array());
        for (std::size_t s = 0; s < skins.size(); ++s) scene_.skins.push_back(skin_of(skins[s], pointer("skins", s)));
        for (std::size_t n = 0; n < scene_nodes_.size(); ++n)
            if (scene_nodes_[n] != kNone) bend(document_.json["nodes"][n], scene_nodes_[n], pointer("nodes", n));
    }

private:
    /// Reads a skin; without joints if some joints are not in the scene.
    Skin skin_of(const json& raw, const std::string& where) {
        Skin skin;
        skin.name = raw.contains("name") && raw["name"].is_string() ? raw["name"].get<std::string>() : "";
        const json& joints = raw["joints"];
        if (joints.empty()) document_.take("skin.no_joints", where + "/joints", "is empty; meshes stay as they are");
        document_.charge(joints.size() * sizeof(std::int32_t), where + "/joints");
        for (const json& joint : joints) skin.joints.push_back(scene_nodes_[joint.get<std::size_t>()]);
        skin.inverse_bind = inverse_bind_of(document_, raw, skin.joints.size(), where);
        if (std::find(skin.joints.begin(), skin.joints.end(), kNone) != skin.joints.end()) skin.joints.clear();
        return skin;
    }

    void bend(const json& raw, std::int32_t index, const std::string& where) {
        Node& node = scene_.nodes[static_cast<std::size_t>(index)];
        if (node.mesh == kNone) return;
        const std::shared_ptr<const Deformer> deformer = scene_.meshes[static_cast<std::size_t>(node.mesh)].deformer;
        std::int32_t skin = raw.value("skin", kNone);
        if (skin != kNone && (!deformer || !deformer->has_skin())) {
            document_.warn(where + "/skin: left out, the mesh follows no joints");
            skin = kNone;
        }
        if (skin != kNone && scene_.skins[static_cast<std::size_t>(skin)].joints.empty()) {
            document_.warn(where + "/skin: left out, the scene does not reach all of its joints");
            skin = kNone;
        }
        if (!deformer) return;
        if (skin != kNone) check_joints(*deformer, scene_.skins[static_cast<std::size_t>(skin)], where);
        const json& mesh_raw = document_.json["meshes"][static_cast<std::size_t>(node.mesh)];
        node.skin = skin;
        node.mesh = own_mesh(node.mesh, skin != kNone, where);
        if (!deformer->targets.empty()) node.morph_weights = weights_of(raw, mesh_raw, deformer->targets.size(), where);
    }

    static void check_joints(const Deformer& deformer, const Skin& skin, const std::string& where) {
        if (deformer.joint_bounds_ms.size() > skin.joints.size())
            fail("skin.joint_out_of_range", where + "/skin",
                 "the mesh follows joint " + std::to_string(deformer.joint_bounds_ms.size() - 1) + " of " +
                     std::to_string(skin.joints.size()));
    }

    /// Returns a mesh that only this node uses, or the rigid copy that nodes share.
    std::int32_t own_mesh(std::int32_t mesh, bool skinned, const std::string& where) {
        const auto at = static_cast<std::size_t>(mesh);
        const bool still = !skinned && scene_.meshes[at].deformer->targets.empty();
        if (still && still_[at] != kNone) return still_[at];
        if (!still && skinned == scene_.meshes[at].deformer->has_skin() && !placed_[at]) {
            placed_[at] = true;
            return mesh;
        }
        Mesh copy = scene_.meshes[at];
        document_.charge(copy.vertices.size() * sizeof(Vertex) + copy.indices.size() * sizeof(std::uint32_t), where);
        if (still) {
            copy.deformer = nullptr;
            copy.shape = shape_of(copy);
            if (copy.shape) document_.charge(copy.shape->bytes(), where);
            still_[at] = static_cast<std::int32_t>(scene_.meshes.size());
        } else if (!skinned && copy.deformer->has_skin()) {
            copy.deformer = without_skin(*copy.deformer, where);
        }
        scene_.meshes.push_back(std::move(copy));
        return static_cast<std::int32_t>(scene_.meshes.size() - 1);
    }

    std::shared_ptr<const Deformer> without_skin(Deformer deformer, const std::string& where) {
        for (const Deformer::Target& target : deformer.targets)
            document_.charge((target.positions.size() + target.normals.size()) * sizeof(glm::vec3), where);
        deformer.first_influence.clear();
        deformer.influences.clear();
        deformer.joint_bounds_ms.clear();
        return std::make_shared<const Deformer>(std::move(deformer));
    }

    /// Returns the node's own weights, otherwise its mesh's, otherwise 0.
    std::vector<float> weights_of(const json& node, const json& mesh, std::size_t targets, const std::string& where) {
        std::vector<float> weights;
        const json& from = node.contains("weights") ? node : mesh;
        if (from.contains("weights"))
            for (const json& weight : from["weights"]) weights.push_back(finite(weight.get<double>(), where));
        if (!weights.empty() && weights.size() != targets)
            document_.warn(where + ": weights are not as many as morph targets; those missing are 0");
        weights.resize(targets, 0.0f);
        return weights;
    }

    static float finite(double weight, const std::string& where) {
        if (!(std::abs(weight) <= static_cast<double>(std::numeric_limits<float>::max())))
            fail("node.not_finite", where, "a weight is beyond the range of float");
        return static_cast<float>(weight);
    }

    Document& document_;
    const std::vector<std::int32_t>& scene_nodes_;
    SceneData& scene_;
    std::vector<bool> placed_;         // per glTF mesh: a node uses it exclusively
    std::vector<std::int32_t> still_;  // per glTF mesh: its rigid copy
};

}  // namespace

void load_skins(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene) {
    SkinLoader(document, scene_nodes, scene).load();
}

}  // namespace gnomon::assets::gltf
