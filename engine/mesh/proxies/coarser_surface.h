#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/mesh/half_edges.h"

namespace gnomon::assets {

/// Coarser form of a surface.
struct CoarserSurface {
    std::vector<WeldedFace> faces;  // over the same points
    double bound_m = 0.0;           // two-sided Hausdorff distance of the two is proven to be no larger
    double found_m = 0.0;           // distance that some point of either has from the other
};

/// Makes coarser forms of a surface of finite points, by rising bound. Each has at most kProxyShare of the faces of the
/// one before. Small parts that lie near others are left out. Equal input gives equal output.
std::vector<CoarserSurface> coarser_surfaces(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces);

/// Faces of a form, as a share of those of the one before. More would save too little for what it takes to store.
inline constexpr double kProxyShare = 0.5;
/// Fewest faces of a surface for which coarser ones are made: a box, which is drawn as fast as any.
inline constexpr std::size_t kLeastFaces = 13;

}  // namespace gnomon::assets
