#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/components.h"

namespace gnomon::lighting {

/// Copies of a small buffer in flight from the device, a few at most, read without blocking. The newest arrived copy
/// counts. Makes its buffers on first use.
class ReadbackRing {
public:
    /// Prepares copies of `bytes` bytes. `label` must outlive this.
    ReadbackRing(gl::Device& device, const char* label, std::uint64_t bytes)
        : device_(device), label_(label), bytes_(bytes) {}
    ~ReadbackRing();
    ReadbackRing(const ReadbackRing&) = delete;
    ReadbackRing& operator=(const ReadbackRing&) = delete;

    /// Makes missing buffers. Returns false on failure.
    bool prepare();
    /// Returns false if all copies are in flight.
    bool has_room() const;
    /// Records the copy of `source`, for a picture of `camera`, outside passes. Requires has_room().
    void record(gl::BufferHandle source, ecs::Entity camera, gl::CommandList& list);

    enum class State : std::uint8_t { nothing, came, failed };
    struct News {
        State state = State::nothing;
        ecs::Entity camera = {};
    };
    /// Reads the newest copy that arrived since the last call into `out`. failed: a copy was lost, and no later one
    /// arrived.
    News collect(std::span<std::byte> out);

private:
    struct Slot {
        gl::BufferHandle buffer{};
        ecs::Entity camera = {};
        std::uint64_t number = 0;  // number of the copy; 0: free
    };
    static constexpr std::size_t kSlots = 3;  // as many frames as drivers queue

    gl::Device& device_;
    const char* label_;
    std::uint64_t bytes_;
    std::array<Slot, kSlots> slots_;
    std::vector<std::byte> arrived_;
    std::uint64_t copies_ = 0;
};

}  // namespace gnomon::lighting
