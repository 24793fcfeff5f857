#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/range_list.h"
#include "engine/gl/device.h"

namespace gnomon {

/// Buffers with an element at each of the same places, such as an index triple and a normal per triangle. Ranges of
/// places are taken and given back, and keep their contents and numbers while the buffers grow. Owns the buffers.
class DeviceArrays {
public:
    static constexpr std::uint32_t kNone = RangeList::kNone;
    /// Buffers with fewer places do not shrink.
    static constexpr std::uint32_t kLeastPlaces = 64;

    struct Array {
        const char* label = "";  // outlives the object
        std::uint32_t stride = 0;
        bool texels = false;        // BufferDesc::texels
        gl::BufferHandle buffer{};  // {0}: the array is missing, and is passed over
    };

    DeviceArrays() = default;
    explicit DeviceArrays(gl::Device& device) : device_(&device) {}
    DeviceArrays(DeviceArrays&& other) noexcept { swap(other); }
    DeviceArrays& operator=(DeviceArrays&& other) noexcept {
        swap(other);
        return *this;
    }
    ~DeviceArrays();

    /// Takes over a buffer with an element for each of places(), of BufferUse::updated unless !is_writable().
    void put(std::size_t array, const Array& with);
    /// Starts again with the first `used` places taken, in buffers that lists may write or not.
    void start(std::uint32_t places, std::uint32_t used, bool writable);

    /// Takes places for `count` elements, and grows the buffers where needed: to a power of two, or less where the
    /// device has no more. `may_grow` false: only if they fit. Returns kNone without room; nothing changes then.
    std::uint32_t take(std::uint32_t count, bool may_grow, gl::CommandList& list);
    void give(std::uint32_t first, std::uint32_t count) { ranges_.give(first, count); }
    /// Makes room for `count` more elements at once, as far as the device has it.
    void reserve(std::uint64_t count, gl::CommandList& list);
    /// Shrinks buffers if their upper half was unused for kHoldFrames calls: call it once per frame.
    void shrink(gl::CommandList& list);
    static constexpr std::uint32_t kHoldFrames = 60;  // as for maps (MapCache)

    template <class T>
    void write(std::size_t array, std::uint32_t first, std::span<const T> values, gl::CommandList& list) const {
        list.update(arrays_[array].buffer, std::uint64_t{first} * arrays_[array].stride, values);
    }

    /// Frees the buffers that were outgrown, once the list with their copies was submitted.
    void submitted();
    /// Leaves an array out from now on; its buffer is freed by submitted().
    void drop(std::size_t array);

    gl::BufferHandle buffer(std::size_t array) const {
        return array < arrays_.size() ? arrays_[array].buffer : gl::BufferHandle{};
    }
    bool is_writable() const { return writable_; }
    /// Returns true if buffers were replaced since submitted(): their contents depend on the list.
    bool moved() const { return !outgrown_.empty(); }
    std::uint32_t places() const { return ranges_.places(); }
    std::uint32_t used() const { return ranges_.used(); }
    std::uint64_t bytes() const;

private:
    void swap(DeviceArrays& other) noexcept;
    bool resize(std::uint64_t places, gl::CommandList& list);
    bool grow(std::uint64_t places, gl::CommandList& list);

    gl::Device* device_ = nullptr;
    std::vector<Array> arrays_;
    RangeList ranges_;
    std::vector<gl::BufferHandle> outgrown_, made_;
    std::uint32_t unused_frames_ = 0;  // calls of shrink() since the upper half was in use
    bool writable_ = true;
};

}  // namespace gnomon
