#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/result.h"

namespace gnomon::gl {

/// Severity of a KHR_debug message; advice on speed is at most low. The sink runs during the GL call that caused the
/// message (synchronous).
enum class MessageSeverity : std::uint8_t { notification, low, medium, high };
using MessageSink = std::function<void(MessageSeverity, std::string_view)>;

/// Manners of the executor towards an engine that shares its context.
struct Gl45Options {
    /// Every call leaves all state and pending errors of the context as it found them, and the sink hears only messages
    /// of these calls. A list costs a query per piece of state that it sets, and a change where it differs.
    /// If false, lists leave the state that docs/contributors/stages.md names.
    bool keeps_state = false;
};

/// Creates the OpenGL 4.5 executor for the context that is current on this thread. Owns every object that it creates;
/// the destructor deletes them (context must be current). Error if the context is below 4.5 core (rule "gl.version").
Result<std::unique_ptr<Device>> make_gl45_device(MessageSink sink, const Gl45Options& options = {});

/// Returns whether the device's context is current, or was lost. Lists may be submitted in no other context, even if it
/// shares objects. Destroyed in another one, the device leaves its framebuffers, vertex arrays and queries to the end
/// of their context.
bool is_current(Device& gl45_device);

/// Returns OpenGL's own name of a texture, sampler or buffer, for draw calls outside Gnomon; 0 if it does not exist.
/// The device keeps ownership, and may replace or delete the object in any later frame.
unsigned gl_name(const Device& gl45_device, TextureHandle texture);
unsigned gl_name(const Device& gl45_device, SamplerHandle sampler);
unsigned gl_name(const Device& gl45_device, BufferHandle buffer);
/// Returns the name of the texture that reads a buffer with BufferDesc::texels.
unsigned gl_texels_name(const Device& gl45_device, BufferHandle buffer);

/// Lets command lists use a texture of the engine's own, for example its depth buffer. The engine keeps ownership, and
/// deletes it after the handle was destroyed, which deletes nothing. Returns {0} if the texture differs from `desc`.
/// - A multisampled texture counts as flat or array. Shaders read it as sampler2DMS; it is neither copied nor read
/// back.
/// - Where no sampler is bound, reads are exact whatever its parameters are (nearest, clamped, no comparison).
/// - Its swizzle and its depth-stencil mode apply.
TextureHandle import_texture(Device& gl45_device, unsigned name, const TextureDesc& desc);
/// Texture of the context: Gnomon's or the engine's.
struct EngineTexture {
    TextureDesc desc;
    bool multisampled = false;
    std::uint32_t samples = 1;  // multisampled textures may have 1, too
    bool operator==(const EngineTexture&) const = default;
};
/// Describes any texture of the context, for import_texture(). Empty: there is none of that name, or of another kind or
/// format than a TextureDesc can have.
std::optional<EngineTexture> describe_texture(const Device& gl45_device, unsigned gl_name);
/// Returns where the samples of a multisampled depth texture lie in a pixel, [0, 1) from its lower left corner. Empty:
/// it is none.
std::vector<std::array<float, 2>> sample_positions(const Device& gl45_device, unsigned gl_name);
/// Does the same for a buffer of at least desc.size bytes. `updated` needs storage that glBufferSubData may change;
/// `fixed` serves for vertices and indices of any storage; `read_back` is refused.
BufferHandle import_buffer(Device& gl45_device, unsigned name, const BufferDesc& desc);

/// Writes the bytes of each of the context's buffers; 0 for a name that is none.
void buffer_sizes(const Device& gl45_device, std::span<const unsigned> names, std::span<std::uint64_t> sizes);

/// Binding of one texture, buffer as texels, or storage buffer, for an engine's own draws.
struct EngineBinding {
    enum class Kind : std::uint8_t { texture, texels, storage } kind = Kind::texture;
    std::uint32_t place = 0;  // unit, or binding
    TextureHandle texture{};
    SamplerHandle sampler{};
    BufferHandle buffer{};
};
/// Binds them in the context, where they stay.
void bind_for_engine(const Device& gl45_device, std::span<const EngineBinding> bindings);

/// Calls draw() with a target bound, as lists draw casters into it. Set are the viewport, clip depths of [0, 1], depth
/// test `greater` with writes, and depth clamp. Culling, scissor and colour writes are off. Afterwards that
/// state is as it was. Returns false without calling it if the target is unknown.
bool draw_into(Device& gl45_device, TargetHandle target, const Rect& viewport, const std::function<void()>& draw);

/// Counts the objects that live on this device (leak checks), imported ones included.
std::size_t live_objects(const Device& gl45_device);

}  // namespace gnomon::gl
