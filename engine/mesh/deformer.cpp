#include "engine/mesh/deformer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gnomon/assets.h"

namespace gnomon::assets {
namespace {

double weight_of(const MeshPose& pose, std::size_t target) {
    return target < pose.weights.size() ? static_cast<double>(pose.weights[target]) : 0.0;
}

struct Point {
    glm::dvec3 position, normal;
};

Point morphed(const Mesh& mesh, const MeshPose& pose, std::size_t vertex) {
    Point point{glm::dvec3(mesh.vertices[vertex].position_ms), glm::dvec3(mesh.vertices[vertex].normal_ms)};
    for (std::size_t t = 0; t < mesh.deformer->targets.size(); ++t) {
        const double weight = weight_of(pose, t);
        const Deformer::Target& target = mesh.deformer->targets[t];
        if (weight == 0.0) continue;
        if (!target.positions.empty()) point.position += weight * glm::dvec3(target.positions[vertex]);
        if (!target.normals.empty()) point.normal += weight * glm::dvec3(target.normals[vertex]);
    }
    return point;
}

/// Transforms a normal by the matrix of cofactors, which also exists for a flattened joint. A mirror turns the normal
/// inward.
glm::dvec3 turned(const glm::dmat4x3& m, const glm::dvec3& normal) {
    const glm::dvec3 n =
        glm::cross(m[1], m[2]) * normal.x + glm::cross(m[2], m[0]) * normal.y + glm::cross(m[0], m[1]) * normal.z;
    return glm::dot(m[0], glm::cross(m[1], m[2])) < 0.0 ? -n : n;
}

Point skinned(const Deformer& deformer, const MeshPose& pose, std::size_t vertex, const Point& point) {
    glm::dmat4x3 blend(0.0);
    for (std::uint32_t i = deformer.first_influence[vertex]; i < deformer.first_influence[vertex + 1]; ++i)
        blend += static_cast<double>(deformer.influences[i].weight) * pose.joints[deformer.influences[i].joint];
    return {blend * glm::dvec4(point.position, 1.0), turned(blend, point.normal)};
}

/// Computes a box around all offsets that target weights can give a vertex.
math::Aabb morph_reach(const Deformer& deformer, const MeshPose& pose) {
    math::Aabb sum{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (std::size_t t = 0; t < deformer.targets.size(); ++t) {
        const double weight = weight_of(pose, t);
        const math::Aabb& reach = deformer.targets[t].reach;
        sum.min += weight * (weight < 0.0 ? reach.max : reach.min);
        sum.max += weight * (weight < 0.0 ? reach.min : reach.max);
    }
    return sum;
}

/// Relative rounding of a posed vertex. Weights are floats: their sum differs from 1 by up to 2^-24, which scales the
/// position. The position is rounded to float once more.
constexpr double kRounding = 0x1p-23;

math::Aabb with_rounding(math::Aabb box) {
    const glm::dvec3 slack(kRounding * std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z),
                                                 std::abs(box.max.x), std::abs(box.max.y), std::abs(box.max.z)}));
    return {box.min - slack, box.max + slack};
}

}  // namespace

void measure(Deformer& deformer, const Mesh& mesh) {
    std::vector<bool> shown(mesh.vertices.size(), false);
    for (const std::uint32_t vertex : mesh.indices) shown[vertex] = true;
    for (Deformer::Target& target : deformer.targets) {
        target.reach = {glm::dvec3(0.0), glm::dvec3(0.0)};
        for (std::size_t v = 0; v < target.positions.size(); ++v)
            if (shown[v]) target.reach = math::extended(target.reach, glm::dvec3(target.positions[v]));
    }
    if (!deformer.has_skin()) return;
    deformer.joint_bounds_ms.clear();
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        for (std::uint32_t i = deformer.first_influence[v]; i < deformer.first_influence[v + 1]; ++i) {
            // Vertices without a triangle are bent as well: their joints count, their places do not.
            const std::uint32_t joint = deformer.influences[i].joint;
            if (joint >= deformer.joint_bounds_ms.size()) deformer.joint_bounds_ms.resize(joint + std::size_t{1});
            math::Aabb& box = deformer.joint_bounds_ms[joint];
            if (shown[v]) box = math::extended(box, glm::dvec3(mesh.vertices[v].position_ms));
        }
}

