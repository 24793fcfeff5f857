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
    std::span<const rays::BvhNode> tree;  // empty: the mesh bends, and its nodes may come to lie otherwise
};

/// The upper level of the trees that shaders ask: a box per instance that casts, or several of a large one, relative to
/// an anchor amid them, so that floats hold it wherever in the world that is. Plain arrays as
/// shaders/ray_tracing/bvh_buffers.glsl reads them.
class InstanceTree {
public:
    /// Takes the snapshot's casters; `meshes` by mesh. Refits where the same ones moved, unless that has made walks
    /// kLooseGrowth times as long as when the tree was built. `same`: they are the casters of the last update.
    void update(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes, bool same);

    const RayTop& head() const { return head_; }
    std::span<const rays::BvhNode> nodes() const { return nodes_; }
    std::span<const RayInstance> parts() const { return records_; }  // by slot; a leaf holds one
    std::size_t instances() const { return instances_; }             // that they are parts of
    std::uint32_t builds() const { return builds_; }
    std::size_t bytes() const;

    static constexpr double kLooseGrowth = 1.5;
    /// So many more parts than instances at most. Samples of the rays' pass in one run of Sponza: 2531 with 256 of
    /// them, 2313 with 1024, 2297 with 4096.
    static constexpr std::size_t kMostOpened = 1024;

private:
    /// An instance of the snapshot, or those triangles of it that lie below one node of its mesh's tree.
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
