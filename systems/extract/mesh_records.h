#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/gl/commands.h"
#include "gnomon/assets.h"

namespace gnomon {

/// Place of a mesh in the buffers of the scene. All 0: the device does not have it, and nothing of it is drawn.
struct MeshRange {
    std::int32_t base_vertex = 0;
    std::uint32_t first_index = 0;  // start of the mesh in the common index buffer
    std::uint32_t first_submesh = 0, submesh_count = 0;
    std::uint64_t triangles = 0;
    float most_reflected = 0.0f;  // maximum share of incident light toward any viewer (most_reflected())
    bool solid = false;  // closed, wound outward, opaque and single-sided throughout: a ray from outside never hits
                         // a back face first
};
struct SubmeshRange {
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
};

/// What depth passes need of a mesh to draw it (depth_runs.h), without a look at its submeshes.
struct MeshDepthFacts {
    /// Indices of its only draw, if that is opaque and in the scene's buffers. Count 0: for_each_depth_run() has them.
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t draws = 0;  // number of DepthRuns; 0: nothing of it is drawn in a depth pass
    bool solid = false;       // MeshRange::solid
    bool masked = false;      // some submesh is masked
};

/// Mesh in buffers of someone else. Depth passes draw it from there; nothing else knows its triangles.
struct EngineMesh {
    gl::BufferHandle vertices{}, indices{};
    gl::MeshLayout layout = {};  // with a stride
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t base_vertex = 0;
};

/// Returns a mesh's range without its place.
MeshRange range_of(const assets::MeshLibrary& library, const assets::Mesh& mesh);

/// Returns the number of a mesh's triangles, and their indices.
std::uint32_t triangles_of(const assets::Mesh& mesh);
std::span<const std::uint32_t> whole_triangles(const assets::Mesh& mesh);

/// Appends the geometric normal of each triangle of `indices`; zero without area. Computed in double: the cross product
/// of float edges is exact enough for a normal right to float rounding. w holds the residual of that rounding, to 2^-35
/// along each axis. It packs three signed integers of 10 bits, x lowest, in units of 2^-25 / 511 (plane_normal() in
/// shaders/lighting/gbuffer/surface_position_f64.glsl).
void append_plane_normals(std::span<const assets::Vertex> vertices, std::span<const std::uint32_t> indices,
                          std::vector<glm::vec4>& normals);

/// Appends a colour per vertex of the mesh: white without colours.
void append_colours(const assets::Mesh& mesh, std::vector<glm::vec4>& colours);

/// Bounds shaders/lighting/lights/brdf.glsl times its cosine over all directions, per unit of light. Lambert's term,
/// and GGX with D <= 1 / (pi alpha^2), V n.l <= 1 / (2 alpha), F <= 1.
float most_reflected(const assets::Material& material);

}  // namespace gnomon
