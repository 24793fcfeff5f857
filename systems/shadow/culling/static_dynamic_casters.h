#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Tells instances that move from those that stand still, so that still casters can be kept apart from the others.
///
/// An instance moves from the frame in which its version grew until kStillFrames frames have passed without that. What
/// was there in the first frame of all stands still until it moves; what appears later counts as moving at first.
class CasterMotion {
public:
    /// To be called once per frame. Costs what changed; all instances where the scene's lists were made anew, or a
    /// version was missed. True: others move now than in the last frame.
    bool update(const SceneSnapshot& scene);

    /// A bit per gpu_slot; none at all where nothing moves.
    const std::vector<std::uint64_t>& moving() const { return moving_; }

    /// Half a second at 60 Hz. Longer than what pauses between steps: an animation at 8 Hz, a figure that turns around,
    /// a body that settles. Each time something stops, a map that shows it is drawn once more, with it among the still
    /// ones; something that moved once keeps a second store of its light for that long.
    static constexpr std::uint64_t kStillFrames = 30;

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    /// Those that move are linked in the order in which they last changed.
    struct Slot {
        std::uint64_t touched = 0;  // the frame it last changed in
        std::uint32_t before = kNone, after = kNone;
    };
    void touch(const InstanceItem& item);
    void unlink(std::uint32_t slot);
    void append(std::uint32_t slot);
    void let_rest();

    std::uint64_t frame_ = 0, seen_ = 0;
    bool changed_ = false;               // in this frame
    std::vector<std::uint64_t> moving_;  // by gpu_slot
    std::vector<Slot> slots_;            // by gpu_slot, up to the last that ever moved
    std::uint32_t first_ = kNone, last_ = kNone;
};

/// Whether `marks`, as CasterMotion::moving() has them, say that the item moves.
inline bool moves(std::span<const std::uint64_t> marks, const InstanceItem& item) {
    const std::size_t word = item.gpu_slot / 64;
    return word < marks.size() && (marks[word] >> item.gpu_slot % 64 & 1) != 0;
}

}  // namespace gnomon::shadow
