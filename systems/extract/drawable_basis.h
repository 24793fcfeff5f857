#pragma once
#include <glm/mat3x3.hpp>
#include <optional>

namespace gnomon {

/// The basis that an instance is drawn, fitted and met by rays with: its own, but for one that flattens. That is given
/// a thickness far below what float rounds away of places, so that it has an inverse and normals by its cofactors.
/// Empty if what it leaves has no area, or if it is not finite.
std::optional<glm::dmat3> drawable_basis(const glm::dmat3& basis);

}  // namespace gnomon
