#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/gl/handles.h"

/// What shaders under shaders/rays read, beside BvhNode and BvhTriangle (engine/rays), which serve there as they are.
namespace gnomon::visibility {

/// Matches RayInstance in shaders/rays/scene.glsl (std430).
struct RayInstance {
    glm::vec3 to_model_x{0.0f};  // image of the world's x axis in the mesh's space
    std::uint32_t first_node = 0;
    glm::vec3 to_model_y{0.0f};
    std::uint32_t nodes = 0;
    glm::vec3 to_model_z{0.0f};
    std::uint32_t first_slot = 0;
    float slack_per_m = 0.0f;  // by which boxes of the mesh are widened, per metre of what is rounded
    float reach_m = 0.0f;      // how far corners lie from the instance's own origin, along any axis
    std::uint32_t instance = 0, layers = 0;
    bool operator==(const RayInstance&) const = default;
};
static_assert(sizeof(RayInstance) == 64);

/// Matches the head of RayTopBuffer there: what the upper tree's boxes are relative to.
struct RayTop {
    glm::vec3 anchor_high{0.0f};
    std::uint32_t nodes = 0;
    glm::vec3 anchor_low{0.0f};
    float reach_m = 0.0f;
    bool operator==(const RayTop&) const = default;
};
static_assert(sizeof(RayTop) == 32);

/// Matches RayMask in shaders/rays/alpha_mask.glsl: eight words of its buffer.
struct RayMask {
    float cutoff = 0.0f, alpha = 1.0f;
    std::uint32_t texels = ~0u;  // word of the first, four to a word; ~0: alpha alone decides
    std::uint32_t width = 0, height = 0;
    std::uint32_t wrap_u = 0, wrap_v = 0;  // assets::TextureWrap
    std::uint32_t linear = 0;
};
static_assert(sizeof(RayMask) == 32);

/// What a light pass that asks by rays binds, in this order from storage binding 3 on.
struct RayBuffers {
    gl::BufferHandle nodes{}, triangles{}, top{}, instances{};
    gl::BufferHandle masks{};  // {0}: nothing that casts is masked
    bool operator==(const RayBuffers&) const = default;
};

}  // namespace gnomon::visibility
