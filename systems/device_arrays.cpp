#include "systems/device_arrays.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace gnomon {
namespace {

/// Place numbers stay below 2^30, so that three indices per triangle and signed base vertices can name them.
constexpr std::uint64_t kMostPlaces = std::uint64_t{1} << 30;

}  // namespace

DeviceArrays::~DeviceArrays() {
    if (!device_) return;
    for (const Array& array : arrays_) device_->destroy(array.buffer);
    submitted();
}

void DeviceArrays::swap(DeviceArrays& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(arrays_, other.arrays_);
    std::swap(ranges_, other.ranges_);
    std::swap(outgrown_, other.outgrown_);
    std::swap(made_, other.made_);
    std::swap(unused_frames_, other.unused_frames_);
    std::swap(writable_, other.writable_);
}

void DeviceArrays::put(std::size_t array, const Array& with) {
    if (array >= arrays_.size()) arrays_.resize(array + 1);
    arrays_[array] = with;
}

void DeviceArrays::start(std::uint32_t places, std::uint32_t used, bool writable) {
    ranges_ = {};
    ranges_.resize(places);
    ranges_.take(used);
    writable_ = writable;
}

std::uint32_t DeviceArrays::take(std::uint32_t count, bool may_grow, gl::CommandList& list) {
    const std::uint32_t place = writable_ ? ranges_.take(count) : kNone;
    if (place != kNone || !may_grow) return place;
    return grow(std::uint64_t{ranges_.end()} + count, list) ? ranges_.take(count) : kNone;
}

void DeviceArrays::reserve(std::uint64_t count, gl::CommandList& list) {
    const std::uint64_t needed = ranges_.end() + count;
    const std::uint32_t unused = ranges_.places() - ranges_.used();
    if (!writable_ || unused < count) grow(needed, list);
}

bool DeviceArrays::grow(std::uint64_t places, gl::CommandList& list) {
    const std::uint64_t wanted = std::bit_ceil(std::max<std::uint64_t>(places, kLeastPlaces));
    return resize(wanted, list) || (places < wanted && resize(places, list));
}

void DeviceArrays::shrink(gl::CommandList& list) {
    const std::uint32_t end = ranges_.end(), places = ranges_.places();
    const bool can_shrink = writable_ && places > kLeastPlaces && end <= places / 2;
    unused_frames_ = can_shrink ? unused_frames_ + 1 : 0;
    if (unused_frames_ < kHoldFrames) return;
    unused_frames_ = 0;
    resize(std::bit_ceil(std::max(end, kLeastPlaces)), list);
}

/// Replaces all buffers; none where one cannot be made.
bool DeviceArrays::resize(std::uint64_t places, gl::CommandList& list) {
    if (places > kMostPlaces) return false;
    made_.clear();
    for (const Array& array : arrays_) {
        made_.emplace_back();
        if (!array.buffer) continue;
        const gl::BufferDesc desc{array.label, places * array.stride, gl::BufferUse::updated, array.texels};
        made_.back() = device_->create_buffer(desc, {}).handle;
        if (made_.back()) continue;
        for (const gl::BufferHandle buffer : made_) device_->destroy(buffer);
        return false;
    }
    const std::uint64_t kept = std::min<std::uint64_t>(ranges_.end(), places);
    for (std::size_t i = 0; i < arrays_.size(); ++i) {
        Array& array = arrays_[i];
        if (!array.buffer) continue;
        if (kept > 0) list.add(gl::CopyBuffer{array.buffer, made_[i], 0, 0, kept * array.stride});
        outgrown_.push_back(std::exchange(array.buffer, made_[i]));
    }
    ranges_.resize(static_cast<std::uint32_t>(places));
    writable_ = true;
    return true;
}

void DeviceArrays::submitted() {
    for (const gl::BufferHandle buffer : outgrown_) device_->destroy(buffer);
    outgrown_.clear();
}

void DeviceArrays::drop(std::size_t array) {
    if (buffer(array)) outgrown_.push_back(std::exchange(arrays_[array].buffer, {}));
}

std::uint64_t DeviceArrays::bytes() const {
    std::uint64_t per_place = 0;
    for (const Array& array : arrays_) per_place += array.buffer ? array.stride : 0;
    return per_place * ranges_.places();
}

}  // namespace gnomon
