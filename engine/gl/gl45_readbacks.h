#pragma once
#include <epoxy/gl.h>

#include <unordered_map>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Tracks copies into read_back buffers without blocking. Private to the executor.
class GlReadbacks {
public:
    GlReadbacks() = default;
    GlReadbacks(const GlReadbacks&) = delete;
    GlReadbacks& operator=(const GlReadbacks&) = delete;
    ~GlReadbacks();

    /// Starts tracking a copy into the buffer `id`, which must be the last command so far.
    void expect(std::uint32_t id);
    /// Returns the state of the copy; `done` and `failed` only once.
    Readback poll(std::uint32_t id);
    void forget(std::uint32_t id);

private:
    std::unordered_map<std::uint32_t, GLsync> fences_;  // by buffer
};

}  // namespace gnomon::gl
