#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/commands.h"
#include "engine/gl/handles.h"
#include "gnomon/result.h"

namespace gnomon::gl {

enum class TextureKind : std::uint8_t { flat, array, cube };
enum class Format : std::uint8_t {
    r8,
    rgba8,
    srgb8_a8,
    rg16,
    rgba16,
    rgba16_snorm,
    r16f,
    rg16f,
    rgba16f,
    r32f,
    rg32f,
    rgba32f,
    r32ui,
    rg32ui,
    d16,
    d24,
    d32f,
    rgba32ui,
    d24_s8,  // depth alone is drawn, compared and transferred; stencil is left as it is
    d32f_s8
};
inline constexpr Format kLastFormat = Format::d32f_s8;
/// fixed: contents given at creation, never changed by lists. updated: written by lists. read_back: written by
/// CopyBuffer only, for read_buffer.
enum class BufferUse : std::uint8_t { fixed, updated, read_back };

/// Returns the bytes of one texel in `format` for accounting (D24 counts 4, with D32F a stencil 8).
std::uint32_t texel_bytes(Format format);
/// Returns the bytes of one texel in uploads and readbacks: depth formats use one float.
std::uint32_t transfer_bytes(Format format);
bool is_depth(Format format);
/// Returns true for formats that shaders read and write as integers. BeginPass::colour is truncated for them; from 2^32
/// on it is the largest integer.
bool is_integer(Format format);
const char* to_text(Format format);

struct TextureDesc {
    std::string label = {};
    TextureKind kind = TextureKind::flat;
    Format format = Format::rgba8;
    std::uint32_t width = 1, height = 1;
    std::uint32_t layers = 1;  // array layers; ignored for cubes, which have 6
    std::uint32_t mips = 1;    // 0: a full chain
    bool shared = false;       // its layers lie in an array of its size and format, with others' (SharedLayers)
    bool operator==(const TextureDesc&) const = default;
};
/// Returns 6 for a cube, 1 for a flat texture.
std::uint32_t layer_count(const TextureDesc& desc);
/// Returns the number of levels, also for a full chain.
std::uint32_t mip_count(const TextureDesc& desc);
/// Returns the bytes of all layers and mips.
std::uint64_t byte_size(const TextureDesc& desc);

/// Where the layers of a texture with TextureDesc::shared lie: one unit then serves many textures. A cube's faces are
/// six layers of the array.
struct SharedLayers {
    TextureHandle array{};  // {0}: it has its own
    std::uint32_t first = 0;
    std::uint32_t width = 0;  // edge of the array's layers, and so of the texture
};

enum class Wrap : std::uint8_t { repeat, mirror, clamp, border };  // border is 0,0,0,0
struct SamplerDesc {
    std::string label = {};
    bool linear = false;   // min and mag
    bool mipmaps = false;  // linear between mips
    bool compare = false;  // depth compare, passes where reference >= stored
    Wrap wrap_u = Wrap::clamp, wrap_v = Wrap::clamp;
    float anisotropy = 1.0f;  // maximum samples along a footprint's longer side; limited by the device
    bool operator==(const SamplerDesc&) const = default;
};

/// Bytes of a texel in a buffer with BufferDesc::texels: four numbers of 32 bits.
inline constexpr std::uint64_t kTexelBytes = 16;

struct BufferDesc {
    std::string label = {};
    std::uint64_t size = 0;  // > 0
    BufferUse use = BufferUse::updated;
    bool texels = false;  // may be bound by BindTexels, in texels of kTexelBytes; size is a multiple of that
    bool operator==(const BufferDesc&) const = default;
};

/// Sources are complete GLSL (includes resolved, #version first). An empty fragment source gives a program without
/// fragment stage (depth only).
struct ProgramDesc {
    std::string label = {};
    std::string vertex = {};
    std::string fragment = {};
    std::string geometry = {};  // empty: no geometry stage
    std::string compute = {};   // not empty: a program for Dispatch, without other stages
    bool operator==(const ProgramDesc&) const = default;
};

inline constexpr std::int32_t kAllLayers = -2;  // layered: shaders select by gl_Layer
struct Attachment {
    TextureHandle texture{};
    std::int32_t layer = -1;  // array layer or cube face 0..5; -1: whole flat texture; kAllLayers: array or cube
    bool operator==(const Attachment&) const = default;
};
constexpr std::size_t kMaxColourAttachments = 8;  // guaranteed by OpenGL
struct TargetDesc {
    std::string label = {};
    std::vector<Attachment> colours = {};
    Attachment depth{};  // texture {0}: none
    bool operator==(const TargetDesc&) const = default;
};

/// New object, or the reason why there is none. A failed creation leaves nothing behind.
template <class H>
struct Created {
    H handle{};
    Failure failure = Failure::none;
    std::string log = {};  // compiler or driver text, may be empty
    explicit operator bool() const { return failure == Failure::none; }
};

struct DeviceInfo {
    std::string name;          // renderer and version
    bool is_software = false;  // GPU time is measured by finishing around each timer
    std::uint32_t max_texture_px = 0;
    std::uint32_t max_cube_px = 0;
    std::uint32_t max_layers = 0;
    std::uint32_t max_point_px = 1;  // side of the largest square of DrawPoints
    std::uint32_t uniform_alignment = 256;
    std::uint64_t max_texel_bytes = ~std::uint64_t{0};  // largest buffer with BufferDesc::texels
    bool vertex_layer = false;  // vertex shaders may write gl_Layer (ARB_shader_viewport_layer_array)
};

/// State of a readback. empty: nothing new was copied. pending: the GPU has not finished.
enum class Readback : std::uint8_t { empty, pending, done, failed };

/// off: timers cost nothing. finish: a full finish before and after each timer (exact on software devices). query:
/// GL_TIME_ELAPSED, results arrive some frames later.
enum class TimingMode : std::uint8_t { off, finish, query };

struct Timing {
    std::uint32_t id = 0;
    std::uint64_t submission = 0;  // number of the submit() call, from 0
    double gpu_us = 0.0;
};

/// Result of submit(). A failed submission executes as much as possible, and the frame goes on.
struct SubmitResult {
    Failure failure = Failure::none;
    std::uint64_t submission = 0;
};

/// Interface to the GPU. Creation happens outside submit(); nothing throws. Devices never map memory: uploads and
/// readbacks are copies. Implementations: Gl45Device (executor),
/// RecordingDevice (tests), gmock (tests).
class Device {
public:
    virtual ~Device() = default;

