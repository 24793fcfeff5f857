#pragma once
#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "systems/embed/scene_store.h"

namespace gnomon::embed {

/// Corners and faces of a tetrahedron.
inline constexpr std::array<glm::vec3, 4> kCorners{
    glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}};
inline constexpr std::array<std::uint32_t, 12> kFaces{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};

class SceneStoreTest : public ::testing::Test {
protected:
    SceneStore store;
    std::vector<ConsumerItem> cameras{{.entity = {0, 1}, .name = "view"}};

    MeshId add_mesh() {
        const auto made = store.add_mesh({.name = "tetrahedron", .positions_m = kCorners, .indices = kFaces});
        EXPECT_TRUE(made);
        return made.value();
    }
    CasterId add_at(MeshId mesh, const glm::dvec3& at_m) {
        return store.add_caster({.mesh = mesh, .world_from_mesh = glm::translate(glm::dmat4(1.0), at_m)});
    }
    const SceneSnapshot& updated() {
        store.update(cameras);
        return store.snapshot();
    }
};

}  // namespace gnomon::embed
