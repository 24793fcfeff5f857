#include "tests/oracle/alpha_mask.h"

#include <cmath>
#include <cstdint>

namespace gnomon::oracle {
namespace {

constexpr double kByteMax = 255.0;
constexpr std::size_t kChannels = 4, kAlphaChannel = 3;

std::int64_t wrapped(std::int64_t texel, std::int64_t size, assets::TextureWrap wrap) {
    switch (wrap) {
        case assets::TextureWrap::clamp:
            return texel < 0 ? 0 : texel >= size ? size - 1 : texel;
        case assets::TextureWrap::repeat:
            return ((texel % size) + size) % size;
        case assets::TextureWrap::mirror: {
            const std::int64_t period = 2 * size;
            const std::int64_t place = ((texel % period) + period) % period;
            return place < size ? place : period - 1 - place;
        }
    }
    return 0;
}

double alpha_of(const assets::Texture& texture, double column, double row) {
    const auto x = wrapped(static_cast<std::int64_t>(column), texture.width, texture.wrap_u);
    const auto y = wrapped(static_cast<std::int64_t>(row), texture.height, texture.wrap_v);
    const auto index = (static_cast<std::size_t>(y) * texture.width + static_cast<std::size_t>(x)) * kChannels;
    return texture.rgba[index + kAlphaChannel] / kByteMax;
}

}  // namespace

double sample_alpha(const assets::Texture& texture, const glm::dvec2& uv) {
    const std::size_t bytes = std::size_t{texture.width} * texture.height * kChannels;
    if (bytes == 0 || texture.rgba.size() < bytes || !std::isfinite(uv.x) || !std::isfinite(uv.y)) return 1.0;
    const glm::dvec2 place = uv * glm::dvec2(texture.width, texture.height);
    if (!texture.linear_filter) return alpha_of(texture, std::floor(place.x), std::floor(place.y));
    const double left = std::floor(place.x - 0.5), top = std::floor(place.y - 0.5);
    const double fx = place.x - 0.5 - left, fy = place.y - 0.5 - top;
    const double upper = alpha_of(texture, left, top) * (1.0 - fx) + alpha_of(texture, left + 1.0, top) * fx;
    const double lower =
        alpha_of(texture, left, top + 1.0) * (1.0 - fx) + alpha_of(texture, left + 1.0, top + 1.0) * fx;
    return upper * (1.0 - fy) + lower * fy;
}

bool passes_mask(const assets::MeshLibrary& library, const assets::Material& material, const glm::dvec2& uv,
                 double vertex_alpha) {
    if (material.alpha_mode != assets::AlphaMode::mask) return true;
    double alpha = static_cast<double>(material.base_colour.a) * vertex_alpha;
    const std::int32_t texture = material.base_colour_texture;
    if (texture >= 0 && static_cast<std::size_t>(texture) < library.textures.size())
        alpha *= sample_alpha(library.textures[static_cast<std::size_t>(texture)], uv);
    return alpha >= static_cast<double>(material.alpha_cutoff);
}

}  // namespace gnomon::oracle
