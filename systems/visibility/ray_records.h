#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/gl/handles.h"

/// What shaders under shaders/rays read, beside BvhNode and BvhTriangle (engine/rays), which serve there as they are.
namespace gnomon::visibility {

/// Matches RayInstance in shaders/ray_tracing/bvh_buffers.glsl, five texels.
struct RayInstance {
    glm::vec3 to_model_x{0.0f};  // image of the world's x axis in the mesh's space
    std::uint32_t first_node = 0;
    glm::vec3 to_model_y{0.0f};
    std::uint32_t end_node = 0;  // of the nodes, from the mesh's first on, to be walked
    glm::vec3 to_model_z{0.0f};
    std::uint32_t first_slot = 0;
    float slack_per_m = 0.0f;  // by which boxes of the mesh are widened, per metre of what is rounded
    float reach_m = 0.0f;      // how far corners lie from the instance's own origin, along any axis
    std::uint32_t instance = 0, layers = 0;
    std::uint32_t begin_node = 0;  // of those nodes
    std::uint32_t spare[3] = {};
    bool operator==(const RayInstance&) const = default;
};
static_assert(sizeof(RayInstance) == 80);

/// Matches RayTop there, two texels before the upper tree's nodes: what its boxes are relative to.
struct RayTop {
    glm::vec3 anchor_high{0.0f};
    std::uint32_t nodes = 0;
    glm::vec3 anchor_low{0.0f};
    float reach_m = 0.0f;
    bool operator==(const RayTop&) const = default;
};
static_assert(sizeof(RayTop) == 32);

/// What a light pass that asks by rays binds: as texels on units 10 to 13, masks as storage 7.
struct RayBuffers {
    gl::BufferHandle nodes{}, triangles{};
    gl::BufferHandle top{}, instances{};
    gl::BufferHandle masks{};  // {0}: nothing that casts is masked
    bool operator==(const RayBuffers&) const = default;
};

}  // namespace gnomon::visibility
