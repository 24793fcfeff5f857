#include "systems/shadow/culling/static_dynamic_casters.h"

namespace gnomon::shadow {
namespace {

constexpr std::size_t kBits = 64;  // bits per word of `moving_`

}  // namespace

bool DynamicCasters::update(const SceneSnapshot& scene) {
    ++frame_;
    changed_ = false;
    if (seen_ != 0 && scene.version != seen_) {
        const bool all_are_named = scene.version == seen_ + 1;  // see SceneSnapshot::version
        if (all_are_named)
            for (const std::uint32_t i : scene.changed_instances) touch(scene.instances[i]);
        else
            for (const InstanceItem& item : scene.instances) touch(item);
    }
    seen_ = scene.version;
    let_rest();
    if (first_ == kNone) moving_.clear();
    return changed_;
}

void DynamicCasters::touch(const InstanceItem& item) {
    if (item.version <= seen_) return;
    const std::uint32_t slot = item.gpu_slot;
    if (slot >= slots_.size()) slots_.resize(slot + std::size_t{1});
    if (moving_.size() * kBits < slots_.size()) moving_.resize((slots_.size() + kBits - 1) / kBits, 0);
    slots_[slot].touched = frame_;
    if (moves(moving_, item)) {
        unlink(slot);
    } else {
        moving_[slot / kBits] |= std::uint64_t{1} << slot % kBits;
        changed_ = true;
    }
    append(slot);
}

void DynamicCasters::unlink(std::uint32_t slot) {
    const Slot& s = slots_[slot];
    (s.before == kNone ? first_ : slots_[s.before].after) = s.after;
    (s.after == kNone ? last_ : slots_[s.after].before) = s.before;
}

void DynamicCasters::append(std::uint32_t slot) {
    slots_[slot].before = last_;
    slots_[slot].after = kNone;
    (last_ == kNone ? first_ : slots_[last_].after) = slot;
    last_ = slot;
}

void DynamicCasters::let_rest() {
    while (first_ != kNone && slots_[first_].touched + kStaticFrames <= frame_) {
        moving_[first_ / kBits] &= ~(std::uint64_t{1} << first_ % kBits);
        unlink(first_);
        changed_ = true;
    }
}

}  // namespace gnomon::shadow
