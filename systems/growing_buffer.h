#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon {

/// Device buffer that grows by replacement; its user rewrites the contents every frame. Owns the buffer.
class GrowingBuffer {
public:
    /// Creates no buffer yet. `texels`: see BufferDesc::texels.
    GrowingBuffer(gl::Device& device, std::string label, bool texels = false)
        : device_(&device), label_(std::move(label)), texels_(texels) {}
    GrowingBuffer(const GrowingBuffer&) = delete;
    GrowingBuffer& operator=(const GrowingBuffer&) = delete;
    ~GrowingBuffer() { device_->destroy(buffer_); }

    /// Ensures a size of at least `bytes`. Returns false on failure; the old buffer then stays. Sizes are powers of
    /// two, so that growth is rare.
    bool reserve(std::uint64_t bytes) {
        if (bytes <= size_) return true;
        constexpr std::uint64_t kLeastBytes = 4096;  // one page
        const std::uint64_t size = std::bit_ceil(std::max(bytes, kLeastBytes));
        const auto made = device_->create_buffer({label_, size, gl::BufferUse::updated, texels_}, {});
        if (!made) return false;
        device_->destroy(buffer_);
        buffer_ = made.handle;
        size_ = size;
        return true;
    }
    /// Frees the buffer; the next reserve() creates it again.
    void release() {
        device_->destroy(buffer_);
        buffer_ = {};
        size_ = 0;
    }
    gl::BufferHandle handle() const { return buffer_; }
    std::uint64_t bytes() const { return size_; }

private:
    gl::Device* device_;
    std::string label_;
    bool texels_;
    gl::BufferHandle buffer_{};
    std::uint64_t size_ = 0;
};

/// Rounds up to the device's uniform-offset alignment.
inline std::uint32_t aligned(std::size_t bytes, std::uint32_t alignment) {
    return static_cast<std::uint32_t>((bytes + alignment - 1) / alignment * alignment);
}

/// Writes a record into `bytes` at `offset`, and enlarges them where needed.
template <class Record>
void put_record(std::vector<std::byte>& bytes, std::uint32_t offset, const Record& record) {
    static_assert(std::is_trivially_copyable_v<Record>);
    if (bytes.size() < offset + sizeof record) bytes.resize(offset + sizeof record);
    std::memcpy(bytes.data() + offset, &record, sizeof record);
}

}  // namespace gnomon
