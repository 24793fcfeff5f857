#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/device_arrays.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/mask_buffer.h"
#include "systems/extract/ray_masks.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/retry.h"
#include "systems/visibility/caster_trees.h"
#include "systems/visibility/instance_tree.h"
#include "systems/visibility/ray_records.h"

namespace gnomon::visibility {

/// Casters of a snapshot in storage buffers for rays in shaders (shaders/ray_tracing/bvh_traversal.glsl). Contains the
/// trees of CasterTrees, and one over the instances. Owns them. Uses no memory before the first update().
class RayScene {
public:
    explicit RayScene(gl::Device& device)
        : device_(device), nodes_(device), triangles_(device), masks_(device, "ray masks") {}
    ~RayScene() { release(); }
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Updates the buffers to the snapshot. Call it in each frame with rays. Trees are built once per mesh, refitted
    /// and written again if its pose changed. Meshes that come to the library later or go leave the others as they are.
    /// The upper level is written if anything moved. Returns false without room on the device; retries after
    /// Retry::kFrames such frames.
    bool update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    /// Frees everything, when no light uses rays.
    void release();
    /// Notes the result of a submission; call it after each. `executed` false: the next update() writes everything.
    void submitted(bool executed);

    /// Returns the buffers; {0} unless update() succeeded.
    const RayBuffers& buffers() const { return buffers_; }

    /// Reports memory use, and what the last update() wrote.
    const RayReport& report() const { return report_; }

private:
    /// What of a mesh's tree lies in the buffers.
    struct Taken {
        std::uint32_t nodes = 0, triangles = 0;  // places
        std::uint64_t mesh_version = 0;          // MeshLibrary::version_of()
        std::uint64_t pose_version = 0;
    };
    enum class Followed : std::uint8_t { same, changed, failed };
    struct State {
        State(gl::Device& device, const assets::MeshLibrary& library);
        CasterTrees trees;
        RayMasks masks;
        std::vector<MeshTreePlace> places;  // by mesh
        std::vector<Taken> taken;           // by mesh
        std::size_t placed_trees = 0;
        InstanceTree instances;
        GrowingBuffer top_buffer, instance_buffer;
        std::uint64_t version = 0, list_version = 0;  // versions of the snapshot in the upper level
        std::vector<rays::BvhTriangle> scratch;
    };

    bool make_meshes(const SceneSnapshot& scene, const GpuScene& gpu);
    Followed follow_meshes(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    bool take_away_changed();
    bool place_mesh(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t mesh, gl::CommandList& list);
    void note_place(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t mesh, std::uint32_t first_node,
                    std::uint32_t first_slot);
    void name_buffers();
    void rewrite_bent(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    bool stand_still(const SceneSnapshot& scene) const;
    bool write_instances(const SceneSnapshot& scene, bool all, gl::CommandList& list);
    void take_triangles(const GpuScene& gpu, std::uint32_t mesh);
    void free_meshes();
    void count();

    gl::Device& device_;
    DeviceArrays nodes_, triangles_;
    MaskBuffer masks_;
    std::optional<State> state_;
    RayBuffers buffers_;
    RayReport report_;
    Retry retry_;
    std::uint64_t calls_ = 0;
    bool forgotten_ = false;
};

}  // namespace gnomon::visibility
