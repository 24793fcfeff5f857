#pragma once
#include <cstddef>
#include <cstdint>

#include "engine/gl/device.h"

/// Rules for descriptions, which every device applies before it acts. The recording device and the executor thus reject
/// the same descriptions with the same Failure.
namespace gnomon::gl {

/// Checks a texture. invalid_value: zero size, size, layers or mips beyond a limit, a non-square cube, layers of a flat
/// texture, wrong `pixel_bytes`. A shared texture may be neither flat nor have mips or pixels. `pixel_bytes` is 0 or
/// exactly mip 0 of every layer.
Failure check_texture(const TextureDesc& desc, const DeviceInfo& info, std::size_t pixel_bytes);

/// Checks a buffer. invalid_value: zero size, a fraction of a texel, `given_bytes` neither 0 nor desc.size. Also: a
/// fixed buffer without its bytes, or a read_back buffer with any.
Failure check_buffer(const BufferDesc& desc, std::size_t given_bytes);

/// Checks an attachment. `texture` describes attachment.texture, nullptr if it is not alive. invalid_value: not alive;
/// incomplete_target: no such layer.
Failure check_attachment(const Attachment& attachment, const TextureDesc* texture);

/// Returns true if CopyTexture can copy the area between such textures. Callers exclude a copy onto itself.
bool can_copy(const TextureDesc& source, const TextureDesc& destination, std::uint32_t layer, const Rect& area);

/// Returns true if [first, first + size) lies in [0, limit); safe against overflow.
constexpr bool in_range(std::uint64_t first, std::uint64_t size, std::uint64_t limit) {
    return first <= limit && size <= limit - first;
}

/// Returns true if the copy's range fits both buffers (CopyBuffer). They must be different objects.
constexpr bool can_copy(const CopyBuffer& copy, const BufferDesc& source, const BufferDesc& destination) {
    if (destination.use == BufferUse::fixed) return false;
    if (copy.size == 0)
        return copy.source_offset == 0 && copy.destination_offset == 0 && source.size == destination.size;
    return destination.use == BufferUse::updated && in_range(copy.source_offset, copy.size, source.size) &&
           in_range(copy.destination_offset, copy.size, destination.size);
}

/// Returns true if `rect` is not empty and lies in a target of this size.
constexpr bool in_target(const Rect& rect, std::uint32_t width, std::uint32_t height) {
    return rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
           std::int64_t{rect.x} + rect.width <= std::int64_t{width} &&
           std::int64_t{rect.y} + rect.height <= std::int64_t{height};
}

}  // namespace gnomon::gl
