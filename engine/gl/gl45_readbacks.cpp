#include "engine/gl/gl45_readbacks.h"

namespace gnomon::gl {

GlReadbacks::~GlReadbacks() {
    for (const auto& [id, fence] : fences_) glDeleteSync(fence);
}

void GlReadbacks::expect(std::uint32_t id) {
    forget(id);
    fences_[id] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

Readback GlReadbacks::poll(std::uint32_t id) {
    const auto at = fences_.find(id);
    if (at == fences_.end()) return Readback::empty;
    // A null fence (creation failed) fails here, too. Without the flush flag the GPU might never reach the fence.
    const GLenum state = glClientWaitSync(at->second, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state == GL_TIMEOUT_EXPIRED) return Readback::pending;
    forget(id);
    return state == GL_WAIT_FAILED ? Readback::failed : Readback::done;
}

void GlReadbacks::forget(std::uint32_t id) {
    const auto at = fences_.find(id);
    if (at == fences_.end()) return;
    glDeleteSync(at->second);
    fences_.erase(at);
}

}  // namespace gnomon::gl
