#pragma once
#include <algorithm>
#include <random>

#include "engine/math/aabb.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// Returns a mesh of the test library, larger by a factor and moved.
inline assets::Mesh scaled_mesh(std::uint32_t like, float factor, const glm::vec3& by_m = {}) {
    assets::Mesh mesh = test_library().meshes[like];
    mesh.bounds_ms = {};
    for (assets::Vertex& vertex : mesh.vertices) {
        vertex.position_ms = vertex.position_ms * factor + by_m;
        mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(vertex.position_ms));
    }
    return mesh;
}

/// Returns a strip of `quads` upright squares of `side_m`, above its origin. Alternately opaque and masked by their
/// colours' alpha, if `is_coloured`; else all of `material`.
inline assets::Mesh strip_mesh(std::uint32_t quads, float side_m, std::uint32_t material, bool is_coloured) {
    assets::Mesh mesh;
    for (std::uint32_t q = 0; q < quads; ++q) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            const glm::vec3 at_ms((corner.x + static_cast<float>(q) - 0.5f * static_cast<float>(quads)) * side_m, corner.y * side_m, 0.1f * side_m * static_cast<float>(q % 2));
            mesh.vertices.push_back({at_ms, {0, 0, 1}, corner});
            mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(at_ms));
            if (is_coloured) mesh.colours.emplace_back(0.2f + 0.1f * static_cast<float>(q % 8), 1.0f, corner.x, q % 2 == 0 ? 1.0f : corner.y);
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 2u, 3u, 0u}) mesh.indices.push_back(first + i);
    }
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), material}};
    return mesh;
}

/// Returns a mesh of materials 0 and 1 of the test library: opaque or masked, with colours or without, small or large.
inline assets::Mesh random_mesh(std::mt19937_64& random) {
    const auto number = [&](std::uint32_t most) { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); };
    const float size = 0.2f + 0.1f * static_cast<float>(number(5));
    if (number(2) == 0) return scaled_mesh(number(1) == 0 ? kBox : kMixedBox, size);
    const std::uint32_t quads = 1 + number(number(9) == 0 ? 60 : 8);
    return strip_mesh(quads, std::min(0.3f * size, 1.5f / static_cast<float>(quads)), number(1), number(3) == 0);
}

}  // namespace gnomon
