#pragma once
#include <array>
#include <map>
#include <vector>

#include "systems/visibility/caster_trees.h"
#include "tests/oracle/reference_tracer.h"

/// Places of the triangles of an audit.
namespace gnomon::bench {

/// Triangles as the tracer has them: in double, also bent meshes. Scene and library must outlive this.
class TrueSurfaces {
public:
    TrueSurfaces(const SceneSnapshot& scene, const assets::MeshLibrary& library) : scene_(scene), library_(library) {}

    /// Returns whether each corner of `a` lies nearer to the plane of `b` than oracle::kJitter times its distance from
    /// the camera. False if one of them is no triangle.
    bool in_one_plane(const oracle::PlacedTriangle& a, const oracle::PlacedTriangle& b);

private:
    std::array<glm::dvec3, 3> corners_ws_m(const oracle::PlacedTriangle& triangle);

    const SceneSnapshot& scene_;
    const assets::MeshLibrary& library_;
    std::map<std::uint32_t, std::vector<glm::dvec3>> positions_;  // by mesh
};

/// Triangles as visibility queries have them: the corners of a bending mesh are rounded to float, once. A place on the
/// tracer's surface may lie below that triangle by the rounding, and would be in its shadow.
class QueriedSurfaces {
public:
    /// Refers to scene and trees, which must outlive this. The trees must be up to date with the scene.
    QueriedSurfaces(const SceneSnapshot& scene, const visibility::CasterTrees& trees) : scene_(scene), trees_(trees) {}

    /// Moves a point onto the plane that queries have for that triangle. For meshes at rest it stays.
    glm::dvec3 on_surface(const oracle::PlacedTriangle& triangle, const glm::dvec3& point_ws_m);

private:
    const std::vector<std::uint32_t>& slots_of(std::uint32_t mesh);

    const SceneSnapshot& scene_;
    const visibility::CasterTrees& trees_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> slots_;  // by mesh that bends: of each triangle in its tree
};

}  // namespace gnomon::bench
