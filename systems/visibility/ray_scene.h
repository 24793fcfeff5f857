#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/ray_masks.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/report.h"
#include "systems/retry.h"
#include "systems/visibility/caster_trees.h"
#include "systems/visibility/instance_tree.h"
#include "systems/visibility/ray_records.h"

namespace gnomon::visibility {

/// Casters of a snapshot in storage buffers for rays in shaders (shaders/ray_tracing/bvh_traversal.glsl). Contains the
/// trees of CasterTrees, and one over the instances. Owns them. Uses no memory before the first update().
class RayScene {
public:
    explicit RayScene(gl::Device& device) : device_(device) {}
    ~RayScene() { release(); }
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Updates the buffers to the snapshot. Call it in each frame with rays. Trees are built once per mesh, refitted
    /// and written again if its pose changed. The upper level is written if anything moved. Returns false without room
    /// on the device; retries after Retry::kFrames such frames.
    bool update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    /// Frees everything, when no light uses rays.
    void release();
    /// Makes the next update() write everything again, after a failed submission.
    void forget_uploads() { forgotten_ = true; }

    /// Returns the buffers; {0} unless update() succeeded.
    const RayBuffers& buffers() const { return buffers_; }

    /// Reports memory use, and what the last update() wrote.
    const RayReport& report() const { return report_; }

private:
    struct Held {
        Held(gl::Device& device, const assets::MeshLibrary& library);
        CasterTrees trees;
        RayMasks masks;
        std::vector<MeshTreePlace> places;         // by mesh
        std::vector<std::uint64_t> pose_versions;  // by mesh: pose versions in the buffers
        std::size_t placed_trees = 0;
        InstanceTree instances;
        GrowingBuffer top_buffer, instance_buffer;
        std::uint64_t version = 0, list_version = 0;  // versions of the snapshot in the upper level
        std::uint64_t mesh_bytes = 0;
        std::vector<rays::BvhTriangle> scratch;
    };

    bool make_meshes(const SceneSnapshot& scene, const GpuScene& gpu);
    void rewrite_bent(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    bool stand_still(const SceneSnapshot& scene) const;
    bool write_instances(const SceneSnapshot& scene, bool all, gl::CommandList& list);
    void take_triangles(const GpuScene& gpu, std::uint32_t mesh);
    void free_meshes();
    void count();

    gl::Device& device_;
    std::optional<Held> held_;
    RayBuffers buffers_;
    RayReport report_;
    Retry retry_;
    std::uint64_t asked_ = 0;
    bool forgotten_ = false;
};

}  // namespace gnomon::visibility
