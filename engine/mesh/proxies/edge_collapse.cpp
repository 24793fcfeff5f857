#include "engine/mesh/proxies/edge_collapse.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

namespace gnomon::assets {
namespace {

bool has(const WeldedFace& face, std::uint32_t vertex) {
    return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

WeldedFace replaced(WeldedFace face, std::uint32_t from, std::uint32_t to) {
    std::replace(face.begin(), face.end(), from, to);
    return face;
}

WeldedFace sorted(WeldedFace face) {
    std::sort(face.begin(), face.end());
    return face;
}

glm::dvec3 area_normal(const std::vector<glm::dvec3>& points, const WeldedFace& f) {
    return glm::cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]);
}

}  // namespace

void Quadric::add_plane(const glm::dvec3& n, double d) {
    add({n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z, n.x * d, n.y * d, n.z * d, d * d});
}

void Quadric::add(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    x += o.x, y += o.y, z += o.z, one += o.one;
}

double Quadric::at(const glm::dvec3& p) const {
    const double squares = xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z;
    const double products = xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z;
    return std::max(squares + 2.0 * (products + x * p.x + y * p.y + z * p.z) + one, 0.0);
}

bool EdgeCollapse::Candidate::operator<(const Candidate& other) const {
    return std::tie(other.cost_m2, other.from, other.to) < std::tie(cost_m2, from, to);
}

EdgeCollapse::EdgeCollapse(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces)
    : points_(points.begin(), points.end()),
      faces_of_(points.size()),
      quadrics_(points.size()),
      changes_(points.size(), 0) {
    for (const WeldedFace& face : faces) {
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        for (const std::uint32_t vertex : face) faces_of_[vertex].push_back(static_cast<std::uint32_t>(faces_.size()));
        faces_.push_back(face);
    }
    dead_.assign(faces_.size(), false);
    // About their middle, so that places far from the origin lose no digits.
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : points_) middle += p / static_cast<double>(points_.size());
    for (glm::dvec3& p : points_) p -= middle;
    add_planes();
    for (std::uint32_t vertex = 0; vertex < points_.size(); ++vertex) push_edges_of(vertex);
}

/// Adds the plane of each face to its corners. An edge that two faces do not share adds one across it, which keeps its
/// course.
void EdgeCollapse::add_planes() {
    for (const WeldedFace& face : faces_) {
        const glm::dvec3 normal = area_normal(points_, face);
        const double size = glm::length(normal);
        if (!(size > 0.0)) continue;
        Quadric plane;
        plane.add_plane(normal / size, -glm::dot(normal / size, points_[face[0]]));
        for (const std::uint32_t vertex : face) quadrics_[vertex].add(plane);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = face[c], b = face[(c + 1) % 3];
            const auto shared = std::count_if(faces_of_[a].begin(), faces_of_[a].end(),
                                              [&](std::uint32_t f) { return has(faces_[f], b); });
            const glm::dvec3 across = glm::cross(normal, points_[b] - points_[a]);
            const double across_size = glm::length(across);
            if (shared == 2 || !(across_size > 0.0)) continue;
            Quadric border;
            border.add_plane(across / across_size, -glm::dot(across / across_size, points_[a]));
            quadrics_[a].add(border);
            quadrics_[b].add(border);
        }
    }
}

void EdgeCollapse::list_neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const std::uint32_t f : faces_of_[vertex])
        for (const std::uint32_t other : faces_[f])
            if (other != vertex) out.push_back(other);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

void EdgeCollapse::push(std::uint32_t from, std::uint32_t to) {
    waiting_.push({quadrics_[from].at(points_[to]), from, to, changes_[from], changes_[to]});
}

void EdgeCollapse::push_edges_of(std::uint32_t vertex) {
    list_neighbours(vertex, one_);
    for (const std::uint32_t other : one_) push(vertex, other);
}

bool EdgeCollapse::turns_over(const WeldedFace& face, std::uint32_t from, std::uint32_t to) const {
    return glm::dot(area_normal(points_, face), area_normal(points_, replaced(face, from, to))) < 0.0;
}

/// Returns whether the surface stays what it is. No face turns over or comes to lie on another one. Neighbours of both
/// vertices belong to their common faces (link condition of Dey et al. 1999).
bool EdgeCollapse::may_collapse(std::uint32_t from, std::uint32_t to) const {
    list_neighbours(from, one_);
    list_neighbours(to, other_);
    std::vector<std::uint32_t> common, opposite;
    std::set_intersection(one_.begin(), one_.end(), other_.begin(), other_.end(), std::back_inserter(common));
    for (const std::uint32_t f : faces_of_[from]) {
        const WeldedFace& face = faces_[f];
        if (has(face, to)) {
            for (const std::uint32_t vertex : face)
                if (vertex != from && vertex != to) opposite.push_back(vertex);
            continue;
        }
        if (turns_over(face, from, to)) return false;
        const WeldedFace moved = sorted(replaced(face, from, to));
        for (const std::uint32_t other : faces_of_[to])
            if (sorted(faces_[other]) == moved) return false;
    }
    std::sort(opposite.begin(), opposite.end());
    opposite.erase(std::unique(opposite.begin(), opposite.end()), opposite.end());
    return !opposite.empty() && opposite == common;
}

void EdgeCollapse::drop_face(std::uint32_t face) {
    dead_[face] = true;
    for (const std::uint32_t vertex : faces_[face]) std::erase(faces_of_[vertex], face);
}

void EdgeCollapse::collapse(std::uint32_t from, std::uint32_t to) {
    const std::vector<std::uint32_t> moved = faces_of_[from];
    for (const std::uint32_t f : moved) {
        if (has(faces_[f], to)) {
            drop_face(f);
            continue;
        }
        faces_[f] = replaced(faces_[f], from, to);
        faces_of_[to].push_back(f);
    }
    faces_of_[from].clear();
    quadrics_[to].add(quadrics_[from]);
    ++changes_[from];
    ++changes_[to];
    list_neighbours(to, one_);
    const std::vector<std::uint32_t> around = one_;
    for (const std::uint32_t vertex : around) {
        push(to, vertex);
        push(vertex, to);
    }
}

void EdgeCollapse::run(double limit_m) {
    while (!waiting_.empty() && waiting_.top().cost_m2 < limit_m * limit_m) {
        const Candidate next = waiting_.top();
        waiting_.pop();
        if (changes_[next.from] != next.from_changes || changes_[next.to] != next.to_changes) continue;
        if (may_collapse(next.from, next.to)) collapse(next.from, next.to);
    }
}

void EdgeCollapse::drop(const std::vector<bool>& dropped) {
    std::size_t live = 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (!dead_[f] && dropped[live++]) drop_face(f);
}

std::vector<WeldedFace> EdgeCollapse::faces() const {
    std::vector<WeldedFace> live;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (!dead_[f]) live.push_back(faces_[f]);
    return live;
}

}  // namespace gnomon::assets
