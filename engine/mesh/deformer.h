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

/// Deformation of a mesh: vertices follow joints, morph targets, or both (glTF 2.0, 3.7.2.2 and 3.7.3.3). Targets apply
/// first, then joints.
struct Deformer {
    struct Influence {
        std::uint32_t joint = 0;
        float weight = 0.0f;  // > 0; the weights of a vertex sum to 1
    };
    struct Target {
        std::vector<glm::vec3> positions, normals;  // offsets at weight 1, one per vertex; or empty
        math::Aabb reach;                           // box around all positions and 0
    };
    std::vector<std::uint32_t> first_influence;  // per vertex, plus one; empty: no vertex follows a joint
    std::vector<Influence> influences;
    std::vector<Target> targets;
    /// At rest, up to the last joint that a vertex follows; only vertices with a triangle count.
    std::vector<math::Aabb> joint_bounds_ms;

    bool has_skin() const { return !first_influence.empty(); }
};

/// Current pose of a mesh. `joints`: one matrix per joint of the skin, from mesh space at rest to the space of the
/// result. `weights`: one per target; missing ones count as 0.
struct MeshPose {
    std::span<const glm::dmat4x3> joints;
    std::span<const float> weights;
};

/// Computes the bounds of joints and targets, over vertices with a triangle. Call it last, after filling in all other
/// fields.
void measure(Deformer& deformer, const Mesh& mesh);

/// Computes the mesh's vertices in the pose, in double, rounded once. `pose.joints` may be empty if the mesh has no
/// skin.
void deform(const Mesh& mesh, const MeshPose& pose, std::vector<Vertex>& out);

/// Computes a box around every vertex of deform() that has a triangle. Costs one box per joint. Conservative: a vertex
/// that follows several joints lies between the places where each joint alone would take it.
math::Aabb posed_bounds(const Mesh& mesh, const MeshPose& pose);

/// Bounds the distance that any vertex with a triangle moves between two poses. Costs the same as posed_bounds(). Both
/// poses have equally many joints.
double farthest_bend_m(const Mesh& mesh, const MeshPose& before, const MeshPose& after);

/// Result of testing a pose for mirroring, which turns a mesh inside out. `all`: every joint that a vertex follows
/// mirrors; `some`: only a part of them.
enum class Mirroring : std::uint8_t { none, some, all };
Mirroring mirroring(const Mesh& mesh, const MeshPose& pose);

}  // namespace gnomon::assets
