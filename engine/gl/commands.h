#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/gl/handles.h"
#include "gnomon/box.h"

/// GPU work as comparable data. A frame is one CommandList; devices execute or record it. Every command is a plain
/// value with ==, so that a test compares two lists.
namespace gnomon::gl {

enum class CullMode : std::uint8_t { none, back, front };
enum class DepthTest : std::uint8_t { off, greater_equal, greater, equal, less };
/// add: sum. alpha: over, with coverage in its own alpha channel. largest: larger value per channel.
enum class Blend : std::uint8_t { off, add, alpha, largest };

struct PipelineState {
    ProgramHandle program{};
    CullMode cull = CullMode::none;
    bool front_is_clockwise = false;  // true for mirrored (negative determinant) instances
    DepthTest depth_test = DepthTest::off;
    bool depth_write = false;
    bool depth_clamp = false;
    Blend blend = Blend::off;
    bool operator==(const PipelineState&) const = default;
};

/// Text of a debug group, stored in place, because a frame's lists are rebuilt every frame without allocating. At most
/// kMost bytes of UTF-8; longer text is cut between two characters.
class GroupLabel {
public:
    static constexpr std::size_t kMost = 63;

    GroupLabel() = default;
    template <class Text>
    requires std::convertible_to<const Text&, std::string_view> GroupLabel(
        const Text& text) {  // implicit, for BeginGroup{"surfaces"}
        append(text, kMost);
    }
    /// Joins "kind name part"; if too long, the name is cut.
    GroupLabel(std::string_view kind, std::string_view name, std::string_view part);