    virtual const DeviceInfo& info() const = 0;
    /// Returns the number of programs that were compiled since the device was made, failures included.
    virtual std::uint64_t compiled_programs() const = 0;

    /// Creates a texture. `pixels`: empty (contents undefined), or tightly packed rows (bottom row first) of mip 0 of
    /// every layer; mips are then generated.
    virtual Created<TextureHandle> create_texture(const TextureDesc& desc, std::span<const std::byte> pixels) = 0;
    /// Returns the array with the layers of a shared texture. It belongs to the device, and may be bound and read while
    /// the texture lives.
    virtual SharedLayers shared_layers(TextureHandle) const { return {}; }
    virtual Created<SamplerHandle> create_sampler(const SamplerDesc& desc) = 0;
    /// Creates a buffer. `bytes`: empty, or exactly desc.size bytes; required for a `fixed` buffer.
    virtual Created<BufferHandle> create_buffer(const BufferDesc& desc, std::span<const std::byte> bytes) = 0;
    virtual Created<ProgramHandle> create_program(const ProgramDesc& desc) = 0;
    /// Creates a target and checks completeness. Destroy a target before its textures.
    virtual Created<TargetHandle> create_target(const TargetDesc& desc) = 0;

    /// Destroys an object. {0} is ignored.
    virtual void destroy(TextureHandle) = 0;
    virtual void destroy(SamplerHandle) = 0;
    virtual void destroy(BufferHandle) = 0;
    virtual void destroy(ProgramHandle) = 0;
    virtual void destroy(TargetHandle) = 0;

    virtual SubmitResult submit(const CommandList& list) = 0;

    /// Reads mip 0 of one layer (face) as tightly packed rows, bottom first, in the texture's own format (depth
    /// formats: one float per texel). Waits for the GPU. Returns false on wrong size or failure.
    virtual bool read_texture(TextureHandle texture, std::uint32_t layer, std::span<std::byte> out) = 0;

    /// Reads what the last CopyBuffer wrote to a read_back buffer, as a whole. Never blocks. Returns `done` once per
    /// copy. `failed`: lost, wrong size or no such buffer; `out` is then undefined.
    virtual Readback read_buffer(BufferHandle buffer, std::span<std::byte> out) = 0;

    virtual void set_timing(TimingMode mode) = 0;
    /// Returns timings that became available since the last call, oldest first.
    virtual std::vector<Timing> take_timings() = 0;

    /// Waits for the GPU to finish all submitted work.
    virtual void finish() = 0;
};

}  // namespace gnomon::gl
