#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Classifies instances as static or dynamic, so that depths of static casters can be kept.
///
/// An instance is dynamic from a frame in which its version grows until kStaticFrames frames without growth. Instances
/// of the first frame are static until they move. Later ones start as dynamic.
class DynamicCasters {
public:
    /// Updates the classes; call once per frame. Returns true if any changed. Takes time for the changed instances
    /// only, or for all where the scene's version grew by more than 1.
    bool update(const SceneSnapshot& scene);

    /// Returns a bit per gpu_slot, 1: dynamic. Empty where all are static.
    const std::vector<std::uint64_t>& moving() const { return moving_; }

    /// Frames without movement after which an instance is static: half a second at 60 Hz. Longer than usual pauses: an
    /// animation at 8 Hz, a figure that turns around, a body that settles. After each stop, a map with the instance is
    /// drawn once more, with it among the static casters. Until then its light needs memory for a copy of the static
    /// casters.
    static constexpr std::uint64_t kStaticFrames = 30;

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    /// Entry of an instance. Dynamic instances are linked in the order of their last change.
    struct Slot {
        std::uint64_t touched = 0;  // frame of its last change
        std::uint32_t before = kNone, after = kNone;
    };
    void touch(const InstanceItem& item);
    void unlink(std::uint32_t slot);
    void append(std::uint32_t slot);
    void let_rest();

    std::uint64_t frame_ = 0, seen_ = 0;
    bool changed_ = false;               // any class changed in this frame
    std::vector<std::uint64_t> moving_;  // bit per gpu_slot
    std::vector<Slot> slots_;            // by gpu_slot, up to the last instance that ever moved
    std::uint32_t first_ = kNone, last_ = kNone;
};

/// Returns true if the item is dynamic. `marks`: result of DynamicCasters::moving().
inline bool moves(std::span<const std::uint64_t> marks, const InstanceItem& item) {
    const std::size_t word = item.gpu_slot / 64;
    return word < marks.size() && (marks[word] >> item.gpu_slot % 64 & 1) != 0;
}

}  // namespace gnomon::shadow
