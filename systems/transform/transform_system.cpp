#include "systems/transform/transform_system.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "engine/math/aabb.h"
#include "engine/math/finite.h"

namespace gnomon {
namespace {

bool is_finite(const glm::dquat& q) {
    return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}

bool is_finite(const WorldTransform& w) { return math::is_finite(w.basis) && math::is_finite(w.translation_ws_m); }

// Compares bit by bit. Unlike ==, it distinguishes -0 from 0, so that readers of the change list have the registry's
// exact bits.
bool same_bits(const WorldTransform& a, const WorldTransform& b) {
    static_assert(sizeof(WorldTransform) == 12 * sizeof(double), "padding would make memcmp unreliable");
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): compares bits on purpose
    return std::memcmp(&a, &b, sizeof(WorldTransform)) == 0;
}

/// Converts a quaternion; nothing if it has no direction.
std::optional<glm::dmat3> rotation_matrix(const glm::dquat& q) {
    // Scaled first, because squares of very small or very large components leave the range of double.
    const double largest = std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    if (!(largest > 0.0)) return std::nullopt;
    const glm::dquat scaled(q.w / largest, q.x / largest, q.y / largest, q.z / largest);
    return glm::mat3_cast(scaled * (1.0 / std::sqrt(glm::dot(scaled, scaled))));
}

TransformFault local_matrix(const Transform& t, WorldTransform& local) {
    if (!math::is_finite(t.translation_m) || !is_finite(t.rotation) || !math::is_finite(t.scale))
        return TransformFault::not_finite;
    const std::optional<glm::dmat3> rotation = rotation_matrix(t.rotation);
    if (!rotation) return TransformFault::zero_rotation;
    for (int column = 0; column < 3; ++column) local.basis[column] = (*rotation)[column] * t.scale[column];
    local.translation_ws_m = t.translation_m;
    return TransformFault::none;
}

}  // namespace

const char* fault_code(TransformFault fault) {
    switch (fault) {
        case TransformFault::none:
            return "none";
        case TransformFault::not_finite:
            return "not_finite";
        case TransformFault::zero_rotation:
            return "zero_rotation";
        case TransformFault::parent_missing:
            return "parent_missing";
        case TransformFault::parent_cycle:
            return "parent_cycle";
    }
    return "unknown";
}

const TransformReport& TransformSystem::update(ecs::Registry& registry) {
    report_.evaluated = 0;
    report_.changed = 0;
    const ecs::Changes changes = registry.changes<Transform>(cursor_);
    if (changes.complete && changes.entries.empty()) return report_;

    ++pass_;
    affected_.clear();
    if (changes.complete) {
        for (const ecs::Change& change : changes.entries) take(registry, change.entity);
    } else {
        reread_all(registry);
    }
    spread_to_descendants();
    for (const std::uint32_t index : affected_) evaluate_with_ancestors(registry, index);
    report_.evaluated = static_cast<std::uint32_t>(affected_.size());
    refresh_quarantine();
    return report_;
}

void TransformSystem::reread_all(ecs::Registry& registry) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].entity != ecs::kNull) take(registry, nodes_[i].entity);
    }
    for (const ecs::Entity entity : registry.entities_with<Transform>()) take(registry, entity);
}

/// Updates the node of a changed entity, at most once per pass. The order of log entries does not matter.
void TransformSystem::take(ecs::Registry& registry, ecs::Entity entity) {
    const Transform* transform = registry.get<Transform>(entity);
    Node& node = node_at(entity.index);
    if (!transform && node.entity != entity) return;
    unlink(entity.index);
    if (!transform) {
        if (registry.alive(entity) && registry.remove<WorldTransform>(entity)) ++report_.changed;
        node.entity = ecs::kNull;
        node.parent = ecs::kNull;
        node.fault = TransformFault::none;
    } else {
        node.entity = entity;
        node.parent = transform->parent;
        // A dead parent never returns. A parent without Transform may get one later.
        if (registry.alive(node.parent)) link(entity.index, node.parent.index);
    }
    Node& taken = nodes_[entity.index];  // linking may have moved the nodes
    if (taken.pass == pass_) return;
    taken.pass = pass_;
    affected_.push_back(entity.index);
}

TransformSystem::Node& TransformSystem::node_at(std::uint32_t index) {
    if (index >= nodes_.size()) nodes_.resize(index + std::size_t{1});
    return nodes_[index];
}

const TransformSystem::Node* TransformSystem::parent_of(const Node& node) const {
    if (node.parent.index >= nodes_.size()) return nullptr;
    const Node& parent = nodes_[node.parent.index];
    return parent.entity == node.parent && parent.entity != ecs::kNull ? &parent : nullptr;
}

