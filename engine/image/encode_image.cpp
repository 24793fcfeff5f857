#include "engine/image/encode_image.h"

#include <cstddef>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace gnomon {
namespace {

void append_bytes(void* context, void* data, int size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
    out.insert(out.end(), bytes, bytes + size);
}

constexpr int kChannels = 4;

bool is_picture(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    return width > 0 && height > 0 && rgba.size() == std::size_t{width} * height * kChannels;
}

}  // namespace

std::vector<std::uint8_t> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    std::vector<std::uint8_t> png;
    if (!is_picture(width, height, rgba)) return png;
    stbi_write_png_to_func(append_bytes, &png, static_cast<int>(width), static_cast<int>(height), kChannels,
                           rgba.data(), static_cast<int>(width) * kChannels);
    return png;
}

std::vector<std::uint8_t> encode_jpeg(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                      int quality) {
    std::vector<std::uint8_t> jpeg;
    if (!is_picture(width, height, rgba)) return jpeg;
    stbi_write_jpg_to_func(append_bytes, &jpeg, static_cast<int>(width), static_cast<int>(height), kChannels,
                           rgba.data(), quality);
    return jpeg;
}

}  // namespace gnomon
