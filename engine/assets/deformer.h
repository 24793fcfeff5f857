#pragma once
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/aabb.h"

namespace gnomon::assets {

struct Mesh;
struct Vertex;

/// How a mesh bends: each vertex follows joints, or is moved by morph targets, or both (glTF 2.0, 3.7.2.2 and 3.7.3.3).
/// Targets come first, then joints.
struct Deformer {
    struct Influence {
        std::uint32_t joint = 0;
        float weight = 0.0f;  // above 0; those of a vertex sum to 1
    };
    struct Target {
        std::vector<glm::vec3> positions, normals;  // added to each vertex in full; or none at all
        math::Aabb reach;                           // of all positions and 0
    };
    std::vector<std::uint32_t> first_influence;  // per vertex, and one more; none at all: no vertex follows a joint
    std::vector<Influence> influences;
    std::vector<Target> targets;
    std::vector<math::Aabb> joint_bounds_ms;  // up to the last joint of a vertex: those at rest that triangles have

    bool has_skin() const { return !first_influence.empty(); }
};

/// What bends a mesh now. Matrices take its own space at rest to where the bent mesh is wanted; one per joint of the
/// skin. Weights: one per target, those left out count as 0.
struct MeshPose {
    std::span<const glm::dmat4x3> joints;
    std::span<const float> weights;
};

/// Bounds of the joints' and targets' vertices, those that no triangle has left out. Call once all else is filled in.
void measure(Deformer& deformer, const Mesh& mesh);

/// The mesh's vertices in the pose, in double, rounded once. `pose.joints` may be empty if the mesh follows none.
void deform(const Mesh& mesh, const MeshPose& pose, std::vector<Vertex>& out);

/// A box that holds every vertex that deform() gives for the pose, those that no triangle has left out. It costs a box
/// per joint: a point that follows several lies between where each of them alone would take it.
math::Aabb posed_bounds(const Mesh& mesh, const MeshPose& pose);

/// A bound on how far any vertex is from one pose to the other, those that no triangle has left out; at the cost of
/// posed_bounds(). Both have as many joints.
double farthest_bend_m(const Mesh& mesh, const MeshPose& before, const MeshPose& after);

/// Whether the pose turns the mesh inside out, as a mirror does: every joint that a vertex follows does (all), or some.
enum class Mirroring : std::uint8_t { none, some, all };
Mirroring mirroring(const Mesh& mesh, const MeshPose& pose);

}  // namespace gnomon::assets
