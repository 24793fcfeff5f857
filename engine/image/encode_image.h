#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Encodes a picture of width x height, 4 bytes per pixel, top row first. Returns nothing if width or height is 0 or
/// the sizes disagree.
std::vector<std::uint8_t> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

/// Encodes the same picture as a JPEG without alpha; quality 1 to 100.
std::vector<std::uint8_t> encode_jpeg(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                      int quality);

}  // namespace gnomon
