#include <glm/trigonometric.hpp>

#include "sample_game/support/built_in_scenes/city/parts.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

namespace gnomon::game {
namespace {

constexpr double kKerb_m = 30.5;  // from a block's middle to the line of trees and posts, on the slab
/// Distance from the middle block, squared, in blocks, within which lamps are lit: 69 blocks.
constexpr int kLitSquared = 20;

/// Returns a place at one of a block's four sides, which are quarter turns from -z.
glm::dvec3 at_side(const glm::dvec3& middle_m, int side, double along_m, double out_m) {
    switch (side % 4) {
        case 0:
            return middle_m + glm::dvec3(along_m, 0.0, -out_m);
        case 1:
            return middle_m + glm::dvec3(-out_m, 0.0, -along_m);
        case 2:
            return middle_m + glm::dvec3(-along_m, 0.0, out_m);
        default:
            return middle_m + glm::dvec3(out_m, 0.0, along_m);
    }
}

/// Returns the turn that has a thing's +z point away from the block at this side.
double outward_deg(int side) { return 180.0 + 90.0 * (side % 4); }

/// Adds eight houses around a court with two trees. The city's middle has the higher ones.
void add_houses(const CityKit& kit, const std::string& name, const glm::dvec3& middle_m, bool core) {
    constexpr double kWall_m = 20.0;
    const std::uint32_t kinds = core ? 6 : 4;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < 2; ++i)
            kit.place(name + "_house_" + std::to_string(2 * side + i), kit.meshes.houses[kit.below(kinds)],
                      at_side(middle_m, side, i == 0 ? -8.2 : 8.6, kWall_m) + glm::dvec3(0.0, kCurb_m, 0.0),
                      outward_deg(side));
    for (int i = 0; i < 2; ++i)
        kit.place(name + "_court_" + std::to_string(i), kit.meshes.conifer,
                  middle_m + glm::dvec3(kit.about(6.0), kCurb_m, kit.about(6.0)), 30.0 * kit.below(12));
}

void add_street_lamp(const CityKit& kit, const std::string& name, const glm::dvec3& at_m, int side,
                     std::uint32_t light) {
    const glm::dvec3 over = at_side(glm::dvec3(0.0), side, 0.0, kLampArm_m);
    kit.glb.add_node({.name = name + "_light",
                      .translation_m = at_m + over + glm::dvec3(0.0, kLamp_m, 0.0),
                      .rotation = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)),
                      .light = light});
}

/// Adds trees, posts, benches, bins, parked cars and people around a block.
/// `light`: that of its lamps; null: none are lit.
void add_sidewalk(const CityKit& kit, const std::string& name, const glm::dvec3& middle_m, const std::uint32_t* light) {
    const auto part = [&](const char* what, int i) { return name + "_" + what + "_" + std::to_string(i); };
    const glm::dvec3 up(0.0, kCurb_m, 0.0);
    for (int side = 0; side < 4; ++side) {
        for (int i = 0; i < 2; ++i)
            kit.place(part("tree", 2 * side + i), kit.meshes.leaf_tree,
                      at_side(middle_m, side, (i == 0 ? -17.0 : 11.0) + kit.about(2.0), kKerb_m) + up,
                      15.0 * kit.below(24));
        const glm::dvec3 post_m = at_side(middle_m, side, -3.0, kKerb_m + 1.0) + up;
        kit.place(part("post", side), kit.meshes.post, post_m, outward_deg(side));
        if (light) add_street_lamp(kit, part("lamp", side), post_m, side, *light);
        for (int i = 0; i < 2; ++i)
            kit.place(part("parked", 2 * side + i), kit.meshes.cars[kit.below(3)],
                      at_side(middle_m, side, (i == 0 ? -10.0 : 18.0) + kit.about(4.0), 33.4),
                      outward_deg(side) + 90.0);
        kit.place(part("person", side), kit.meshes.person,
                  at_side(middle_m, side, kit.about(24.0), 28.3 + 0.0625 * kit.below(8)) + up, 15.0 * kit.below(24));
    }
    for (int i = 0; i < 4; ++i)
        kit.place(part("bench", i), kit.meshes.bench, at_side(middle_m, i, 3.0, kKerb_m - 0.4) + up, outward_deg(i));
    for (int i = 0; i < 2; ++i)
        kit.place(part("bin", i), kit.meshes.bin, at_side(middle_m, 2 * i, 5.0, kKerb_m) + up, 0.0);
}

}  // namespace

void add_blocks(const CityKit& kit) {
    // As bright below as the low sun, so that both shadows show.
    const std::uint32_t lamp = kit.glb.add_light({.type = "spot",
                                                  .colour = {1.0, 0.72, 0.42},
                                                  .intensity = 16000.0,
                                                  .cone = ConeSpec{glm::radians(40.0), glm::radians(62.0)}});
    for (int row = 0; row < kit.options.blocks; ++row)
        for (int column = 0; column < kit.options.blocks; ++column) {
            const std::string name = "block_" + std::to_string(row) + "_" + std::to_string(column);
            const glm::dvec3 middle_m = kit.middle_m(column, row);
            const int east = column - kit.options.blocks / 2, south = row - kit.options.blocks / 2;
            const bool core = east * east + south * south <= kLitSquared;
            kit.place(name + "_street", kit.meshes.street, middle_m, 0.0);
            kit.place(name + "_slab", kit.meshes.slab, middle_m, 0.0);
            add_houses(kit, name, middle_m, core);
            add_sidewalk(kit, name, middle_m, core ? &lamp : nullptr);
        }
}

}  // namespace gnomon::game
