#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/rays/bvh.h"
#include "systems/extract/snapshot.h"
#include "systems/visibility/ray_records.h"

namespace gnomon::visibility {

/// Place of a mesh's tree in the shaders' buffers, and its box in mesh space. `nodes` is 0 without a tree.
struct MeshTreePlace {
    std::uint32_t first_node = 0, nodes = 0, first_slot = 0;
    rays::Box box;
    std::span<const rays::BvhNode> tree;  // empty for a deformable mesh, because its nodes may be reordered
};

/// Upper level of the trees for shaders: a box per casting instance, or several of a large one. Boxes are relative to
/// an anchor in their middle, so that floats suffice anywhere in the world. Plain arrays for
/// shaders/ray_tracing/bvh_buffers.glsl.
class InstanceTree {
public:
    /// Updates the tree to the snapshot's casters; `meshes` by mesh. Refits if the same casters moved, unless walks
    /// then cost kLooseGrowth times as much as when the tree was built. `same`: the casters are those of the last
    /// update.
    void update(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes, bool same);

    const RayTop& head() const { return head_; }
    std::span<const rays::BvhNode> nodes() const { return nodes_; }
    std::span<const RayInstance> parts() const { return records_; }  // by slot; a leaf has one
    std::size_t instances() const { return instances_; }             // number of instances behind the parts
    std::uint32_t builds() const { return builds_; }
    std::size_t bytes() const;

    static constexpr double kLooseGrowth = 1.5;
    /// Maximum number of parts beyond the instances. Samples of the ray pass in a run of Sponza: 2531 with 256 parts,
    /// 2313 with 1024, 2297 with 4096.
    static constexpr std::size_t kMostOpened = 1024;

private:
    /// Instance of the snapshot, or its triangles below one node of its mesh's tree.
    struct Part {
        std::uint32_t item = 0, begin_node = 0, end_node = 0;
    };
    void list(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes);
    void open(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes);
    void set_anchor(const SceneSnapshot& scene);
    void place(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes);
    void build();

    RayTop head_;
    glm::dvec3 anchor_ws_m_{0.0};
    std::vector<rays::BvhNode> nodes_;
    std::vector<RayInstance> records_;  // by slot
    std::vector<Part> parts_;           // by slot
    std::vector<rays::Box> boxes_;      // by slot
    std::size_t instances_ = 0;
    double built_cost_ = 0.0;
    std::uint32_t builds_ = 0;
};

}  // namespace gnomon::visibility
