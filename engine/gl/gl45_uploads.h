#pragma once
#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::gl {

/// Holds the bytes of lists where the device copies them from, in the order of its commands. Updates from the processor
/// (glNamedBufferSubData) are not as safe: NVIDIA 580 lost some of a buffer that shaders write.
class GlUploads {
public:
    GlUploads() = default;
    ~GlUploads() { drop(); }
    GlUploads(const GlUploads&) = delete;
    GlUploads& operator=(const GlUploads&) = delete;

    /// Takes a list's bytes. Blocks only while the device is kLists lists behind. Returns false if they are
    /// over 16 MiB, or there is no memory that both sides see.
    bool begin(std::span<const std::byte> bytes);
    /// Copies [first, first + size) of these bytes into a buffer.
    void copy(std::size_t first, std::size_t size, GLuint buffer, std::size_t offset) const;
    /// Ends the list.
    void end();

private:
    static constexpr std::size_t kLists = 3;  // places in use: the device's, the driver's queue's and the processor's

    bool grow(std::size_t bytes);
    void drop();

    GLuint buffer_ = 0;
    std::byte* mapped_ = nullptr;
    std::size_t place_bytes_ = 0, current_ = 0;
    std::array<GLsync, kLists> copied_{};  // pass when the device has read the place; null: it has
};

}  // namespace gnomon::gl
