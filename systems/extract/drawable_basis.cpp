#include "systems/extract/drawable_basis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Of the basis's largest column: moves no point by more than a 64th of what float (2^-24) rounds away of its place,
/// and leaves double's inverse 2^-23 exact (DrawableBasis).
constexpr double kThickness = 0x1p-30;
/// Of that column's square: below it a cross product is what rounding of a few products (2^-53 each) may leave of a
/// line (DrawableBasis, ALineHasNoArea).
constexpr double kLeastArea = 0x1p-45;

}  // namespace

std::optional<glm::dmat3> drawable_basis(const glm::dmat3& basis) {
    const double size = std::max({glm::length(basis[0]), glm::length(basis[1]), glm::length(basis[2])});
    const glm::dmat3 cofactors(glm::cross(basis[1], basis[2]), glm::cross(basis[2], basis[0]),
                               glm::cross(basis[0], basis[1]));
    const glm::dvec3 areas(glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2]));
    const int widest = areas.x >= areas.y && areas.x >= areas.z ? 0 : areas.y >= areas.z ? 1 : 2;
    if (!(areas[widest] > kLeastArea * size * size) || !std::isfinite(areas[widest])) return std::nullopt;
    const double determinant = glm::determinant(basis);
    // Of a basis that flattens the cofactors are area * across * flattened^T, both of length 1: across is square on the
    // plane that is left, flattened is the model's direction that is lost.
    const glm::dvec3 across = cofactors[widest] / areas[widest];
    const glm::dvec3 flattened = across * cofactors;
    const double area = glm::length(flattened);
    // Half: what was given its thickness here stays as it is.
    if (!(std::abs(determinant) < 0.5 * kThickness * size * area)) return basis;
    const double thickness = (determinant < 0.0 ? -kThickness : kThickness) * size;
    return basis + glm::outerProduct(across, flattened / area) * thickness;
}

}  // namespace gnomon
