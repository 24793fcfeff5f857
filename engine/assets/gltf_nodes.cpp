#include "engine/assets/gltf_nodes.h"

#include <cmath>
#include <map>
#include <utility>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_extras.h"
#include "engine/assets/gltf_limits.h"
#include "engine/math/aabb.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

/// Parents of all nodes of the file; a second parent or a cycle is an error.
std::vector<int> parents_of(const Document& document) {
    const auto& nodes = document.model.nodes;
    std::vector<int> parents(nodes.size(), kNone);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t c = 0; c < nodes[i].children.size(); ++c) {
            int& parent = parents[static_cast<std::size_t>(nodes[i].children[c])];
            if (parent != kNone) {
                fail("node.second_parent", pointer("nodes", i, "children", c), "the child already has a parent");
            }
            parent = static_cast<int>(i);
        }
    }
    // With one parent each, a walk upward ends at a root or runs in a circle. Nodes seen by an earlier walk end it.
    std::vector<std::size_t> seen_by(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t walk = i + 1;
        for (int at = static_cast<int>(i); at != kNone; at = parents[static_cast<std::size_t>(at)]) {
            std::size_t& seen = seen_by[static_cast<std::size_t>(at)];
            if (seen == walk) fail("node.cycle", pointer("nodes", at), "is its own ancestor");
            if (seen != 0) break;
            seen = walk;
        }
    }
    return parents;
}

std::vector<int> roots_of(Document& document, const std::vector<int>& parents) {
    std::vector<int> roots;
    const auto scenes = document.json.find("scenes");
    if (scenes == document.json.end() || scenes->empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i) {
            if (parents[i] == kNone) roots.push_back(static_cast<int>(i));
        }
        return roots;
    }
    const auto index = document.json.value("scene", std::size_t{0});
    const json& scene = (*scenes)[index];
    const auto listed = scene.find("nodes");
    if (listed == scene.end()) return roots;
    for (std::size_t i = 0; i < listed->size(); ++i) {
        const auto root = (*listed)[i].get<std::size_t>();
        const std::string where = pointer("scenes", index, "nodes", i);
        // Widely used models do this; like other readers we show the node without what stands above it.
        if (parents[root] != kNone) document.warn(where + ": the node has a parent, which is left out");
        roots.push_back(static_cast<int>(root));
    }
    return roots;
}

Trs read_trs(const tinygltf::Node& source, const json& raw, const std::string& where) {
    if (!source.matrix.empty()) {
        for (const char* member : {"translation", "rotation", "scale"}) {
            if (raw.contains(member))
                fail("node.matrix_and_trs", where + "/matrix", "stands beside " + std::string{member});
        }
        glm::dmat4 matrix(1.0);
        for (std::size_t i = 0; i < 16; ++i) {
            matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = source.matrix[i];
        }
        return decompose(matrix, where + "/matrix");
    }
    Trs trs;
    if (!source.translation.empty()) {
        trs.translation_m = {source.translation[0], source.translation[1], source.translation[2]};
    }
    if (!source.scale.empty()) trs.scale = {source.scale[0], source.scale[1], source.scale[2]};
    if (!source.rotation.empty()) {
        const glm::dquat rotation(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
        const double length = glm::length(rotation);
        if (!(length > 0.0) || !std::isfinite(length)) {
            fail("node.rotation", where + "/rotation", "is no rotation: its length is 0 or not finite");
        }
        trs.rotation = rotation / length;
    }
    return trs;
}

class NodeLoader {
public:
    NodeLoader(Document& document, SceneData& scene)
        : document_(document), scene_(scene), became_(document.model.nodes.size(), kNone) {}

    std::vector<std::int32_t> load(const std::vector<int>& roots) {
        std::vector<Pending> pending;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, kNone, 1});
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            if (next.depth > kMaxNodeDepth) {
                fail("node.too_deep", pointer("nodes", next.source),
                     "more than " + std::to_string(kMaxNodeDepth) + " levels deep");
            }
            const auto index = static_cast<std::int32_t>(scene_.nodes.size());
            append(next.source, next.parent);
            const auto& children = document_.model.nodes[static_cast<std::size_t>(next.source)].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child) {
                pending.push_back({*child, index, next.depth + 1});
            }
        }
        return std::move(became_);
    }

