#include "systems/extract/mesh_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace gnomon {
namespace {

/// Packs the residual of a unit normal rounded to float: at most half a unit of 2^-24 along each axis.
float packed_residual(const glm::dvec3& exact, const glm::vec3& rounded) {
    constexpr int kBits = 10, kMost = (1 << (kBits - 1)) - 1;
    constexpr double kStep = 0x1p-25 / kMost;
    std::uint32_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double off = (exact[axis] - static_cast<double>(rounded[axis])) / kStep;
        const auto steps = std::clamp(static_cast<int>(std::lround(off)), -kMost, kMost);
        bits |= (static_cast<std::uint32_t>(steps) & ((1u << kBits) - 1u)) << (kBits * axis);
    }
    return std::bit_cast<float>(bits);
}

}  // namespace

MeshRange range_of(const assets::MeshLibrary& library, const assets::Mesh& mesh) {
    MeshRange range;
    range.submesh_count = static_cast<std::uint32_t>(mesh.submeshes.size());
    range.triangles = triangles_of(mesh);
    range.solid = mesh.topology.outward;
    for (const assets::Submesh& s : mesh.submeshes) {
        const assets::Material& material = library.materials[s.material];
        range.most_reflected = std::max(range.most_reflected, most_reflected(material));
        range.solid = range.solid && assets::is_opaque(material) && !material.double_sided;
    }
    return range;
}

std::uint32_t triangles_of(const assets::Mesh& mesh) { return static_cast<std::uint32_t>(mesh.indices.size() / 3); }

std::span<const std::uint32_t> whole_triangles(const assets::Mesh& mesh) {
    return std::span<const std::uint32_t>(mesh.indices).first(std::size_t{3} * triangles_of(mesh));
}

void append_plane_normals(std::span<const assets::Vertex> vertices, std::span<const std::uint32_t> indices,
                          std::vector<glm::vec4>& normals) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a(vertices[indices[i]].position_ms);
        const glm::dvec3 b(vertices[indices[i + 1]].position_ms);
        const glm::dvec3 c(vertices[indices[i + 2]].position_ms);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double size = glm::length(n);
        const glm::dvec3 unit = size > 0.0 ? n / size : glm::dvec3(0.0);
        const glm::vec3 rounded(unit);
        normals.emplace_back(rounded, packed_residual(unit, rounded));
    }
}

void append_colours(const assets::Mesh& mesh, std::vector<glm::vec4>& colours) {
    const std::size_t first = colours.size();
    colours.insert(colours.end(), mesh.colours.begin(), mesh.colours.end());
    colours.resize(first + mesh.vertices.size(), glm::vec4(1.0f));
}

float most_reflected(const assets::Material& material) {
    if (material.unlit) return 0.0f;
    constexpr float kLeastAlpha = 1.0e-3f;  // as in brdf.glsl
    const float alpha = std::max(material.roughness * material.roughness, kLeastAlpha);
    const float colour = std::max({material.base_colour.r, material.base_colour.g, material.base_colour.b});
    const float diffuse = std::max(colour * (1.0f - material.metallic), 0.0f) / glm::pi<float>();
    const float fresnel = std::max(colour, 1.0f);
    return diffuse + fresnel / (2.0f * glm::pi<float>() * alpha * alpha * alpha);
}

}  // namespace gnomon
