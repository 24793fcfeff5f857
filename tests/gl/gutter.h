#pragma once
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>

#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon {

/// Makes the inner side of a pipe along z, 0.5 m in radius and open above, with `facets` facets across. They are single
/// faces that are seen from both sides. Beyond where it turns from a low light lies what its last averted facets
/// darken.
inline game::Shape gutter_shape(int facets, float half_length_m) {
    constexpr float kRadius_m = 0.5f;
    game::Shape shape;
    for (int i = 0; i <= facets; ++i) {
        const double angle = glm::pi<double>() * i / facets;
        const glm::vec3 out(std::cos(angle), -std::sin(angle), 0.0);
        for (const float z_m : {-half_length_m, half_length_m}) {
            shape.positions.push_back(kRadius_m * out + glm::vec3(0.0f, 0.0f, z_m));
            shape.normals.push_back(-out);
            shape.uvs.emplace_back(0.0f);
        }
        if (i == facets) break;
        const auto first = static_cast<std::uint32_t>(2 * i);
        for (const std::uint32_t corner : {0u, 2u, 1u, 1u, 2u, 3u}) shape.indices.push_back(first + corner);
    }
    return shape;
}

}  // namespace gnomon