    std::string_view text() const { return {bytes_.data(), size_}; }
    bool operator==(const GroupLabel&) const = default;

private:
    /// Appends as much as fits into the first `end` bytes.
    void append(std::string_view text, std::size_t end);
    std::array<char, kMost> bytes_{};  // zeros from size_ on
    std::uint8_t size_ = 0;
};

/// Labels a span of the frame (KHR_debug group). Groups nest and must be closed.
struct BeginGroup {
    GroupLabel label;
    bool operator==(const BeginGroup&) const = default;
};
struct EndGroup {
    bool operator==(const EndGroup&) const = default;
};

/// Begins drawing into a target. Writes to srgb8_a8 are encoded, writes to the window are not. Passes do not nest.
/// clear_depth and clear_colour apply to the whole target.
struct BeginPass {
    TargetHandle target{};
    Rect viewport{};
    bool clear_depth = false;
    float depth = 0.0f;
    bool clear_colour = false;  // every colour attachment
    std::array<float, 4> colour{};
    bool operator==(const BeginPass&) const = default;
};
struct EndPass {
    bool wrote_storage = false;  // its shaders wrote to storage buffers that later commands read
    bool operator==(const EndPass&) const = default;
};

struct SetScissor {  // width 0: scissor off. BeginPass switches it off.
    Rect rect{};
    bool operator==(const SetScissor&) const = default;
};
struct SetPipeline {
    PipelineState state{};
    bool operator==(const SetPipeline&) const = default;
};
struct BindTexture {  // texture {0} unbinds. Bindings last until changed or the list ends.
    std::uint32_t unit = 0;
    TextureHandle texture{};
    SamplerHandle sampler{};
    bool operator==(const BindTexture&) const = default;
};
struct BindUniforms {  // offset a multiple of DeviceInfo::uniform_alignment
    std::uint32_t binding = 0;
    BufferHandle buffer{};
    std::uint32_t offset = 0, size = 0;
    bool operator==(const BindUniforms&) const = default;
};
struct BindStorage {  // whole buffer
    std::uint32_t binding = 0;
    BufferHandle buffer{};
    bool operator==(const BindStorage&) const = default;
};

/// Binds a whole buffer with BufferDesc::texels as `uniform usamplerBuffer`. A software device fetches four numbers
/// from it as fast as one from a storage buffer. Shares its units with BindTexture, which unbinds it.
struct BindTexels {
    std::uint32_t unit = 0;
    BufferHandle buffer{};
    bool operator==(const BindTexels&) const = default;
};

/// Copies list.bytes[first, first + size) to the buffer at offset. Allowed outside passes only.
struct UpdateBuffer {
    BufferHandle buffer{};
    std::uint64_t offset = 0;
    std::uint32_t first = 0, size = 0;
    bool operator==(const UpdateBuffer&) const = default;
};

/// Fills size bytes of an updated buffer from offset with 0; both are multiples of 4. Allowed outside passes only.
/// Executed on the GPU in command order, to reset sums of shaders.
struct ClearBuffer {
    BufferHandle buffer{};
    std::uint64_t offset = 0, size = 0;
    bool operator==(const ClearBuffer&) const = default;
};

/// Attribute locations of vertex layout "mesh". shaders/common/bindings.glsl has the same.
inline constexpr std::uint32_t kPositionAttribute = 0, kNormalAttribute = 1, kUvAttribute = 2, kDrawItemAttribute = 3;

/// Components of a position in a vertex buffer: three of them, signed or unsigned ones normalised to [-1, 1] or [0, 1].
enum class PositionFormat : std::uint8_t { float32, float16, snorm16, unorm16 };
/// Returns the bytes of a position.
constexpr std::uint32_t position_bytes(PositionFormat format) {
    return 3 * (format == PositionFormat::float32 ? 4u : 2u);
}

/// Layout of a vertex buffer of someone else, and of its indices. Its positions alone are read.
struct MeshLayout {
    std::uint32_t stride = 0;  // bytes from vertex to vertex; 0: the layout "mesh"
    std::uint64_t position_offset = 0;
    PositionFormat position = PositionFormat::float32;
    bool short_indices = false;  // uint16, not uint32
    std::uint32_t index_bytes() const { return short_indices ? 2 : 4; }
    bool operator==(const MeshLayout&) const = default;
};

/// Binds the vertex layout "mesh", or another one.
/// - vertices: {vec3 position, vec3 normal, vec2 uv} (32 bytes)
/// - indices: uint32
/// - draw_items: uvec2 {instance, first_triangle} per instance, divisor 1
struct BindMeshes {
    BufferHandle vertices{}, indices{}, draw_items{};
    MeshLayout layout = {};
    bool operator==(const BindMeshes&) const = default;
};
struct DrawMeshes {  // triangles
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t first_item = 0, item_count = 0;  // instances, from draw_items
    bool operator==(const DrawMeshes&) const = default;
};

/// One draw of DrawMeshesIndirect, laid out as OpenGL reads it (DrawElementsIndirectCommand). Fields as in DrawMeshes.
struct MeshDrawRecord {
    std::uint32_t index_count = 0, item_count = 0, first_index = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t first_item = 0;
    bool operator==(const MeshDrawRecord&) const = default;
};
static_assert(sizeof(MeshDrawRecord) == 20);

/// Draws as a DrawMeshes per record would, in their order: records [first_record, first_record + record_count) of an
/// updated buffer. No record may reach beyond the ends, so that a device checks ranges once for all of them.
struct DrawMeshesIndirect {
    BufferHandle records{};  // MeshDrawRecord, one after the other
    std::uint32_t first_record = 0, record_count = 0;
    std::uint64_t end_index = 0, end_item = 0;  // upper bounds of first + count over the records
    bool operator==(const DrawMeshesIndirect&) const = default;
};
struct DrawTriangle {                 // one full-screen triangle, vertex_count = 3, no attributes
    std::optional<float> depth = {};  // depth of the whole triangle, [0, 1]; overrides the shader's
    bool operator==(const DrawTriangle&) const = default;
};
struct DrawLines {  // vertex_count vertices, no attributes: pulled from storage buffers
    std::uint32_t vertex_count = 0;
    bool operator==(const DrawLines&) const = default;
};

/// Draws squares of gl_PointSize pixels (1 to DeviceInfo::max_point_px) around vertices pulled from storage buffers.
/// gl_VertexID starts at first_vertex. A point with its centre outside the clip volume is dropped.
struct DrawPoints {
    std::uint32_t first_vertex = 0, vertex_count = 0;
    bool operator==(const DrawPoints&) const = default;
};

/// Draws triangles without attributes: pulled from storage buffers. gl_VertexID starts at first_vertex.
struct DrawPulled {
    std::uint32_t first_vertex = 0, vertex_count = 0;  // vertex_count: whole triangles
    bool operator==(const DrawPulled&) const = default;
};

/// Runs a compute program over groups_x times groups_y work groups. Allowed outside passes only; resets the pipeline.
/// Later commands see its writes to storage buffers.
struct Dispatch {
    ProgramHandle program{};
    std::uint32_t groups_x = 1, groups_y = 1;
    bool operator==(const Dispatch&) const = default;
};
/// Copies a buffer to another, outside passes. Size 0: the whole buffer, to one of the same size; Device::read_buffer
/// reads the copy in a BufferUse::read_back buffer. Otherwise `size` bytes, to an updated buffer.
struct CopyBuffer {
    BufferHandle source{}, destination{};
    std::uint64_t source_offset = 0, destination_offset = 0, size = 0;
    bool operator==(const CopyBuffer&) const = default;
};

/// Copies mip 0 of one layer (cube: face) to the same layer of a texture of the same format and size, outside passes.
/// Values are copied unchanged, including depth. `area`: part to copy; width 0: all.
struct CopyTexture {
    TextureHandle source{}, destination{};
    std::uint32_t layer = 0;
    Rect area{};
    bool operator==(const CopyTexture&) const = default;
};

struct GenerateMips {
    TextureHandle texture{};
    bool operator==(const GenerateMips&) const = default;
};
/// Copies colour from a rectangle to another, nearest filter; destination {0} is the window. Values are copied
/// unchanged: srgb8_a8 reaches the window still encoded, as displays need it.
struct Blit {
    TargetHandle source{}, destination{};
    Rect from{}, to{};
    bool operator==(const Blit&) const = default;
};

/// Measures the GPU time until EndTimer; Device::take_timings reports it under `id`. Timers do not nest.
struct BeginTimer {
    std::uint32_t id = 0;
    bool operator==(const BeginTimer&) const = default;
};
struct EndTimer {
    std::uint32_t id = 0;
    bool operator==(const EndTimer&) const = default;
};

using Command = std::variant<BeginGroup, EndGroup, BeginPass, EndPass, SetScissor, SetPipeline, BindTexture,
                             BindUniforms, BindStorage, BindTexels, UpdateBuffer, ClearBuffer, BindMeshes, DrawMeshes,
                             DrawMeshesIndirect, DrawTriangle, DrawLines, DrawPoints, DrawPulled, Dispatch, CopyBuffer,
                             CopyTexture, GenerateMips, Blit, BeginTimer, EndTimer>;

struct CommandList {
    std::vector<Command> commands;
    std::vector<std::byte> bytes;  // payload of UpdateBuffer

    void add(Command c) { commands.push_back(std::move(c)); }

    /// Appends an UpdateBuffer with the object representation of `values`.
    template <class T>
    void update(BufferHandle buffer, std::uint64_t offset, std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto first = static_cast<std::uint32_t>(bytes.size());
        const auto size = static_cast<std::uint32_t>(values.size_bytes());
        if (size == 0) return;
        bytes.resize(bytes.size() + size);
        std::memcpy(bytes.data() + first, values.data(), size);
        add(UpdateBuffer{buffer, offset, first, size});
    }

    void clear() {
        commands.clear();
        bytes.clear();
    }
    bool operator==(const CommandList&) const = default;
};

/// Appends the draws of meshes that a command of the list makes: none, one, or one per record. Records come
/// from what the list itself uploads before the command; without that there are none.
void append_mesh_draws(const CommandList& list, const Command& command, std::vector<DrawMeshes>& draws);

/// Formats one line per command, for test failures and captures.
std::string to_text(const Command& command);
std::string to_text(const CommandList& list);

}  // namespace gnomon::gl
