#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/math/aabb.h"

namespace gnomon::shadow {

/// A caster as it was when a map was drawn.
struct ShownCaster {
    std::uint32_t gpu_slot = 0, mesh = 0;
    std::uint64_t version = 0;
    glm::dmat3 basis{1.0};
    glm::dvec3 translation_ws_m{0.0};
    math::Aabb bounds_ws;
    std::uint64_t bends_since = 0;  // since of its mesh's pose, or of a drawable; 0: it does not bend
    double bent_m = 0.0;            // PoseItem::bent_m, or DrawableMotion::moved_m
    std::uint64_t mesh_version = 0;
};

/// Casters that a layer shows, for lights with maps that may be kept.
struct ShownCasters {
    std::uint64_t still = 0;  // ContentSignature::still; 0: unknown
    std::vector<ShownCaster> moving;
    double proxy_m = 0.0;             // ViewError::proxy_m
    std::uint32_t waited_frames = 0;  // UpdatePlan::waited_frames for the next frame
};

}  // namespace gnomon::shadow
