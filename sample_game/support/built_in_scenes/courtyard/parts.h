#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"
#include "sample_game/support/built_in_scenes/glb_writer.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

/// Builders and materials that the parts of the courtyard share.
namespace gnomon::game {

struct Materials {
    std::uint32_t paving, plaster, stone, wood, iron, brass, red, blue, leaves, cloth, bark, lamp_glow;
};

struct Kit {
    GlbBuilder& glb;
    Materials materials;
    CourtyardOptions options;
    nlohmann::ordered_json mesh_extras = {};  // extras of every node with a mesh; null: none

    std::uint32_t place(const std::string& name, std::uint32_t mesh, const glm::dvec3& at,
                        const glm::dquat& rotation = {1.0, 0.0, 0.0, 0.0},
                        std::optional<std::uint32_t> parent = {}) const {
        return glb.add_node({.name = name,
                             .parent = parent,
                             .translation_m = at,
                             .rotation = rotation,
                             .mesh = mesh,
                             .extras = mesh_extras});
    }
    std::uint32_t place(const std::string& name, const Shape& shape, std::uint32_t material, const glm::dvec3& at,
                        const glm::dquat& rotation = {1.0, 0.0, 0.0, 0.0},
                        std::optional<std::uint32_t> parent = {}) const {
        return place(name, glb.add_mesh(name, shape, material), at, rotation, parent);
    }
    /// Adds an empty node that moves; its children follow.
    std::uint32_t mover(const std::string& name, const glm::dvec3& at, nlohmann::ordered_json motion,
                        const glm::dquat& rotation = {1.0, 0.0, 0.0, 0.0}) const {
        return glb.add_node(
            {.name = name, .translation_m = at, .rotation = rotation, .extras = {{"motion", std::move(motion)}}});
    }
};

Materials add_materials(GlbBuilder& glb);
void add_architecture(const Kit& kit);  // ground, walls, arcade, stairs, fence
void add_furniture(const Kit& kit);     // tree, cloth, things that stand or move
void add_lamps(const Kit& kit);         // sun, lantern, guard lamp
void add_guard(const Kit& kit);         // guard, walking up and down
void add_game(const Kit& kit);          // what CourtyardOptions::game adds
void add_cameras(const Kit& kit);

}  // namespace gnomon::game
