#pragma once
#include <memory>

#include "gnomon/assets.h"

namespace gnomon::assets {

/// Builds a tree of boxes around the mesh's triangles, for Mesh::shape. Null without triangles.
std::shared_ptr<const math::ShapeTree> shape_of(const Mesh& mesh);

}  // namespace gnomon::assets
