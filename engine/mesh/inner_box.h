#pragma once
#include "gnomon/assets.h"

namespace gnomon::assets {

/// Triangles above which inner_box() does not look: what hides much, such as houses and walls, mostly has fewer.
inline constexpr std::size_t kMostInnerTriangles = 16384;

/// Returns a large box, in mesh space, inside of the largest of the mesh's closed parts. It meets none of that part's
/// triangles, so that who looks at it from outside of the mesh sees that part before it. Empty: none was found, the
/// mesh's topology is not `outward`, or it has more than kMostInnerTriangles.
math::Aabb inner_box(const Mesh& mesh);

}  // namespace gnomon::assets
