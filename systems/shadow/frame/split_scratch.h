#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/math/inner_hull.h"
#include "systems/shadow/frame/index_set.h"

namespace gnomon::shadow {

/// Reused storage of split_receivers() (culling/inner_receivers.h); its result refers to it.
struct SplitScratch {
    IndexSet wanted, marks;
    std::vector<std::uint32_t> inner, others;
    std::vector<std::uint8_t> known;  // by BoundsTree::numbers(): what is known of a box
    std::vector<glm::dvec3> corners_ws_m;
    math::InnerHull hull;
};

}  // namespace gnomon::shadow
