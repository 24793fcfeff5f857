#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/rays/bvh.h"
#include "systems/extract/snapshot.h"
#include "systems/visibility/ray_records.h"

namespace gnomon::visibility {

/// Where shaders find a mesh's tree, and what is around it in its own space. No nodes: it has none.
struct MeshTreePlace {
    std::uint32_t first_node = 0, nodes = 0, first_slot = 0;
    rays::Box box;
};

/// The upper level of the trees that shaders ask: one box per instance that casts, relative to an anchor amid them, so
/// that floats hold it wherever in the world that is. Plain arrays as shaders/rays/scene.glsl reads them.
class InstanceTree {
public:
    /// Takes the snapshot's casters; `meshes` by mesh. Refits where the same ones moved, unless that has made walks
    /// kLooseGrowth times as long as when the tree was built. `same`: they are the casters of the last update.
    void update(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes, bool same);

    const RayTop& head() const { return head_; }
    std::span<const rays::BvhNode> nodes() const { return nodes_; }
    std::span<const RayInstance> instances() const { return instances_; }  // by slot; a leaf holds one
    std::uint32_t builds() const { return builds_; }
    std::size_t bytes() const;

    static constexpr double kLooseGrowth = 1.5;

private:
    void list(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes);
    void set_anchor(const SceneSnapshot& scene);
    void place(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes);
    void build();

    RayTop head_;
    glm::dvec3 anchor_ws_m_{0.0};
    std::vector<rays::BvhNode> nodes_;
    std::vector<RayInstance> instances_;
    std::vector<std::uint32_t> items_;  // of the snapshot, by slot
    std::vector<rays::Box> boxes_;      // by slot
    double built_cost_ = 0.0;
    std::uint32_t builds_ = 0;
};

}  // namespace gnomon::visibility
