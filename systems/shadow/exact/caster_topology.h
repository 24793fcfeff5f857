#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/assets/surface_edges.h"
#include "systems/extract/gpu_scene.h"

/// Sheets and contours (docs/exact.md): what of a mesh's surface tells a light where it ends.
namespace gnomon::shadow {

/// A mesh's opaque and masked surfaces, bent as the device has them.
struct CasterSurface {
    struct Facet {
        glm::vec3 normal_ms{0.0f};  // unit, right to float rounding; zero where there is no area
        glm::vec3 corner_ms{0.0f};  // any of its corners
        float altitude_ms = 0.0f;   // of its shortest height
    };
    assets::SurfaceEdges edges;                 // of its opaque triangles
    std::vector<Facet> facets;                  // per triangle of the mesh's list
    std::vector<std::uint32_t> opaque, masked;  // which those are; blended ones are neither
    glm::dvec3 reach_ms{0.0};                   // the largest coordinate of any vertex, along each axis
};

/// The surfaces of all meshes that an exact light has asked for: made when first asked for, made anew where a mesh was
/// bent since. Holds not a byte before.
class CasterSurfaces {
public:
    /// As the device has it now. Valid until the next call.
    const CasterSurface& of(const GpuScene& gpu, std::uint32_t mesh);
    /// Forgets all of them.
    void clear() {
        std::vector<Kept>().swap(kept_);
        bytes_ = 0;
    }
    std::uint64_t bytes() const { return bytes_; }

private:
    struct Kept {
        CasterSurface surface;
        std::uint64_t version = 0;  // MeshShape::version
        bool made = false;
    };
    static std::uint64_t bytes_of(const CasterSurface& surface);

    std::vector<Kept> kept_;  // by mesh
    std::uint64_t bytes_ = 0;
};

}  // namespace gnomon::shadow
