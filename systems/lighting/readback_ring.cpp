#include "systems/lighting/readback_ring.h"

#include <algorithm>

namespace gnomon::lighting {

ReadbackRing::~ReadbackRing() {
    for (const Slot& slot : slots_) device_.destroy(slot.buffer);
}

bool ReadbackRing::prepare() {
    arrived_.resize(bytes_);
    for (Slot& slot : slots_) {
        if (!slot.buffer) slot.buffer = device_.create_buffer({label_, bytes_, gl::BufferUse::read_back}, {}).handle;
        if (!slot.buffer) return false;
    }
    return true;
}

bool ReadbackRing::has_room() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.number == 0; });
}

void ReadbackRing::record(gl::BufferHandle source, ecs::Entity camera, gl::CommandList& list) {
    const auto free = std::find_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.number == 0; });
    free->camera = camera;
    free->number = ++copies_;
    list.add(gl::CopyBuffer{source, free->buffer});
}

ReadbackRing::News ReadbackRing::collect(std::span<std::byte> out) {
    News news;
    std::uint64_t newest = 0;
    for (Slot& slot : slots_) {
        if (slot.number == 0) continue;
        const gl::Readback state = device_.read_buffer(slot.buffer, arrived_);
        if (state == gl::Readback::pending) continue;
        if (state == gl::Readback::failed && newest == 0) news.state = State::failed;
        if (state == gl::Readback::done && slot.number > newest) {
            newest = slot.number;
            news = {State::came, slot.camera};
            std::copy(arrived_.begin(), arrived_.end(), out.begin());
        }
        slot.number = 0;
    }
    return news;
}

}  // namespace gnomon::lighting
