#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/surface_edges.h"
#include "systems/extract/gpu_scene.h"

/// Surfaces of meshes as conservative maps need them (docs/explanation/exact_proof.md): facets, and the edges at which
/// a surface can end as a light sees it.
namespace gnomon::shadow {

/// Opaque and masked surfaces of a mesh, bent as on the device.
struct CasterTopology {
    struct Facet {
        glm::vec3 normal_ms{0.0f};  // unit, exact to float rounding; zero for a facet without area
        glm::vec3 corner_ms{0.0f};  // any of its corners
        float altitude_ms = 0.0f;   // shortest height
    };
    assets::SurfaceEdges edges;                 // edges of its opaque triangles
    std::vector<Facet> facets;                  // per triangle of the mesh's list
    std::vector<std::uint32_t> opaque, masked;  // indices of triangles; translucent ones are in neither
    glm::dvec3 reach_ms{0.0};                   // the largest coordinate of any vertex, along each axis
};

/// Surfaces of all meshes that exact lights needed. Made on first use, and again after a mesh bent or
/// another one took its number. Uses no memory before.
class CasterTopologies {
public:
    /// Returns the surface as the device has it now. Valid until the next call.
    const CasterTopology& of(const GpuScene& gpu, std::uint32_t mesh);
    /// Forgets all of them.
    void clear() {
        std::vector<Kept>().swap(kept_);
        bytes_ = 0;
    }
    std::uint64_t bytes() const { return bytes_; }

private:
    struct Kept {
        CasterTopology surface;
        std::uint64_t version = 0, mesh_version = 0;  // MeshShape's
        bool made = false;
    };
    void forget_changed(const assets::MeshLibrary& library);
    static std::uint64_t bytes_of(const CasterTopology& surface);

    std::vector<Kept> kept_;  // by mesh
    std::uint64_t bytes_ = 0, library_version_ = 0;
};

}  // namespace gnomon::shadow
