#include "systems/extract/mask_buffer.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace gnomon {

bool MaskBuffer::make(std::span<const std::uint32_t> words, bool is_fixed) {
    const auto used = static_cast<std::uint32_t>(words.size());
    const std::uint32_t places = is_fixed ? used : std::bit_ceil(std::max(used, DeviceArrays::kLeastPlaces));
    const gl::BufferUse use = is_fixed ? gl::BufferUse::fixed : gl::BufferUse::updated;
    std::vector<std::uint32_t> padded;
    if (places > used) padded.assign(words.begin(), words.end());
    padded.resize(places > used ? places : 0);
    const std::span<const std::uint32_t> contents = places > used ? padded : words;
    const gl::BufferHandle made =
        device_->create_buffer({label_, contents.size_bytes(), use}, std::as_bytes(contents)).handle;
    if (!made) return false;
    array_.put(0, {label_, sizeof(std::uint32_t), false, made});
    array_.start(places, used, !is_fixed);
    return true;
}

bool MaskBuffer::follow(RayMasks& masks, gl::CommandList& list) {
    const std::span<const std::uint32_t> words = masks.words();
    const auto wanted = static_cast<std::uint32_t>(words.size());
    if (!handle()) {
        if (wanted > 0 && !make(words, false)) return false;
        masks.forget_changes();
        return true;
    }
    if (!array_.is_writable()) array_.reserve(0, list);
    if (!array_.is_writable()) return false;
    const std::uint32_t used = array_.used();
    if (wanted > used && array_.take(wanted - used, true, list) == DeviceArrays::kNone) return false;
    if (wanted < used) array_.give(wanted, used - wanted);
    array_.shrink(list);
    for (const RayMasks::Change& change : masks.changes()) {
        const std::uint32_t end = std::min(change.first + change.count, wanted);
        if (change.first < end) array_.write(0, change.first, words.subspan(change.first, end - change.first), list);
    }
    masks.forget_changes();
    return true;
}

}  // namespace gnomon
