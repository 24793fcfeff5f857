#include "engine/gl/gl45_uploads.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {
namespace {

// A frame of some tens of lights; meshes that are streamed in.
constexpr std::size_t kLeastBytes = std::size_t{16} << 10, kMostBytes = std::size_t{16} << 20;
constexpr GLuint64 kRound_ns = 100'000'000;
constexpr int kMostRounds = 50;  // 5 s: a device that takes longer is lost

void wait_for(GLsync fence) {
    if (fence == nullptr) return;
    for (int i = 0; i < kMostRounds; ++i)
        if (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kRound_ns) != GL_TIMEOUT_EXPIRED) break;
    glDeleteSync(fence);
}

}  // namespace

bool GlUploads::begin(std::span<const std::byte> bytes) {
    if (bytes.size() > kMostBytes || (bytes.size() > place_bytes_ && !grow(bytes.size()))) return false;
    current_ = (current_ + 1) % kLists;
    wait_for(std::exchange(copied_[current_], nullptr));
    const std::size_t place = current_ * place_bytes_;
    std::memcpy(mapped_ + place, bytes.data(), bytes.size());
    // Flushed by a call, so that a recorder of calls (apitrace) sees what was written.
    glFlushMappedNamedBufferRange(buffer_, static_cast<GLintptr>(place), static_cast<GLsizeiptr>(bytes.size()));
    return true;
}

void GlUploads::copy(std::size_t first, std::size_t size, GLuint buffer, std::size_t offset) const {
    glCopyNamedBufferSubData(buffer_, buffer, static_cast<GLintptr>(current_ * place_bytes_ + first),
                             static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(size));
}

void GlUploads::end() { copied_[current_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0); }

bool GlUploads::grow(std::size_t bytes) {
    drop();  // the device keeps what it still copies from
    const std::size_t place_bytes = std::bit_ceil(std::max(bytes, kLeastBytes));
    constexpr GLbitfield kStorage = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT;
    const auto size = static_cast<GLsizeiptr>(kLists * place_bytes);
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, size, nullptr, kStorage);
    if (take_gl_error() == Failure::none)
        mapped_ = static_cast<std::byte*>(
            glMapNamedBufferRange(buffer_, 0, size, kStorage | GL_MAP_FLUSH_EXPLICIT_BIT));
    if (take_gl_error() != Failure::none || mapped_ == nullptr) {
        drop();
        return false;
    }
    set_gl_label(GL_BUFFER, buffer_, "uploads");
    place_bytes_ = place_bytes;
    return true;
}

void GlUploads::drop() {
    for (GLsync& fence : copied_)
        if (fence != nullptr) glDeleteSync(std::exchange(fence, nullptr));
    if (buffer_ != 0) glDeleteBuffers(1, &buffer_);  // unmaps it
    buffer_ = 0;
    mapped_ = nullptr;
    place_bytes_ = 0;
}

}  // namespace gnomon::gl
