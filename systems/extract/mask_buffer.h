#pragma once
#include <cstdint>
#include <span>

#include "engine/gl/device.h"
#include "systems/device_arrays.h"
#include "systems/extract/ray_masks.h"

namespace gnomon {

/// Storage buffer with the words of RayMasks. Owns it.
class MaskBuffer {
public:
    MaskBuffer() = default;
    /// Prepares a buffer. `label` must outlive it.
    MaskBuffer(gl::Device& device, const char* label) : device_(&device), label_(label), array_(device) {}

    /// Makes the buffer from all words. `is_fixed`: of exactly their size, and never changed. Returns false without
    /// room.
    bool make(std::span<const std::uint32_t> words, bool is_fixed);
    /// Follows words that came and went. Returns false without room: drop() it then.
    bool follow(RayMasks& masks, gl::CommandList& list);
    /// Frees the buffer, once the list was submitted.
    void drop() { array_.drop(0); }
    void submitted() { array_.submitted(); }

    gl::BufferHandle handle() const { return array_.buffer(0); }
    std::uint64_t bytes() const { return array_.bytes(); }

private:
    gl::Device* device_ = nullptr;
    const char* label_ = "";
    DeviceArrays array_;
};

}  // namespace gnomon
