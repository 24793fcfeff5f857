#include "systems/extract/drawable_basis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Thickness of a flattened basis, relative to its largest number. It moves a point by at most a 64th of float's
/// rounding (2^-24). Its inverse in double stays exact to 2^-23 (test DrawableBasis).
constexpr double kThickness = 0x1p-30;
/// Least cross product, relative to the square of the largest number. Below it, rounding of a few products (2^-53 each)
/// can produce an area from a line (test DrawableBasis, ALineHasNoArea).
constexpr double kLeastArea = 0x1p-45;

}  // namespace

std::optional<glm::dmat3> drawable_basis(const glm::dmat3& basis) {
    double size = 0.0;
    for (int i = 0; i < 9; ++i) size = std::max(size, std::abs(basis[i / 3][i % 3]));
    if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
    const glm::dmat3 unit = basis / size;  // its products neither overflow nor vanish
    const glm::dmat3 cofactors(glm::cross(unit[1], unit[2]), glm::cross(unit[2], unit[0]),
                               glm::cross(unit[0], unit[1]));
    const glm::dvec3 areas(glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2]));
    const int widest = areas.x >= areas.y && areas.x >= areas.z ? 0 : areas.y >= areas.z ? 1 : 2;
    if (!(areas[widest] > kLeastArea)) return std::nullopt;
    const double determinant = glm::determinant(unit);
    // The cofactors of a flattening basis are area * across * flattened^T, with unit vectors. `across` is perpendicular
    // to the remaining plane. `flattened` is the lost direction of the model.
    const glm::dvec3 across = cofactors[widest] / areas[widest];
    const glm::dvec3 flattened = across * cofactors;
    const double area = glm::length(flattened);
    // A basis that already got its thickness here stays unchanged; hence the factor of one half.
    if (!(std::abs(determinant) < 0.5 * kThickness * area)) return basis;
    const double thickness = (determinant < 0.0 ? -kThickness : kThickness) * size;
    return basis + glm::outerProduct(across, flattened / area) * thickness;
}

}  // namespace gnomon
