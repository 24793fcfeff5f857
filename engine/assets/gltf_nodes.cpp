#include "engine/assets/gltf_nodes.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_extras.h"
#include "engine/assets/gltf_limits.h"
#include "engine/math/aabb.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

/// Returns the parents of all nodes of the file; a second parent or a cycle is an error.
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
    // With one parent each, a walk upward ends at a root or is a cycle. Nodes visited by an earlier walk end it.
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

/// Returns true if one of the nearest kMaxNodeDepth ancestors is a root. Deeper nodes are an error anyway.
bool stands_below(std::size_t node, const std::vector<bool>& is_root, const std::vector<int>& parents) {
    int at = parents[node];
    for (std::size_t depth = 0; at != kNone && depth < kMaxNodeDepth; ++depth) {
        if (is_root[static_cast<std::size_t>(at)]) return true;
        at = parents[static_cast<std::size_t>(at)];
    }
    return false;
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
    std::vector<bool> is_root(parents.size(), false);
    for (const json& root : *listed) is_root[root.get<std::size_t>()] = true;
    std::vector<bool> seen(parents.size(), false);
    for (std::size_t i = 0; i < listed->size(); ++i) {
        const auto root = (*listed)[i].get<std::size_t>();
        const std::string where = pointer("scenes", index, "nodes", i);
        if (seen[root] || stands_below(root, is_root, parents)) {
            document.take("scene.node_twice", where, "the scene reaches the node twice, it is shown once");
            continue;
        }
        seen[root] = true;
        // Widely used models do this. Like other loaders, the node is shown without its ancestors.
        if (parents[root] != kNone) document.warn(where + ": the node has a parent, which is left out");
        roots.push_back(static_cast<int>(root));
    }
    return roots;
}

/// Place of a node. `inner` is a rotation applied first, for a matrix with shear.
struct Place {
    Trs trs;
    std::optional<glm::dquat> inner = std::nullopt;
};

Place read_matrix(Document& document, const tinygltf::Node& source, const json& raw, const std::string& where) {
    for (const char* member : {"translation", "rotation", "scale"}) {
        if (raw.contains(member))
            document.take("node.matrix_and_trs", where, std::string{member} + " beside a matrix is left out");
    }
    glm::dmat4 matrix(1.0);
    for (std::size_t i = 0; i < 16; ++i) {
        matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = source.matrix[i];
    }
    expect_affine(matrix, document, where);
    if (const std::optional<Trs> trs = decompose(matrix, where)) return {*trs};
    const ShearedTrs sheared = decompose_sheared(matrix, where);
    document.take("node.matrix_sheared", where, "it shears, taken as two nodes, of which the outer one scales");
    return {sheared.outer, sheared.inner};
}

