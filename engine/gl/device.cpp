#include "engine/gl/device.h"

#include <algorithm>
#include <bit>

#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {
constexpr std::uint32_t kCubeFaces = 6;
constexpr std::uint32_t kDepthTransferBytes = sizeof(float);
}  // namespace

std::uint32_t texel_bytes(Format format) {
    switch (format) {
        case Format::r8:
            return 1;
        case Format::d16:
        case Format::r16f:
            return 2;
        case Format::rgba8:
        case Format::srgb8_a8:
        case Format::rg16:
        case Format::rg16f:
        case Format::r32f:
        case Format::r32ui:
        case Format::d24:
        case Format::d24_s8:
        case Format::d32f:
            return 4;
        case Format::rgba16:
        case Format::rgba16_snorm:
        case Format::rgba16f:
        case Format::rg32f:
        case Format::rg32ui:
        case Format::d32f_s8:
            return 8;
        case Format::rgba32f:
        case Format::rgba32ui:
            return 16;
    }
    return 0;
}

std::uint32_t transfer_bytes(Format format) { return is_depth(format) ? kDepthTransferBytes : texel_bytes(format); }

bool is_depth(Format format) {
    return format == Format::d16 || format == Format::d24 || format == Format::d24_s8 || format == Format::d32f ||
           format == Format::d32f_s8;
}

bool is_integer(Format format) {
    return format == Format::r32ui || format == Format::rg32ui || format == Format::rgba32ui;
}

std::uint32_t layer_count(const TextureDesc& desc) {
    return desc.kind == TextureKind::cube ? kCubeFaces : desc.kind == TextureKind::array ? desc.layers : 1;
}

std::uint32_t mip_count(const TextureDesc& desc) {
    if (desc.mips != 0) return desc.mips;
    return static_cast<std::uint32_t>(std::bit_width(std::max({desc.width, desc.height, 1u})));
}

std::uint64_t byte_size(const TextureDesc& desc) {
    std::uint64_t texels = 0;
    for (std::uint32_t mip = 0; mip < mip_count(desc); ++mip) {
        texels += std::uint64_t{std::max(desc.width >> mip, 1u)} * std::max(desc.height >> mip, 1u);
    }
    return texels * layer_count(desc) * texel_bytes(desc.format);
}

const char* to_text(Format format) {
    switch (format) {
        case Format::r8:
            return "r8";
        case Format::rgba8:
            return "rgba8";
        case Format::srgb8_a8:
            return "srgb8_a8";
        case Format::rg16:
            return "rg16";
        case Format::rgba16:
            return "rgba16";
        case Format::rgba16_snorm:
            return "rgba16_snorm";
        case Format::r16f:
            return "r16f";
        case Format::rg16f:
            return "rg16f";
        case Format::rgba16f:
            return "rgba16f";
        case Format::r32f:
            return "r32f";
        case Format::rg32f:
            return "rg32f";
        case Format::rgba32f:
            return "rgba32f";
        case Format::r32ui:
            return "r32ui";
        case Format::rg32ui:
            return "rg32ui";
        case Format::rgba32ui:
            return "rgba32ui";
        case Format::d16:
            return "d16";
        case Format::d24:
            return "d24";
        case Format::d32f:
            return "d32f";
        case Format::d24_s8:
            return "d24_s8";
        case Format::d32f_s8:
            return "d32f_s8";
    }
    return "?";
}

const char* to_text(Failure failure) {
    switch (failure) {
        case Failure::none:
            return "none";
        case Failure::out_of_memory:
            return "out_of_memory";
        case Failure::invalid_value:
            return "invalid_value";
        case Failure::incomplete_target:
            return "incomplete_target";
        case Failure::compile_failed:
            return "compile_failed";
        case Failure::link_failed:
            return "link_failed";
        case Failure::context_lost:
            return "context_lost";
    }
    return "?";
}

Failure check_texture(const TextureDesc& desc, const DeviceInfo& info, std::size_t pixel_bytes) {
    const bool cube = desc.kind == TextureKind::cube;
    const std::uint32_t limit_px = cube ? info.max_cube_px : info.max_texture_px;
    if (desc.width == 0 || desc.height == 0 || desc.width > limit_px || desc.height > limit_px) {
        return Failure::invalid_value;
    }
    if (cube && desc.width != desc.height) return Failure::invalid_value;
    if (desc.kind == TextureKind::flat && desc.layers != 1) return Failure::invalid_value;
    if (desc.kind == TextureKind::array && (desc.layers == 0 || desc.layers > info.max_layers)) {
        return Failure::invalid_value;
    }
    if (mip_count(desc) > static_cast<std::uint32_t>(std::bit_width(std::max(desc.width, desc.height)))) {
        return Failure::invalid_value;
    }
    // A view of an array has the array's size at every level, and is filled by drawing.
    if (desc.shared && (desc.kind == TextureKind::flat || desc.mips != 1 || pixel_bytes != 0))
        return Failure::invalid_value;
    const std::uint64_t needed =
        std::uint64_t{desc.width} * desc.height * layer_count(desc) * transfer_bytes(desc.format);
    return pixel_bytes == 0 || pixel_bytes == needed ? Failure::none : Failure::invalid_value;
}

Failure check_buffer(const BufferDesc& desc, std::size_t given_bytes) {
    if (desc.size == 0 || (desc.texels && desc.size % kTexelBytes != 0)) return Failure::invalid_value;
    if (given_bytes == 0) return desc.use == BufferUse::fixed ? Failure::invalid_value : Failure::none;
    const bool fits = given_bytes == desc.size && desc.use != BufferUse::read_back;
    return fits ? Failure::none : Failure::invalid_value;
}

Failure check_attachment(const Attachment& attachment, const TextureDesc* texture) {
    if (texture == nullptr) return Failure::invalid_value;
    const bool whole = attachment.layer == -1 && texture->kind == TextureKind::flat;
    const bool all = attachment.layer == kAllLayers && texture->kind != TextureKind::flat;
    const bool one = attachment.layer >= 0 && static_cast<std::uint32_t>(attachment.layer) < layer_count(*texture);
    return whole || all || one ? Failure::none : Failure::incomplete_target;
}

bool can_copy(const TextureDesc& source, const TextureDesc& destination, std::uint32_t layer, const Rect& area) {
    return source.format == destination.format && source.width == destination.width &&
           source.height == destination.height && layer < std::min(layer_count(source), layer_count(destination)) &&
           (area.width == 0 || in_target(area, source.width, source.height));
}

}  // namespace gnomon::gl