private:
    struct Pending {
        int source = 0;
        std::int32_t parent = kNone;
        std::size_t depth = 0;
    };

    void append(int source_index, std::int32_t parent) {
        const auto at = static_cast<std::size_t>(source_index);
        if (became_[at] != kNone) fail("scene.node_twice", pointer("nodes", at), "the scene reaches the node twice");
        became_[at] = static_cast<std::int32_t>(scene_.nodes.size());
        const tinygltf::Node& source = document_.model.nodes[at];
        const json& raw = document_.json["nodes"][at];
        const std::string where = pointer("nodes", at);
        const Trs trs = read_trs(source, raw, where);
        Node node;
        node.name = source.name;
        node.parent = parent;
        node.translation_m = trs.translation_m;
        node.rotation = trs.rotation;
        node.scale = trs.scale;
        node.mesh = source.mesh;
        node.camera = source.camera;
        const ExtrasReader extras(document_, raw, where);
        node.casts_shadow = extras.boolean("castShadow", true);
        node.receives_shadow = extras.boolean("receiveShadow", true);
        node.visible = extras.boolean("visible", true);
        node.motion = extras.motion();
        node.light = light_of(raw, extras);
        check_world(trs, node, where);
        scene_.nodes.push_back(std::move(node));
    }

    std::int32_t light_of(const json& raw, const ExtrasReader& extras) {
        const json::json_pointer path("/extensions/KHR_lights_punctual/light");
        if (!raw.contains(path)) return kNone;
        const auto light = raw.at(path).get<std::size_t>();
        const bool own = scene_.lights[light].casts_shadow;
        const bool wanted = extras.boolean("shadow", own);
        if (wanted == own) return static_cast<std::int32_t>(light);
        const auto [entry, is_new] = variants_.try_emplace(light, static_cast<std::int32_t>(scene_.lights.size()));
        if (is_new) {
            LightData variant = scene_.lights[light];
            variant.casts_shadow = wanted;
            scene_.lights.push_back(std::move(variant));
        }
        return entry->second;
    }

    void check_world(const Trs& trs, const Node& node, const std::string& where) {
        glm::dmat4 world = matrix_of(trs);
        if (node.parent != kNone) world = worlds_[static_cast<std::size_t>(node.parent)] * world;
        worlds_.push_back(world);
        const glm::dvec3 origin(world[3]);
        math::Aabb bounds{origin, origin};
        if (node.mesh != kNone) {
            const math::Aabb& mesh = scene_.meshes[static_cast<std::size_t>(node.mesh)].bounds_ms;
            if (!math::is_empty(mesh)) bounds = math::transformed(mesh, glm::dmat3(world), origin);
        }
        for (int i = 0; i < 3; ++i) {
            const bool inside = bounds.min[i] >= -kMaxPosition_ws_m && bounds.max[i] <= kMaxPosition_ws_m;
            if (!inside) fail("node.out_of_world", where, "reaches beyond 1e10 m");
        }
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                if (!std::isfinite(world[i][k])) fail("node.not_finite", where, "its world matrix is not finite");
            }
        }
    }

    Document& document_;
    SceneData& scene_;
    std::vector<std::int32_t> became_;              // per glTF node
    std::vector<glm::dmat4> worlds_;                // of scene_.nodes
    std::map<std::size_t, std::int32_t> variants_;  // light -> its copy with the other casts_shadow
};

}  // namespace

std::vector<std::int32_t> load_nodes(Document& document, SceneData& scene) {
    const std::vector<int> parents = parents_of(document);
    return NodeLoader(document, scene).load(roots_of(document, parents));
}

}  // namespace gnomon::assets::gltf
