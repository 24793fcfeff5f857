#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Where a surface may end as a light sees it. Vertices and triangles are those of a mesh's own lists.
struct SurfaceEdges {
    /// Where it ends from everywhere: an edge of one triangle, or of more than two.
    struct Border {
        std::uint32_t a = 0, b = 0;
        bool operator==(const Border&) const = default;
    };
    /// Between two triangles: it ends there where the light sees the front of one and the back of the other.
    struct Fold {
        std::uint32_t a = 0, b = 0;
        std::uint32_t first = 0, second = 0;
        bool same_way = false;  // both run along it the same way, so that fronts of both are opposite sides of it
        bool operator==(const Fold&) const = default;
    };
    std::vector<Border> borders;
    std::vector<Fold> folds;
};

/// The edges of those triangles of the list that are `included` (a flag each), by position: vertices of equal bits are
/// one, -0 and +0 too. A triangle with two corners in one place is left out: what lies beside it meets. One of three
/// places without area stays, and so closes a gap that only rounding opened.
SurfaceEdges surface_edges(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                           const std::vector<bool>& included);

}  // namespace gnomon::assets
