#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::assets::gltf {

struct DecodedImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // 8 bits per channel, first row on top
};

struct ImageSize {
    std::uint32_t width = 0, height = 0;  // 0 if the bytes are no PNG or JPEG within the limits
};

/// Reads only the header. `reason` explains a size of 0.
ImageSize image_size(std::span<const std::byte> bytes, std::string& reason);

/// Decodes PNG or JPEG. Returns an empty image on failure and sets `reason`.
DecodedImage decode_image(std::span<const std::byte> bytes, std::string& reason);

}  // namespace gnomon::assets::gltf