void TransformSystem::link(std::uint32_t index, std::uint32_t parent_index) {
    Node& parent = node_at(parent_index);
    Node& node = nodes_[index];
    node.linked_to = parent_index;
    node.previous_sibling = kNone;
    node.next_sibling = parent.first_child;
    if (parent.first_child != kNone) nodes_[parent.first_child].previous_sibling = index;
    parent.first_child = index;
}

void TransformSystem::unlink(std::uint32_t index) {
    Node& node = nodes_[index];
    if (node.linked_to == kNone) return;
    if (node.previous_sibling == kNone) {
        nodes_[node.linked_to].first_child = node.next_sibling;
    } else {
        nodes_[node.previous_sibling].next_sibling = node.next_sibling;
    }
    if (node.next_sibling != kNone) nodes_[node.next_sibling].previous_sibling = node.previous_sibling;
    node.linked_to = node.previous_sibling = node.next_sibling = kNone;
}

void TransformSystem::spread_to_descendants() {
    for (std::size_t i = 0; i < affected_.size(); ++i) {  // grows while it is read
        Node& node = nodes_[affected_[i]];
        node.progress = Progress::pending;
        for (std::uint32_t child = node.first_child; child != kNone; child = nodes_[child].next_sibling) {
            if (nodes_[child].pass == pass_) continue;
            nodes_[child].pass = pass_;
            affected_.push_back(child);
        }
    }
}

/// Climbs to the first settled ancestor, then evaluates downward. Visits each node once, without recursion, so that
/// neither entity order nor tree depth matters.
void TransformSystem::evaluate_with_ancestors(ecs::Registry& registry, std::uint32_t index) {
    path_.clear();
    while (nodes_[index].progress == Progress::pending) {
        nodes_[index].progress = Progress::on_path;
        path_.push_back(index);
        const Node* parent = parent_of(nodes_[index]);
        if (!parent) break;
        index = parent->entity.index;
        if (nodes_[index].progress == Progress::on_path) condemn_cycle(index);
    }
    for (; !path_.empty(); path_.pop_back()) evaluate(registry, nodes_[path_.back()]);
}

/// Marks a cycle. `member` is on the path, and its descendants lead back to it: the path from it to the end is the
/// cycle.
void TransformSystem::condemn_cycle(std::uint32_t member) {
    for (auto it = std::find(path_.begin(), path_.end(), member); it != path_.end(); ++it) {
        nodes_[*it].progress = Progress::in_cycle;
    }
}

void TransformSystem::evaluate(ecs::Registry& registry, Node& node) {
    const bool in_cycle = node.progress == Progress::in_cycle;
    node.progress = Progress::done;
    if (node.entity == ecs::kNull) return;
    WorldTransform world;
    if (in_cycle) {
        node.fault = TransformFault::parent_cycle;
        node.cause = node.entity;
    } else if (const Node* parent = parent_of(node); parent && parent->fault != TransformFault::none) {
        node.fault = parent->fault;
        node.cause = parent->cause;
    } else {
        node.fault = compose(registry, node, world);
        node.cause = node.entity;
    }
    if (node.fault != TransformFault::none) {
        if (registry.remove<WorldTransform>(node.entity)) ++report_.changed;
        return;
    }
    const WorldTransform* old = registry.get<WorldTransform>(node.entity);
    if (old && same_bits(*old, world)) return;
    registry.emplace<WorldTransform>(node.entity, world);
    ++report_.changed;
}

TransformFault TransformSystem::compose(const ecs::Registry& registry, const Node& node, WorldTransform& world) const {
    const TransformFault fault = local_matrix(*registry.get<Transform>(node.entity), world);
    if (fault != TransformFault::none) return fault;
    if (node.parent != ecs::kNull) {
        const Node* parent = parent_of(node);
        const WorldTransform* above = parent ? registry.get<WorldTransform>(parent->entity) : nullptr;
        if (!above) return TransformFault::parent_missing;
        world.translation_ws_m = above->basis * world.translation_ws_m + above->translation_ws_m;
        world.basis = above->basis * world.basis;
    }
    return is_finite(world) ? TransformFault::none : TransformFault::not_finite;
}

void TransformSystem::refresh_quarantine() {
    auto& list = report_.quarantined;
    std::erase_if(list, [&](const QuarantinedEntity& q) { return nodes_[q.entity.index].pass == pass_; });
    for (const std::uint32_t index : affected_) {
        const Node& node = nodes_[index];
        if (node.entity == ecs::kNull || node.fault == TransformFault::none) continue;
        list.push_back({node.entity, node.fault, node.cause});
    }
    const auto by_index = [](const auto& a, const auto& b) { return a.entity.index < b.entity.index; };
    std::sort(list.begin(), list.end(), by_index);
}

}  // namespace gnomon
