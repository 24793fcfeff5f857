#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/components.h"
#include "gnomon/registry.h"

namespace gnomon {

/// Reason why an entity has no place in the world.
enum class TransformFault : std::uint8_t {
    none,
    not_finite,      // its Transform or WorldTransform has a NaN or infinity
    zero_rotation,   // its quaternion has no direction
    parent_missing,  // its parent is dead or has no Transform
    parent_cycle     // it is its own ancestor
};
const char* fault_code(TransformFault fault);

/// Entity with a Transform, but without a WorldTransform until its fault is corrected.
struct QuarantinedEntity {
    ecs::Entity entity;
    TransformFault fault = TransformFault::none;
    ecs::Entity cause;  // the entity itself, or the ancestor with the fault
    bool operator==(const QuarantinedEntity&) const = default;
};

struct TransformReport {
    std::vector<QuarantinedEntity> quarantined;  // all current ones, sorted by entity index
    std::uint32_t evaluated = 0;                 // Transforms evaluated: changed ones and their descendants
    std::uint32_t changed = 0;                   // WorldTransforms added, changed or removed
};

/// Writes WorldTransform for every entity with a Transform. Skips values that stay the same bit for bit. An unchanged
/// scene thus makes no log entries, costs nothing and allocates nothing. A TransformSystem serves one registry, which
/// must be the same in every call.
class TransformSystem {
public:
    /// Reads Transform's change list. The cost is proportional to the changed entities and their descendants. Faulty
    /// entities and their descendants are quarantined until corrected; others are unaffected. The report is valid until
    /// the next call.
    const TransformReport& update(ecs::Registry& registry);

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    enum class Progress : std::uint8_t { done, pending, on_path, in_cycle };

    /// State of the entity with this index: its place in the tree, and its last result.
    struct Node {
        ecs::Entity entity;  // null: no Transform
        ecs::Entity parent;
        ecs::Entity cause;
        std::uint32_t linked_to = kNone;  // node with this one in its child list
        std::uint32_t first_child = kNone, next_sibling = kNone, previous_sibling = kNone;
        TransformFault fault = TransformFault::none;
        Progress progress = Progress::done;
        std::uint64_t pass = 0;  // last update that evaluated it
    };

    void reread_all(ecs::Registry& registry);
    void take(ecs::Registry& registry, ecs::Entity entity);
    Node& node_at(std::uint32_t index);
    const Node* parent_of(const Node& node) const;
    void link(std::uint32_t index, std::uint32_t parent_index);
    void unlink(std::uint32_t index);
    void spread_to_descendants();
    void evaluate_with_ancestors(ecs::Registry& registry, std::uint32_t index);
    void condemn_cycle(std::uint32_t member);
    void evaluate(ecs::Registry& registry, Node& node);
    TransformFault compose(const ecs::Registry& registry, const Node& node, WorldTransform& world) const;
    void refresh_quarantine();

    ecs::ChangeCursor cursor_;
    std::vector<Node> nodes_;              // by entity index
    std::vector<std::uint32_t> affected_;  // indices evaluated in this update
    std::vector<std::uint32_t> path_;
    std::uint64_t pass_ = 0;
    TransformReport report_;
};

}  // namespace gnomon