Place read_place(Document& document, const tinygltf::Node& source, const json& raw, const std::string& where) {
    if (!source.matrix.empty()) return read_matrix(document, source, raw, where + "/matrix");
    Trs trs;
    if (!source.translation.empty()) {
        trs.translation_m = {source.translation[0], source.translation[1], source.translation[2]};
    }
    if (!source.scale.empty()) trs.scale = {source.scale[0], source.scale[1], source.scale[2]};
    if (source.rotation.empty()) return {trs};
    const glm::dquat rotation(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
    const double length = glm::length(rotation);
    if (!std::isfinite(length)) fail("node.rotation", where + "/rotation", "is no rotation: its length is not finite");
    if (length > 0.0)
        trs.rotation = rotation / length;
    else
        document.take("node.rotation_zero", where + "/rotation", "has no length, taken as no turn");
    return {trs};
}

class NodeLoader {
public:
    NodeLoader(Document& document, const std::vector<std::int32_t>& cameras, const std::vector<MeshPlace>& places,
               SceneData& scene)
        : document_(document),
          cameras_(cameras),
          places_(places),
          scene_(scene),
          became_(document.model.nodes.size(), kNone) {}

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
            append(next.source, next.parent);
            const std::int32_t index = became_[static_cast<std::size_t>(next.source)];
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
        const tinygltf::Node& source = document_.model.nodes[at];
        const json& raw = document_.json["nodes"][at];
        const std::string where = pointer("nodes", at);
        const Place place = read_place(document_, source, raw, where);
        Node node;
        node.parent = parent;
        set(node, place.trs);
        if (place.inner) {
            add(std::exchange(node, Node{}), where);
            node.parent = static_cast<std::int32_t>(scene_.nodes.size()) - 1;
            node.rotation = *place.inner;
        }
        node.name = source.name;
        node.mesh = source.mesh;
        if (source.camera >= 0) node.camera = cameras_[static_cast<std::size_t>(source.camera)];
        const ExtrasReader extras(document_, raw, where);
        node.casts_shadow = extras.boolean("castShadow", true);
        node.receives_shadow = extras.boolean("receiveShadow", true);
        node.visible = extras.boolean("visible", true);
        node.shadow_catcher = extras.boolean("shadowCatcher", false);
        node.motion = extras.motion();
        node.light = light_of(raw, extras, where);
        became_[at] = static_cast<std::int32_t>(scene_.nodes.size());
        std::optional<Node> mesh_node;
        if (node.mesh != kNone && places_[static_cast<std::size_t>(node.mesh)] != MeshPlace{})
            mesh_node = take_mesh(node);
        add(std::move(node), where);
        if (mesh_node) add(std::move(*mesh_node), where);
    }

    /// Moves the mesh of `node` to a new node below it, which carries the mesh's place. Returns the new node.
    Node take_mesh(Node& node) const {
        const MeshPlace& place = places_[static_cast<std::size_t>(node.mesh)];
        Node below;
        below.name = node.name;
        below.parent = static_cast<std::int32_t>(scene_.nodes.size());
        below.translation_m = place.middle_m;
        below.scale = glm::dvec3(place.scale);
        below.mesh = std::exchange(node.mesh, kNone);
        below.casts_shadow = node.casts_shadow;
        below.receives_shadow = node.receives_shadow;
        below.visible = node.visible;
        below.shadow_catcher = node.shadow_catcher;
        return below;
    }

    static void set(Node& node, const Trs& trs) {
        node.translation_m = trs.translation_m;
        node.rotation = trs.rotation;
        node.scale = trs.scale;
    }

    void add(Node node, const std::string& where) {
        check_world({node.translation_m, node.rotation, node.scale}, node, where);
        scene_.nodes.push_back(std::move(node));
    }

    std::int32_t light_of(const json& raw, const ExtrasReader& extras, const std::string& where) {
        const json::json_pointer path("/extensions/KHR_lights_punctual/light"),
            area("/extensions/EXT_lights_area/light");
        if (!raw.contains(path) && !raw.contains(area)) return kNone;
        // Area lights follow those of KHR_lights_punctual: load_lights().
        const std::size_t light = raw.contains(path) ? raw.at(path).get<std::size_t>()
                                                     : document_.model.lights.size() + raw.at(area).get<std::size_t>();
        if (raw.contains(path) && raw.contains(area))
            document_.take("light.two", where, "has two lights, of which that of EXT_lights_area is left out");
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
    const std::vector<std::int32_t>& cameras_;  // index in scene_.cameras per glTF camera
    const std::vector<MeshPlace>& places_;      // per glTF mesh
    SceneData& scene_;
    std::vector<std::int32_t> became_;              // index in scene_.nodes per glTF node
    std::vector<glm::dmat4> worlds_;                // per node of scene_.nodes
    std::map<std::size_t, std::int32_t> variants_;  // light -> its copy with the opposite casts_shadow
};

}  // namespace

std::vector<std::int32_t> load_nodes(Document& document, const std::vector<std::int32_t>& cameras,
                                     const std::vector<MeshPlace>& places, SceneData& scene) {
    const std::vector<int> parents = parents_of(document);
    return NodeLoader(document, cameras, places, scene).load(roots_of(document, parents));
}

}  // namespace gnomon::assets::gltf
