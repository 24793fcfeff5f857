#include "engine/assets/gltf_image.h"

#include <cstdlib>
#include <limits>
#include <memory>

#include "engine/assets/gltf_limits.h"

namespace {

// Limits allocations. stb_image grows its buffers with the compressed stream, so that a small file can demand
// gigabytes.
void* bounded_malloc(std::size_t bytes) {
    return bytes <= gnomon::assets::gltf::kMaxImageAllocation ? std::malloc(bytes) : nullptr;
}
void* bounded_realloc(void* block, std::size_t bytes) {
    return bytes <= gnomon::assets::gltf::kMaxImageAllocation ? std::realloc(block, bytes) : nullptr;
}

}  // namespace

// Private copy of stb_image: only the two formats of glTF, no files, no state shared with other users of the library.
#define STBI_MALLOC(size) bounded_malloc(size)
#define STBI_REALLOC(block, size) bounded_realloc(block, size)
#define STBI_FREE(block) std::free(block)
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
// The casts in the allocator macros count as this file's code, not the system header's.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace gnomon::assets::gltf {
namespace {

constexpr int kChannels = 4;

bool fits_decoder(std::span<const std::byte> bytes, std::string& reason) {
    if (bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max())) return true;
    reason = "too many bytes";
    return false;
}

const stbi_uc* data_of(std::span<const std::byte> bytes) { return reinterpret_cast<const stbi_uc*>(bytes.data()); }

std::string failure_reason() {
    const char* reason = stbi_failure_reason();
    return reason != nullptr ? reason : "unknown";
}

}  // namespace

ImageSize image_size(std::span<const std::byte> bytes, std::string& reason) {
    if (!fits_decoder(bytes, reason)) return {};
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &width, &height, &channels) == 0) {
        reason = failure_reason();
        return {};
    }
    const ImageSize size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    if (width <= 0 || height <= 0 || size.width > kMaxImageEdge_px || size.height > kMaxImageEdge_px) {
        reason = std::to_string(width) + " x " + std::to_string(height) + " is too large";
        return {};
    }
    return size;
}

DecodedImage decode_image(std::span<const std::byte> bytes, std::string& reason) {
    if (image_size(bytes, reason).width == 0) return {};
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&std::free)> texels(
        stbi_load_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &width, &height, &channels, kChannels),
        &std::free);
    if (texels == nullptr) {
        reason = failure_reason();
        return {};
    }
    DecodedImage image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    const std::size_t count = std::size_t{image.width} * image.height * kChannels;
    image.rgba.assign(texels.get(), texels.get() + count);
    return image;
}

}  // namespace gnomon::assets::gltf
