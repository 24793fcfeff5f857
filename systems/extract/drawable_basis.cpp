#include "systems/extract/drawable_basis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Of the basis's largest number: moves no point by more than a 64th of what float (2^-24) rounds away of its place,
/// and leaves double's inverse 2^-23 exact (DrawableBasis).
constexpr double kThickness = 0x1p-30;
/// Of that number's square: below it a cross product is what rounding of a few products (2^-53 each) may leave of a
/// line (DrawableBasis, ALineHasNoArea).
constexpr double kLeastArea = 0x1p-45;

}  // namespace

std::optional<glm::dmat3> drawable_basis(const glm::dmat3& basis) {
    double size = 0.0;
    for (int i = 0; i < 9; ++i) size = std::max(size, std::abs(basis[i / 3][i % 3]));
    if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
    const glm::dmat3 unit = basis / size;  // whose products neither overflow nor vanish
    const glm::dmat3 cofactors(glm::cross(unit[1], unit[2]), glm::cross(unit[2], unit[0]),
                               glm::cross(unit[0], unit[1]));
    const glm::dvec3 areas(glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2]));
    const int widest = areas.x >= areas.y && areas.x >= areas.z ? 0 : areas.y >= areas.z ? 1 : 2;
    if (!(areas[widest] > kLeastArea)) return std::nullopt;
    const double determinant = glm::determinant(unit);
    // Of a basis that flattens the cofactors are area * across * flattened^T, both of length 1: across is square on the
    // plane that is left, flattened is the model's direction that is lost.
    const glm::dvec3 across = cofactors[widest] / areas[widest];
    const glm::dvec3 flattened = across * cofactors;
    const double area = glm::length(flattened);
    // Half: what was given its thickness here stays as it is.
    if (!(std::abs(determinant) < 0.5 * kThickness * area)) return basis;
    const double thickness = (determinant < 0.0 ? -kThickness : kThickness) * size;
    return basis + glm::outerProduct(across, flattened / area) * thickness;
}

}  // namespace gnomon
