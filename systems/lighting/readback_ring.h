#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/gl/device.h"

namespace gnomon::lighting {

/// Copies of a small buffer on their way back from the device, a few at most, never waited for. Of those that have come
/// the newest counts. Makes its buffers when first asked.
class ReadbackRing {
public:
    /// `label` lives as long as this.
    ReadbackRing(gl::Device& device, const char* label, std::uint64_t bytes)
        : device_(device), label_(label), bytes_(bytes) {}
    ~ReadbackRing();
    ReadbackRing(const ReadbackRing&) = delete;
    ReadbackRing& operator=(const ReadbackRing&) = delete;

    /// Makes what is missing. False: it cannot be had.
    bool prepare();
    /// False: all copies are under way.
    bool has_room() const;
    /// Records the copy of `source`, of a picture of `camera`, outside passes. Only with room.
    void record(gl::BufferHandle source, ecs::Entity camera, gl::CommandList& list);

    enum class State : std::uint8_t { nothing, came, failed };
    struct News {
        State state = State::nothing;
        ecs::Entity camera = {};
    };
    /// The newest copy that has come since the last call goes to `out`; failed: a copy was lost, and none came after
    /// it.
    News collect(std::span<std::byte> out);

private:
    struct Slot {
        gl::BufferHandle buffer{};
        ecs::Entity camera = {};
        std::uint64_t number = 0;  // of the copy; 0: free
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
