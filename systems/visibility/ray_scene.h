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

/// A snapshot's casters as shaders ask them by rays (shaders/ray_tracing/bvh_traversal.glsl): the trees of CasterTrees,
/// and one over the instances, in storage buffers. Owns them. Holds nothing until update() is called for the first
/// time.
class RayScene {
public:
    explicit RayScene(gl::Device& device) : device_(device) {}
    ~RayScene() { release(); }
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Brings the buffers up to the snapshot: to be called in each frame that asks by rays. Trees are built once per
    /// mesh, refitted and written again where it bent; the level above is written where something moved. False if the
    /// device has no room; it is asked again after Retry::kFrames such frames.
    bool update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    /// Nobody asks any more: frees all of it.
    void release();
    /// A submission failed: the next update() writes all of it again.
    void forget_uploads() { forgotten_ = true; }

    /// {0} unless update() succeeded.
    const RayBuffers& buffers() const { return buffers_; }

    /// What is held; written: by the last update().
    const RayReport& report() const { return report_; }

private:
    struct Held {
        Held(gl::Device& device, const assets::MeshLibrary& library);
        CasterTrees trees;
        RayMasks masks;
        std::vector<MeshTreePlace> places;         // by mesh
        std::vector<std::uint64_t> pose_versions;  // by mesh: of what the buffers hold
        std::size_t placed_trees = 0;
        InstanceTree instances;
        GrowingBuffer top_buffer, instance_buffer;
        std::uint64_t version = 0, list_version = 0;  // of the snapshot that the upper level is of
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
