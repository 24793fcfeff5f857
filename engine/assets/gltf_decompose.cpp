#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_nodes.h"

namespace gnomon::assets::gltf {
namespace {

glm::dvec3 any_perpendicular(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                             : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                  : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(axis, other));
}

/// Replaces columns that a zero scale has emptied, so that the three form a right-handed orthonormal basis.
void complete_basis(glm::dmat3& basis, const glm::dvec3& scale) {
    const bool has[3] = {scale.x != 0.0, scale.y != 0.0, scale.z != 0.0};
    const int count = int{has[0]} + int{has[1]} + int{has[2]};
    if (count == 3) return;
    if (count == 0) {
        basis = glm::dmat3(1.0);
        return;
    }
    if (count == 1) {
        const int kept = has[0] ? 0 : has[1] ? 1 : 2;
        basis[(kept + 1) % 3] = any_perpendicular(basis[kept]);
        basis[(kept + 2) % 3] = glm::cross(basis[kept], basis[(kept + 1) % 3]);
        return;
    }
    const int lost = !has[0] ? 0 : !has[1] ? 1 : 2;
    basis[lost] = glm::cross(basis[(lost + 1) % 3], basis[(lost + 2) % 3]);
}

/// Makes three columns orthogonal that are so up to rounding. A column much shorter than another contains that one's
/// rounding.
void make_square(glm::dmat4& columns) {
    int order[3] = {0, 1, 2};
    const auto length = [&](int i) { return glm::length(glm::dvec3(columns[i])); };
    std::sort(std::begin(order), std::end(order), [&](int a, int b) { return length(a) > length(b); });
    if (!(length(order[1]) > 0.0)) return;
    const glm::dvec3 first = glm::normalize(glm::dvec3(columns[order[0]]));
    const glm::dvec3 second(columns[order[1]]);
    const glm::dvec3 across = second - first * glm::dot(first, second);
    if (!(glm::length(across) > 0.0)) return;
    columns[order[1]] = glm::dvec4(across, 0.0);
    const glm::dvec3 last = glm::cross(first, glm::normalize(across));
    columns[order[2]] = glm::dvec4(last * glm::dot(last, glm::dvec3(columns[order[2]])), 0.0);
}

/// Converges quadratically; random and nearly singular matrices take at most 6 (SceneImport, sheared matrices).
constexpr int kJacobiSweeps = 12;
/// Minimum length of a column relative to the longest. Shorter ones are rounding of a few products in double, with an
/// arbitrary direction (SceneImport).
constexpr double kLeastColumn = 0x1p-44;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

glm::dmat4 matrix_of(const Trs& trs) {
    const glm::dmat3 rotation = glm::mat3_cast(trs.rotation);
    return {glm::dvec4(rotation[0] * trs.scale.x, 0.0), glm::dvec4(rotation[1] * trs.scale.y, 0.0),
            glm::dvec4(rotation[2] * trs.scale.z, 0.0), glm::dvec4(trs.translation_m, 1.0)};
}

std::optional<Trs> decompose(const glm::dmat4& matrix, const std::string& pointer) {
    Trs trs;
    trs.translation_m = glm::dvec3(matrix[3]);
    glm::dmat3 basis(matrix);
    for (int i = 0; i < 3; ++i) {
        trs.scale[i] = glm::length(basis[i]);
        if (!std::isfinite(trs.scale[i])) fail("node.not_finite", pointer, "its columns are too long");
        if (trs.scale[i] > 0.0) basis[i] /= trs.scale[i];
    }
    complete_basis(basis, trs.scale);
    if (glm::determinant(basis) < 0.0) {
        trs.scale.x = -trs.scale.x;
        basis[0] = -basis[0];
    }
    trs.rotation = glm::normalize(glm::quat_cast(basis));

    const glm::dmat4 again = matrix_of(trs);
    const double size = largest(trs.scale);
    for (int i = 0; i < 3; ++i) {
        const double off = largest(glm::dvec3(again[i]) - glm::dvec3(matrix[i]));
        if (!(off <= kMatrixTolerance * size)) return std::nullopt;
    }
    return trs;
}

ShearedTrs decompose_sheared(const glm::dmat4& matrix, const std::string& pointer) {
    // One-sided Jacobi: rotates pairs of columns until all three are orthogonal (Golub and Van Loan, 8.6.3).
    glm::dmat4 squared = matrix;
    glm::dquat turned(1.0, 0.0, 0.0, 0.0);  // squared = matrix * turned
    for (int sweep = 0; sweep < kJacobiSweeps; ++sweep)
        for (int i = 0; i < 3; ++i) {
            const int p = i, q = (i + 1) % 3;
            const glm::dvec3 a(squared[p]), b(squared[q]);
            // Two rotations are possible: the one below 45 degrees converges, the other swaps the columns forever.
            const double longer = glm::dot(a, a) - glm::dot(b, b), along = 2.0 * glm::dot(a, b);
            const double twice_rad = std::atan2(longer < 0.0 ? -along : along, std::abs(longer));
            const double c = std::cos(0.5 * twice_rad), s = std::sin(0.5 * twice_rad);
            squared[p] = glm::dvec4(c * a + s * b, 0.0);
            squared[q] = glm::dvec4(c * b - s * a, 0.0);
            glm::dvec3 axis(0.0);
            axis[(i + 2) % 3] = 1.0;
            turned = turned * glm::angleAxis(0.5 * twice_rad, axis);
        }
    const double longest = std::max({glm::length(squared[0]), glm::length(squared[1]), glm::length(squared[2])});
    for (int i = 0; i < 3; ++i)
        if (glm::length(squared[i]) <= kLeastColumn * longest) squared[i] = glm::dvec4(0.0);
    make_square(squared);
    const std::optional<Trs> outer = decompose(squared, pointer);
    if (!outer) fail("node.not_finite", pointer, "it is no product of turns and scales");
    return {*outer, glm::normalize(glm::conjugate(turned))};
}

void expect_affine(glm::dmat4& matrix, Document& document, const std::string& pointer) {
    const glm::dvec4 last_row(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
    const glm::dvec4 right(0.0, 0.0, 0.0, 1.0);
    if (last_row == right) return;
    const glm::dvec4 off = glm::abs(last_row - right);
    if (!(std::max(std::max(off.x, off.y), std::max(off.z, off.w)) <= kMatrixTolerance))
        fail("node.matrix_not_affine", pointer, "its last row must be 0 0 0 1");
    for (int i = 0; i < 4; ++i) matrix[i][3] = right[i];
    document.take("node.matrix_last_row", pointer, "its last row is off by rounding, taken as 0 0 0 1");
}

}  // namespace gnomon::assets::gltf