void deform(const Mesh& mesh, const MeshPose& pose, std::vector<Vertex>& out) {
    const Deformer& deformer = *mesh.deformer;
    out.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < out.size(); ++v) {
        Point point = morphed(mesh, pose, v);
        if (deformer.has_skin()) point = skinned(deformer, pose, v, point);
        const double length = glm::length(point.normal);
        out[v] = {glm::vec3(point.position), length > 0.0 ? glm::vec3(point.normal / length) : glm::vec3(0.0f),
                  mesh.vertices[v].uv};
    }
}

math::Aabb posed_bounds(const Mesh& mesh, const MeshPose& pose) {
    const Deformer& deformer = *mesh.deformer;
    const math::Aabb moved = morph_reach(deformer, pose);
    const auto grown = [&](const math::Aabb& box) { return math::Aabb{box.min + moved.min, box.max + moved.max}; };
    if (!deformer.has_skin()) return with_rounding(grown(mesh.bounds_ms));
    math::Aabb all;
    for (std::size_t j = 0; j < deformer.joint_bounds_ms.size(); ++j) {
        if (math::is_empty(deformer.joint_bounds_ms[j])) continue;
        const glm::dmat4x3& m = pose.joints[j];
        all = math::merged(all,
                           math::transformed(grown(deformer.joint_bounds_ms[j]), glm::dmat3(m[0], m[1], m[2]), m[3]));
    }
    return with_rounding(all);
}

/// Bounds a vertex p + t that joints take to B (p + t), and later to B' (p + t'). It moves by B' (t' - t) + (B' - B)(p
/// + t), the weighted mean of the same expression for each joint alone. Its second part is largest at a corner of the
/// joint's box.
double farthest_bend_m(const Mesh& mesh, const MeshPose& before, const MeshPose& after) {
    const Deformer& deformer = *mesh.deformer;
    const math::Aabb morphed = morph_reach(deformer, before);
    double morphed_m = 0.0;
    for (std::size_t t = 0; t < deformer.targets.size(); ++t)
        morphed_m += std::abs(weight_of(after, t) - weight_of(before, t)) *
                     math::farthest_distance(deformer.targets[t].reach, glm::dvec3(0.0));
    if (!deformer.has_skin()) return morphed_m;
    double most_m = 0.0;
    for (std::size_t j = 0; j < deformer.joint_bounds_ms.size(); ++j) {
        const math::Aabb& box = deformer.joint_bounds_ms[j];
        if (math::is_empty(box)) continue;
        const glm::dmat4x3& to = after.joints[j];
        const glm::dmat4x3 way = to - before.joints[j];
        double moved_m = 0.0;
        for (const glm::dvec3& corner : math::corners({box.min + morphed.min, box.max + morphed.max}))
            moved_m = std::max(moved_m, glm::length(way * glm::dvec4(corner, 1.0)));
        const double stretch = std::sqrt(glm::dot(to[0], to[0]) + glm::dot(to[1], to[1]) + glm::dot(to[2], to[2]));
        most_m = std::max(most_m, moved_m + stretch * morphed_m);
    }
    return most_m * (1.0 + kRounding);
}

Mirroring mirroring(const Mesh& mesh, const MeshPose& pose) {
    const Deformer& deformer = *mesh.deformer;
    bool any = false, all = true;
    for (std::size_t j = 0; j < deformer.joint_bounds_ms.size(); ++j) {
        if (math::is_empty(deformer.joint_bounds_ms[j])) continue;
        const glm::dmat4x3& m = pose.joints[j];
        const double determinant = glm::determinant(glm::dmat3(m[0], m[1], m[2]));
        any = any || determinant < 0.0;
        all = all && determinant <= 0.0;  // flat joints have no orientation
    }
    return !any ? Mirroring::none : all ? Mirroring::all : Mirroring::some;
}

}  // namespace gnomon::assets
