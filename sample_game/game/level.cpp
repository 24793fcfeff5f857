#include "sample_game/game/level.h"

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string>

#include "sample_game/game/stairs.h"

namespace gnomon::game {
namespace {

/// Solid as a whole: the box of the node's mesh.
constexpr std::array kWholeSolids{"wall_north",  "wall_west", "wall_east", "column_0",    "column_1",
                                  "column_2",    "column_3",  "column_4",  "column_5",    "handrail",
                                  "fence_posts", "crate_a",   "crate_b",   "barrel_a",    "barrel_b",
                                  "pedestal",    "ball",      "pot",       "cart_box",    "screen_a",
                                  "screen_b",    "parapet_s", "parapet_e", "gate_post_n", "gate_post_s"};

/// Solid in part: what stands on the ground, in the node's frame. The rest hangs above the player's head.
struct PartSolid {
    const char* node;
    double min_x, max_x, min_z, max_z, max_y;
};
constexpr std::array kPartSolids{
    PartSolid{"gallows", -1.75, -1.57, -0.09, 0.09, 0.3},   PartSolid{"tree_trunk", -0.2, 0.2, -0.2, 0.2, 2.5},
    PartSolid{"guard_mast", -0.11, 0.11, -0.11, 0.11, 0.0}, PartSolid{"cloth_line", -1.53, -1.47, -0.03, 0.03, 0.0},
    PartSolid{"cloth_line", 1.47, 1.53, -0.03, 0.03, 0.0},  PartSolid{"sign_frame", -0.64, -0.56, -0.04, 0.04, 0.0},
    PartSolid{"sign_frame", 0.56, 0.64, -0.04, 0.04, 0.0},  PartSolid{"turnstile_arms", -0.1, 0.1, -0.1, 0.1, 1.5}};
constexpr const char* kStairs = "stairs";
constexpr double kFarBelow_m = -20.0;
constexpr std::array kLamps{"lantern", "guard_lamp"};

const glm::dvec3 kStart_m(-8.2, 0.0, 9.6);
const math::Aabb kGoal{{9.4, -1.0, 8.2}, {11.5, 1.0, 10.4}};

std::optional<std::size_t> find_node(const assets::SceneData& scene, const std::string& name) {
    const auto at = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const assets::Node& node) { return node.name == name; });
    if (at == scene.nodes.end()) return std::nullopt;
    return static_cast<std::size_t>(at - scene.nodes.begin());
}

Error missing(const std::string& name) {
    return {.message = "the game's scene has no '" + name + "'", .rule = "game.level"};
}

}  // namespace

Result<Level> courtyard_level(const assets::SceneData& scene) {
    const auto player = find_node(scene, "player"), sun = find_node(scene, "sun");
    if (!player) return missing("player");
    if (!sun) return missing("sun");
    const std::array left_out{static_cast<std::int32_t>(*player)};
    Level level{.nodes = scene.nodes,
                .occluders = Occluders(scene, left_out),
                .start_m = kStart_m,
                .start_yaw_rad = -0.5 * glm::pi<double>(),
                .goal = kGoal,
                .player = static_cast<std::int32_t>(*player),
                .sun = static_cast<std::int32_t>(*sun)};
    for (const char* name : kWholeSolids) {
        const auto node = find_node(scene, name);
        if (!node || scene.nodes[*node].mesh == assets::kNone) return missing(name);
        const math::Aabb& box = scene.meshes[static_cast<std::size_t>(scene.nodes[*node].mesh)].bounds_ms;
        level.solids.push_back({*node, box.min, box.max});
    }
    const auto stairs = find_node(scene, kStairs);
    if (!stairs || scene.nodes[*stairs].mesh == assets::kNone) return missing(kStairs);
    for (const Solid& tread : treads_of(scene.meshes[static_cast<std::size_t>(scene.nodes[*stairs].mesh)], *stairs))
        level.solids.push_back(tread);
    for (const PartSolid& part : kPartSolids) {
        const auto node = find_node(scene, part.node);
        if (!node) return missing(part.node);
        level.solids.push_back({*node, {part.min_x, kFarBelow_m, part.min_z}, {part.max_x, part.max_y, part.max_z}});
    }
    for (const char* name : kLamps) {
        const auto node = find_node(scene, name);
        if (!node || scene.nodes[*node].light == assets::kNone) return missing(name);
        level.lamps.push_back({*node, scene.lights[static_cast<std::size_t>(scene.nodes[*node].light)]});
    }
    return level;
}

}  // namespace gnomon::game
