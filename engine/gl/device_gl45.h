#pragma once
#include <functional>
#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/gl/device.h"

namespace gnomon::gl {

/// Severity and text of a KHR_debug message; called during the GL call that caused it (synchronous). Advice on speed is
/// never above low.
enum class MessageSeverity : std::uint8_t { notification, low, medium, high };
using MessageSink = std::function<void(MessageSeverity, std::string_view)>;

/// Makes the OpenGL 4.5 executor for the context that is current on this thread. It sets glClipControl and
/// other fixed state, and owns every object it makes: the destructor deletes them (context must be current).
/// Error if the context is below 4.5 core (rule "gl.version").
Result<std::unique_ptr<Device>> make_gl45_device(MessageSink sink);

/// OpenGL's own name of a texture, sampler or buffer, for draw calls that are not Gnomon's. 0 if there is none. The
/// object stays the device's: it may be replaced or deleted in any later frame.
unsigned gl_name(const Device& gl45_device, TextureHandle texture);
unsigned gl_name(const Device& gl45_device, SamplerHandle sampler);
unsigned gl_name(const Device& gl45_device, BufferHandle buffer);
/// The same of the texture by which a buffer with BufferDesc::texels is read.
unsigned gl_texels_name(const Device& gl45_device, BufferHandle buffer);

/// GL objects this device currently owns (leak checks).
std::size_t live_objects(const Device& gl45_device);

}  // namespace gnomon::gl
