#include "engine/rays/transmittance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "engine/image/srgb.h"

namespace gnomon::rays {
namespace {

std::size_t wrapped(double texel, std::uint32_t size, assets::TextureWrap wrap) {
    const double edge = size;
    if (wrap == assets::TextureWrap::clamp) return static_cast<std::size_t>(glm::clamp(texel, 0.0, edge - 1.0));
    if (wrap == assets::TextureWrap::repeat) return static_cast<std::size_t>(glm::mod(texel, edge));
    const double there_and_back = glm::mod(texel, 2.0 * edge);
    return static_cast<std::size_t>(there_and_back < edge ? there_and_back : 2.0 * edge - 1.0 - there_and_back);
}

/// Reads a texel's alpha alone: masks need no colour, and its decoding takes long.
double alpha_of(const std::uint8_t* rgba) { return static_cast<double>(rgba[3]) / 255.0; }

glm::dvec4 colour_of(const std::uint8_t* rgba) {
    const auto linear = [&](int channel) { return image::light_of_srgb(static_cast<double>(rgba[channel]) / 255.0); };
    return {linear(0), linear(1), linear(2), alpha_of(rgba)};
}

/// Samples what `read` takes of a texel.
template <class Read>
auto sampled(const assets::Texture& texture, const glm::dvec2& uv, const Read& read) {
    using Value = decltype(read(texture.rgba.data()));
    const std::size_t bytes = std::size_t{4} * texture.width * texture.height;
    const glm::dvec2 at = uv * glm::dvec2(texture.width, texture.height);
    if (bytes == 0 || texture.rgba.size() < bytes || !std::isfinite(at.x) || !std::isfinite(at.y)) return Value(1.0);
    const auto texel = [&](double column, double row) {
        const std::size_t x = wrapped(column, texture.width, texture.wrap_u);
        const std::size_t y = wrapped(row, texture.height, texture.wrap_v);
        return read(&texture.rgba[(y * texture.width + x) * 4]);
    };
    if (!texture.linear_filter) return texel(std::floor(at.x), std::floor(at.y));
    const glm::dvec2 first = glm::floor(at - 0.5), part = at - 0.5 - first;
    const auto row = [&](double y) { return glm::mix(texel(first.x, y), texel(first.x + 1.0, y), part.x); };
    return glm::mix(row(first.y), row(first.y + 1.0), part.y);
}

/// Returns the number as a share, as the device takes it: 0 for NaN.
double share(double value) { return value > 0.0 ? std::min(value, 1.0) : 0.0; }

/// A point of a triangle.
struct SurfacePoint {
    const assets::MeshLibrary& library;
    const assets::Mesh& mesh;
    const assets::Material& material;
    const std::uint32_t* corner;
    const glm::dvec3& weights;
};

/// Returns what `read` takes of a colour, at the point: material times texture times vertex colour.
template <class Read, class ReadTexel>
auto value_at(const SurfacePoint& point, const Read& read, const ReadTexel& read_texel) {
    auto value = read(point.material.base_colour);
    const auto texture = static_cast<std::size_t>(point.material.base_colour_texture);
    if (point.material.base_colour_texture >= 0 && texture < point.library.textures.size()) {
        glm::dvec2 uv(0.0);
        for (int i = 0; i < 3; ++i) uv += point.weights[i] * glm::dvec2(point.mesh.vertices[point.corner[i]].uv);
        value *= sampled(point.library.textures[texture], uv, read_texel);
    }
    if (!point.mesh.colours.empty()) {
        auto between = decltype(value)(0.0);
        for (int i = 0; i < 3; ++i) between += point.weights[i] * read(point.mesh.colours[point.corner[i]]);
        value *= between;
    }
    return value;
}

}  // namespace

bool is_there(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
              std::uint32_t material_index, const glm::dvec3& weights) {
    const assets::Material& material = library.materials[material_index];
    if (material.alpha_mode != assets::AlphaMode::mask) return true;
    const auto alpha = [](const glm::vec4& colour) { return static_cast<double>(colour.a); };
    const SurfacePoint point{library, mesh, material, &mesh.indices[std::size_t{3} * triangle], weights};
    return value_at(point, alpha, alpha_of) >= static_cast<double>(material.alpha_cutoff);
}

glm::dvec3 transmittance(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
                         std::uint32_t material_index, const glm::dvec3& weights) {
    const assets::Material& material = library.materials[material_index];
    const SurfacePoint point{library, mesh, material, &mesh.indices[std::size_t{3} * triangle], weights};
    const glm::dvec4 colour = value_at(
        point, [](const glm::vec4& stored) { return glm::dvec4(stored); }, colour_of);
    const bool masked = material.alpha_mode == assets::AlphaMode::mask;
    if (masked && !(colour.a >= static_cast<double>(material.alpha_cutoff))) return glm::dvec3(1.0);
    const double covered = material.alpha_mode == assets::AlphaMode::blend ? share(colour.a) : 1.0;
    const double dielectric = 1.0 - share(static_cast<double>(material.metallic));
    glm::dvec3 passed;
    for (int i = 0; i < 3; ++i) {
        const double through = share(static_cast<double>(material.transmission[i]));
        passed[i] = 1.0 - covered * (1.0 - share(through * colour[i] * dielectric));
    }
    return passed;
}

}  // namespace gnomon::rays
