#pragma once
#include <epoxy/gl.h>

#include <unordered_map>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Knows whether the copies into read_back buffers have been carried out, without waiting for them. Private to the
/// executor.
class GlReadbacks {
public:
    GlReadbacks() = default;
    GlReadbacks(const GlReadbacks&) = delete;
    GlReadbacks& operator=(const GlReadbacks&) = delete;
    ~GlReadbacks();

    /// All commands so far, a copy into the buffer of this id the last of them, are to be done before it is read.
    void expect(std::uint32_t id);
    /// Says `done` and `failed` once.
    Readback poll(std::uint32_t id);
    void forget(std::uint32_t id);

private:
    std::unordered_map<std::uint32_t, GLsync> fences_;  // by buffer
};

}  // namespace gnomon::gl
