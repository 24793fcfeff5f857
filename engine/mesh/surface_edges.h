#pragma once
#include <cstdint>
#include <vector>

#include "gnomon/assets.h"

namespace gnomon::assets {

/// Edges at which a surface may end as seen from a light (silhouette edges). Indices refer to the mesh's own lists.
struct SurfaceEdges {
    /// Edge that is a silhouette from everywhere: of one triangle, or of more than two.
    struct Border {
        std::uint32_t a = 0, b = 0;
        bool operator==(const Border&) const = default;
    };
    /// Edge between two triangles: a silhouette where the light sees the front of one and the back of the other.
    struct Fold {
        std::uint32_t a = 0, b = 0;
        std::uint32_t first = 0, second = 0;
        /// Both triangles run along it in the same direction, so that their fronts are opposite sides of it.
        bool same_way = false;
        bool operator==(const Fold&) const = default;
    };
    std::vector<Border> borders;
    std::vector<Fold> folds;
};

/// Finds the edges of the `included` triangles (a flag each). Vertices with bitwise equal positions count as one (-0
/// equals +0). A triangle with two corners in one place is skipped, so that its neighbours meet. A triangle without
/// area but with three places stays, because it closes a gap that only rounding opened.
SurfaceEdges surface_edges(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                           const std::vector<bool>& included);

}  // namespace gnomon::assets
