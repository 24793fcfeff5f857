#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

/// Ray against triangle in double, watertight: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013.
/// A ray that crosses an edge shared by two triangles (same vertex positions) hits at least one of them. The reason is
/// that both compute the same edge function up to its sign. This needs products that are rounded one by one: no
/// contraction.
namespace gnomon::oracle {

/// origin + t * direction; the direction need not be unit length. The rest follows from it.
struct ExactRay {
    glm::dvec3 origin{0.0}, direction{0.0};
    int kx = 0, ky = 1, kz = 2;  // kz: axis of the largest component
    double shear_x = 0.0, shear_y = 0.0, shear_z = 1.0;
};

inline ExactRay make_ray(const glm::dvec3& origin, const glm::dvec3& direction) {
    ExactRay ray{origin, direction};
    const glm::dvec3 size = glm::abs(direction);
    ray.kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    ray.kx = (ray.kz + 1) % 3;
    ray.ky = (ray.kz + 2) % 3;
    if (direction[ray.kz] < 0.0) std::swap(ray.kx, ray.ky);
    ray.shear_x = direction[ray.kx] / direction[ray.kz];
    ray.shear_y = direction[ray.ky] / direction[ray.kz];
    ray.shear_z = 1.0 / direction[ray.kz];
    return ray;
}

/// Where a ray meets a triangle: at ray parameter t, at u*a + v*b + w*c. Any sign of t.
struct ExactHit {
    double t = 0.0, u = 0.0, v = 0.0, w = 0.0;
};

/// Intersects them. Returns false if the ray's line misses the triangle or runs in its plane. Both faces are hit; edges
/// belong to the triangle.
inline bool intersect(const ExactRay& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      ExactHit& hit) {
    const glm::dvec3 pa = a - ray.origin, pb = b - ray.origin, pc = c - ray.origin;
    const double ax = pa[ray.kx] - ray.shear_x * pa[ray.kz], ay = pa[ray.ky] - ray.shear_y * pa[ray.kz];
    const double bx = pb[ray.kx] - ray.shear_x * pb[ray.kz], by = pb[ray.ky] - ray.shear_y * pb[ray.kz];
    const double cx = pc[ray.kx] - ray.shear_x * pc[ray.kz], cy = pc[ray.ky] - ray.shear_y * pc[ray.kz];
    const double u = cx * by - cy * bx;
    const double v = ax * cy - ay * cx;
    const double w = bx * ay - by * ax;
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
    const double sum = u + v + w;
    if (!(std::abs(sum) > 0.0)) return false;
    const double inverse = 1.0 / sum;
    const double scaled = u * pa[ray.kz] + v * pb[ray.kz] + w * pc[ray.kz];
    hit = {scaled * ray.shear_z * inverse, u * inverse, v * inverse, w * inverse};
    return true;
}

}  // namespace gnomon::oracle
