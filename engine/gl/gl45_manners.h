#pragma once
#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/gl/gl45_kept_pieces.h"

/// What an engine that shares its context finds as it was after any call. Private to the executor.
namespace gnomon::gl {

/// Error flags that someone else left, taken and raised again. OpenGL has a flag per kind, or one for all.
class PendingErrors {
public:
    void take();
    bool any() const { return kinds_ != 0; }
    /// Raises them by calls that change nothing else. GL_STACK_UNDERFLOW below open debug groups of the engine becomes
    /// GL_INVALID_OPERATION, because only an empty stack raises it.
    void raise_again() const;

private:
    std::uint32_t kinds_ = 0;  // bit i: GL_INVALID_ENUM + i
};

/// Receiver of debug messages during the device's calls; without a callback the engine's own hears them.
struct GlListener {
    GLDEBUGPROC callback = nullptr;
    const void* user = nullptr;
};

/// One call into the device that leaves errors and debug output as they were. Does nothing if `keeps` is false.
/// - Errors from before stay pending; the device's own do not.
/// - A callback hears this call alone. Without any, no message enters the context's log.
class GlCall {
public:
    GlCall(bool keeps, const GlListener& listener);
    ~GlCall();
    GlCall(const GlCall&) = delete;
    GlCall& operator=(const GlCall&) = delete;

private:
    bool keeps_, installed_ = false;
    PendingErrors errors_;
    Kept<Capability> output_{Capability{GL_DEBUG_OUTPUT}}, synchronous_{Capability{GL_DEBUG_OUTPUT_SYNCHRONOUS}};
    void *callback_ = nullptr, *user_ = nullptr;  // the engine's
};

/// Tightly packed rows and no pixel buffer for uploads or for readbacks; the caller's own afterwards if `keeps`.
class PixelTransfer {
public:
    enum class Direction : std::uint8_t { upload, readback };
    PixelTransfer(bool keeps, Direction direction);
    ~PixelTransfer();
    PixelTransfer(const PixelTransfer&) = delete;
    PixelTransfer& operator=(const PixelTransfer&) = delete;

private:
    static constexpr std::size_t kModes = 8;
    const std::array<GLenum, kModes>* modes_ = nullptr;  // null: nothing to give back
    std::array<GLint, kModes> before_{};
    Kept<UnpackBuffer> unpack_;
    Kept<PackBuffer> pack_;
};

}  // namespace gnomon::gl
