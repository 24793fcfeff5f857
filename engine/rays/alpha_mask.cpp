#include "engine/rays/alpha_mask.h"

#include <cmath>
#include <glm/common.hpp>

namespace gnomon::rays {
namespace {

std::size_t wrapped(double texel, std::uint32_t size, assets::TextureWrap wrap) {
    const double edge = size;
    if (wrap == assets::TextureWrap::clamp) return static_cast<std::size_t>(glm::clamp(texel, 0.0, edge - 1.0));
    if (wrap == assets::TextureWrap::repeat) return static_cast<std::size_t>(glm::mod(texel, edge));
    const double there_and_back = glm::mod(texel, 2.0 * edge);
    return static_cast<std::size_t>(there_and_back < edge ? there_and_back : 2.0 * edge - 1.0 - there_and_back);
}

double alpha_at(const assets::Texture& texture, double column, double row) {
    const std::size_t x = wrapped(column, texture.width, texture.wrap_u);
    const std::size_t y = wrapped(row, texture.height, texture.wrap_v);
    return static_cast<double>(texture.rgba[(y * texture.width + x) * 4 + 3]) / 255.0;
}

double sampled(const assets::Texture& texture, const glm::dvec2& uv) {
    const std::size_t bytes = std::size_t{4} * texture.width * texture.height;
    const glm::dvec2 at = uv * glm::dvec2(texture.width, texture.height);
    if (bytes == 0 || texture.rgba.size() < bytes || !std::isfinite(at.x) || !std::isfinite(at.y)) return 1.0;
    if (!texture.linear_filter) return alpha_at(texture, std::floor(at.x), std::floor(at.y));
    const glm::dvec2 first = glm::floor(at - 0.5), part = at - 0.5 - first;
    const auto row = [&](double y) {
        return glm::mix(alpha_at(texture, first.x, y), alpha_at(texture, first.x + 1.0, y), part.x);
    };
    return glm::mix(row(first.y), row(first.y + 1.0), part.y);
}

}  // namespace

bool is_there(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
              std::uint32_t material_index, const glm::dvec3& weights) {
    const assets::Material& material = library.materials[material_index];
    if (material.alpha_mode != assets::AlphaMode::mask) return true;
    double alpha = static_cast<double>(material.base_colour.a);
    const auto texture = static_cast<std::size_t>(material.base_colour_texture);
    if (material.base_colour_texture >= 0 && texture < library.textures.size()) {
        const std::uint32_t* corner = &mesh.indices[std::size_t{3} * triangle];
        glm::dvec2 uv(0.0);
        for (std::size_t i = 0; i < 3; ++i)
            uv += weights[static_cast<glm::length_t>(i)] * glm::dvec2(mesh.vertices[corner[i]].uv);
        alpha *= sampled(library.textures[texture], uv);
    }
    if (!mesh.colours.empty()) {
        const std::uint32_t* corner = &mesh.indices[std::size_t{3} * triangle];
        double between = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            between += weights[static_cast<glm::length_t>(i)] * static_cast<double>(mesh.colours[corner[i]].a);
        alpha *= between;
    }
    return alpha >= static_cast<double>(material.alpha_cutoff);
}

}  // namespace gnomon::rays
