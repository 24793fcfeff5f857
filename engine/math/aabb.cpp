#include "engine/math/aabb.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::math {
namespace {

bool has_nan(const glm::dvec3& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); }

// Multiplies with 0 * infinity = 0: an axis that a transform ignores must not turn its result into NaN.
double product(double factor, double value) { return factor == 0.0 ? 0.0 : factor * value; }

}  // namespace

bool is_finite(const Aabb& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(b.min[axis]) || !std::isfinite(b.max[axis])) return false;
    }
    return true;
}

Aabb merged(const Aabb& a, const Aabb& b) {
    if (is_empty(b)) return is_empty(a) ? Aabb{} : a;
    if (is_empty(a)) return b;
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

Aabb extended(const Aabb& a, const glm::dvec3& point) {
    if (has_nan(point)) return a;
    if (is_empty(a)) return {point, point};
    return {glm::min(a.min, point), glm::max(a.max, point)};
}

bool overlaps(const Aabb& a, const Aabb& b) {
    if (is_empty(a) || is_empty(b)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis])) return false;
    }
    return true;
}

Aabb transformed(const Aabb& b, const glm::dmat3& basis, const glm::dvec3& translation) {
    if (is_empty(b)) return {};
    Aabb out{translation, translation};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double at_min = product(basis[column][row], b.min[column]);
            const double at_max = product(basis[column][row], b.max[column]);
            // A NaN in the basis must reach the result, which then counts as empty; std::min would lose it.
            out.min[row] += at_max < at_min ? at_max : at_min;
            out.max[row] += at_max < at_min ? at_min : at_max;
        }
    }
    return out;
}

std::array<glm::dvec3, 8> corners(const Aabb& b) {
    std::array<glm::dvec3, 8> out;
    for (unsigned i = 0; i < out.size(); ++i) {
        out[i] = {(i & 1u) ? b.max.x : b.min.x, (i & 2u) ? b.max.y : b.min.y, (i & 4u) ? b.max.z : b.min.z};
    }
    return out;
}

double distance(const Aabb& b, const glm::dvec3& point) {
    if (is_empty(b)) return std::numeric_limits<double>::infinity();
    if (has_nan(point)) return std::numeric_limits<double>::quiet_NaN();
    return glm::length(glm::max(glm::max(b.min - point, point - b.max), glm::dvec3(0.0)));
}

double farthest_distance(const Aabb& b, const glm::dvec3& point) {
    if (is_empty(b)) return 0.0;
    if (has_nan(point)) return std::numeric_limits<double>::quiet_NaN();
    return glm::length(glm::max(point - b.min, b.max - point));
}

}  // namespace gnomon::math
