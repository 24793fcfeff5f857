#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/gl/handles.h"

/// Records for shaders under shaders/ray_tracing, besides BvhNode and BvhTriangle (engine/rays), which shaders read
/// unchanged.
namespace gnomon::visibility {

/// Instance for rays; matches RayInstance in shaders/ray_tracing/bvh_buffers.glsl, five texels.
struct RayInstance {
    glm::vec3 to_model_x{0.0f};  // image of the world's x axis in mesh space
    std::uint32_t first_node = 0;
    glm::vec3 to_model_y{0.0f};
    std::uint32_t end_node = 0;  // end of the nodes to walk, relative to first_node
    glm::vec3 to_model_z{0.0f};
    std::uint32_t first_slot = 0;
    float slack_per_m = 0.0f;  // slack of mesh-space boxes, per metre of the rounded distance
    float reach_m = 0.0f;      // distance of corners from the instance's origin, along any axis
    std::uint32_t instance = 0, layers = 0;
    std::uint32_t begin_node = 0;  // first node to walk, relative to first_node
    std::uint32_t spare[3] = {};
    bool operator==(const RayInstance&) const = default;
};
static_assert(sizeof(RayInstance) == 80);

/// Head of the upper tree; matches RayTop there, two texels before the nodes: the boxes' anchor.
struct RayTop {
    glm::vec3 anchor_high{0.0f};
    std::uint32_t nodes = 0;
    glm::vec3 anchor_low{0.0f};
    float reach_m = 0.0f;
    bool operator==(const RayTop&) const = default;
};
static_assert(sizeof(RayTop) == 32);

/// Buffers for a light pass with rays: texels on units 10 to 13, masks as storage 7.
struct RayBuffers {
    gl::BufferHandle nodes{}, triangles{};
    gl::BufferHandle top{}, instances{};
    gl::BufferHandle masks{};  // {0}: no caster is masked
    bool operator==(const RayBuffers&) const = default;
};

}  // namespace gnomon::visibility
