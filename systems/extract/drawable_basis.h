#pragma once
#include <glm/mat3x3.hpp>
#include <optional>

namespace gnomon {

/// Returns the basis for drawing, fitting and tracing an instance. It equals `basis`, except when that flattens the
/// mesh. A flattening basis gets a thickness far below float's rounding, so that it has an inverse, and normals by its
/// cofactors. Returns nothing if the result has no area, or `basis` is not finite.
std::optional<glm::dmat3> drawable_basis(const glm::dmat3& basis);

}  // namespace gnomon
