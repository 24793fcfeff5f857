#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "tests/system/edit_light.h"

namespace gnomon {

/// Meshes of the test library.
inline constexpr std::uint32_t kPlane = 0, kBox = 1, kMaskedBox = 2, kBlendedBox = 3, kMixedBox = 4, kSolidBox = 5;

/// Returns the meshes: a flat square of 20 m at y = 0, facing up, and boxes of 1 m around their origin. The boxes are
/// opaque, masked, blended, mixed and solid. The first half of the mixed one is opaque and its second masked. The solid
/// one is known to be so, because its topology was analysed.
assets::MeshLibrary test_library();

/// A registry with short ways to fill it.
struct TestWorld {
    ecs::Registry registry;

    ecs::Entity add_mesh(std::uint32_t mesh, const glm::dvec3& at_m, bool casts);
    /// Stands at `at_m`, looks at `target_m`.
    ecs::Entity add_camera(const glm::dvec3& at_m, const glm::dvec3& target_m);
    /// Adds a light. Sun and spot shine from `at_m` at the origin. Range 30 m for local lights.
    ecs::Entity add_light(LightKind kind, const glm::dvec3& at_m, const std::string& name, bool shadow = true);
    void move(ecs::Entity e, const glm::dvec3& to_m);
    /// Makes frames look lights up even when still, for tests of how that is done
    /// (ShadowTuning::Reuse::keep_visibility).
    void look_lights_up();

    /// A plane that receives, a box at 1 m height that casts, a camera that sees both.
    struct Stage {
        ecs::Entity plane, box, camera;
    };
    Stage add_stage();
};

/// Where a light of each kind stands in most tests.
inline constexpr glm::dvec3 kLightPlace_m{3.0, 6.0, 1.0};

}  // namespace gnomon
