#pragma once
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "engine/math/aabb.h"
#include "gnomon/assets.h"

namespace gnomon::test {

enum class Soup { loose, closed_sheet, needles, degenerate, flat, tiny_in_large, count };

/// Makes a mesh of one material by kind:
/// - loose: triangles anywhere
/// - closed_sheet: crumpled, its triangles share all inner edges
/// - needles: a thousand times as long as wide
/// - degenerate: some without an area, some repeated
/// - flat: all in one plane
/// - tiny_in_large: one large triangle among many tiny ones
inline assets::Mesh soup(Soup kind, std::size_t triangles, double size_m, std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(share(random), share(random), share(random)) * size_m; };
    assets::Mesh mesh;
    const auto vertex = [&](const glm::dvec3& at) {
        mesh.vertices.push_back({glm::vec3(at), {}, {0.0f, 0.0f}});
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    if (kind == Soup::closed_sheet) {
        const auto edge = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2.0)) + 1;
        for (std::uint32_t y = 0; y < edge; ++y)
            for (std::uint32_t x = 0; x < edge; ++x)
                vertex((2.0 * glm::dvec3(x, 0.0, y) / (edge - 1.0) - glm::dvec3(1.0, 0.0, 1.0)) * size_m +
                       0.1 * point());
        for (std::uint32_t y = 0; y + 1 < edge; ++y)
            for (std::uint32_t x = 0; x + 1 < edge; ++x) {
                const std::uint32_t i = y * edge + x;
                mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + edge, i + 1, i + edge + 1, i + edge});
            }
    } else {
        for (std::size_t i = 0; i < triangles; ++i) {
            const glm::dvec3 a = point();
            double reach = 0.3;
            if (kind == Soup::tiny_in_large) reach = i == 0 ? 3.0 : 1e-3;
            glm::dvec3 b = a + reach * point(), c = a + reach * point();
            if (kind == Soup::needles) c = b + 1e-3 * reach * point();
            if (kind == Soup::degenerate) c = i % 3 == 0 ? b : i % 3 == 1 ? 0.5 * (a + b) : c;
            glm::dvec3 corners[] = {a, b, c};
            for (glm::dvec3& corner : corners) {
                if (kind == Soup::flat) corner.y = 0.25 * size_m;
                mesh.indices.push_back(vertex(corner));
            }
            if (kind == Soup::degenerate && i % 7 == 0)
                mesh.indices.insert(mesh.indices.end(), mesh.indices.end() - 3, mesh.indices.end());
        }
    }
    mesh.submeshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
    for (const assets::Vertex& v : mesh.vertices) mesh.bounds_ms = math::extended(mesh.bounds_ms, v.position_ms);
    return mesh;
}

}  // namespace gnomon::test
