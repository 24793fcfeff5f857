#pragma once
#include <cstddef>
#include <cstdint>

#include "engine/gl/device.h"

/// The rules every device applies to descriptions before it acts, so that a recording device and the
/// executor refuse the same things with the same Failure.
namespace gnomon::gl {

/// invalid_value: zero size, size, layers or mips over the limit, a non-square cube, layers of a flat texture,
/// or `pixel_bytes` neither 0 nor exactly mip 0 of every layer.
Failure check_texture(const TextureDesc& desc, const DeviceInfo& info, std::size_t pixel_bytes);

/// invalid_value: zero size, a part of a texel, `given_bytes` neither 0 nor desc.size, a fixed buffer without its bytes, or one to
/// read back with any.
Failure check_buffer(const BufferDesc& desc, std::size_t given_bytes);

/// `texture` is what attachment.texture names, nullptr if it is not alive.
/// invalid_value: not alive; incomplete_target: no such layer.
Failure check_attachment(const Attachment& attachment, const TextureDesc* texture);

/// Whether that area of one texture's layer can be copied to the same place of the other (CopyTexture). Not onto
/// itself.
bool can_copy(const TextureDesc& source, const TextureDesc& destination, std::uint32_t layer, const Rect& area);

/// [first, first + size) lies in [0, limit); safe against overflow.
constexpr bool in_range(std::uint64_t first, std::uint64_t size, std::uint64_t limit) {
    return first <= limit && size <= limit - first;
}

/// `rect` is not empty and lies in a target of this size.
constexpr bool in_target(const Rect& rect, std::uint32_t width, std::uint32_t height) {
    return rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
           std::int64_t{rect.x} + rect.width <= std::int64_t{width} &&
           std::int64_t{rect.y} + rect.height <= std::int64_t{height};
}

}  // namespace gnomon::gl
