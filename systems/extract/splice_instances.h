#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Half-open range of indices.
struct IndexRange {
    std::uint32_t first = 0, end = 0;
};

/// Instances to take out of a snapshot, and those to put in. Kept from frame to frame, so that its storage is reused.
struct InstanceSplice {
    std::vector<std::uint32_t> removed;   // indices before, rising
    std::vector<InstanceItem> added;      // by rising entity index; that of a removed instance may be among them
    std::vector<std::uint32_t> added_at;  // indices after: written by splice_instances()
    bool empty() const { return removed.empty() && added.empty(); }
    void clear();
};

/// Returns false if a list made again costs no more. That one makes each instance and sorts it into the tree. A splice
/// copies each.
inline bool is_worth_splicing(std::size_t changes, const SceneSnapshot& scene) {
    constexpr std::size_t kPart = 4;
    return changes <= scene.instances.size() / kPart;
}

/// Removes and adds instances in place: in the list, which stays sorted by entity index, and in the tree. Added ones go
/// to scene.changed_instances, which is empty before, and get the scene's version, as do list and tree. The cost is a
/// copy of the instances between the first and the last change.
///
/// Returns the indices that may have another instance.
IndexRange splice_instances(SceneSnapshot& scene, InstanceSplice& splice);

}  // namespace gnomon
