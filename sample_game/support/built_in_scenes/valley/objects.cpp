#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "sample_game/support/built_in_scenes/look_rotation.h"
#include "sample_game/support/built_in_scenes/tree_crown.h"
#include "sample_game/support/built_in_scenes/valley/parts.h"

namespace gnomon::game {
namespace {

// Everything that stands reaches into the ground, which is not level beneath it.
constexpr double kSunk_m = 1.5;

/// Returns place i of a sequence that spreads evenly over 0 to 1 for any number of places (Roberts' R2 sequence).
glm::dvec2 spread(int i) {
    constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
    const auto part = [&](double step) { return (i + 1) * step - std::floor((i + 1) * step); };
    return {part(kFirst), part(kSecond)};
}

void stand(const ValleyKit& kit, const std::string& name, std::uint32_t mesh, double x_m, double z_m, double turn_deg) {
    kit.glb.add_node({.name = name,
                      .translation_m = {x_m, ground_height_m(x_m, z_m), z_m},
                      .rotation = turned(turn_deg),
                      .mesh = mesh});
}

/// Adds a house's mesh: 9 by 7 m, with its ridge along z, a chimney and eaves.
std::uint32_t house_mesh(const ValleyKit& kit) {
    constexpr double kHalf = 3.5, kEaves = 4.2, kRidge = 7.0, kLength = 9.0, kSlab = 0.2, kOverhang = 0.6;
    const std::array<glm::dvec2, 5> profile{
        glm::dvec2(-kHalf, -kSunk_m), {kHalf, -kSunk_m}, {kHalf, kEaves}, {0.0, kRidge}, {-kHalf, kEaves}};
    Shape walls = make_extrusion(profile, kLength);
    append(walls, make_box({0.9, kEaves, 1.6}, {1.7, kRidge + 1.1, 2.4}));
    const double slope = std::hypot(kHalf, kRidge - kEaves), pitch = std::atan2(kRidge - kEaves, kHalf);
    Shape roof;
    for (const double side : {-1.0, 1.0}) {
        const glm::dmat4 at =
            glm::rotate(glm::translate(glm::dmat4(1.0), {0.0, kRidge, 0.0}), -side * pitch, glm::dvec3(0.0, 0.0, 1.0));
        const double far = side * (slope + kOverhang);
        append(roof,
               make_box({std::min(0.0, far), 0.02, -0.5 * kLength - kOverhang},
                        {std::max(0.0, far), 0.02 + kSlab, 0.5 * kLength + kOverhang}),
               at);
    }
    const std::array<PartSpec, 2> parts{PartSpec{walls, kit.materials.plaster}, PartSpec{roof, kit.materials.roof}};
    return kit.glb.add_mesh("house", parts);
}

std::uint32_t conifer_mesh(const ValleyKit& kit) {
    const std::array<glm::dvec2, 4> trunk{glm::dvec2(0.0, -kSunk_m), {0.25, -kSunk_m}, {0.18, 2.0}, {0.0, 2.2}};
    const std::array<glm::dvec2, 7> crown{glm::dvec2(0.0, 1.6), {2.1, 1.4}, {0.9, 4.4}, {1.6, 4.2},
                                          {0.6, 7.0},           {1.0, 6.8}, {0.0, 10.5}};
    const Shape bark = make_lathe(trunk, 7, LatheNormals::smooth),
                needles = make_lathe(crown, 9, LatheNormals::creased);
    const std::array<PartSpec, 2> parts{PartSpec{bark, kit.materials.bark}, PartSpec{needles, kit.materials.needles}};
    return kit.glb.add_mesh("conifer", parts);
}

std::uint32_t leaf_tree_mesh(const ValleyKit& kit) {
    const std::array<glm::dvec2, 5> trunk{
        glm::dvec2(0.0, -kSunk_m), {0.3, -kSunk_m}, {0.2, 0.4}, {0.12, 3.2}, {0.0, 3.6}};
    const Shape bark = make_lathe(trunk, 12, LatheNormals::smooth);
    const Shape crown = make_tree_crown({.radius_m = 2.2, .card_m = 1.3, .height_m = 4.4, .cards = 72});
    const std::array<PartSpec, 2> parts{PartSpec{bark, kit.materials.bark}, PartSpec{crown, kit.materials.leaves}};
    return kit.glb.add_mesh("leaf_tree", parts);
}

}  // namespace

void add_houses(const ValleyKit& kit) {
    constexpr int kPairs = 9, kOfHamlet = 6;
    constexpr double kAside_m = 10.0, kPitch_m = 17.0;
    const std::uint32_t house = house_mesh(kit);
    for (int i = 0; i < kPairs; ++i) {
        stand(kit, "house_west_" + std::to_string(i), house, -kAside_m, -12.0 - kPitch_m * i, 4.0 * (i % 3) - 4.0);
        stand(kit, "house_east_" + std::to_string(i), house, kAside_m + 1.0, -18.0 - kPitch_m * i,
              90.0 + 5.0 * (i % 2));
    }
    const std::array<glm::dvec2, 4> hamlets{
        glm::dvec2(260.0, -420.0), {-340.0, -560.0}, {120.0, -960.0}, {-210.0, -1500.0}};
    for (std::size_t h = 0; h < hamlets.size(); ++h)
        for (int i = 0; i < kOfHamlet; ++i) {
            const glm::dvec2 at_m = hamlets[h] + 70.0 * (spread(i) - 0.5);
            stand(kit, "hamlet_" + std::to_string(h) + "_" + std::to_string(i), house, at_m.x, at_m.y, 67.0 * i);
        }
}

void add_woods(const ValleyKit& kit) {
    constexpr int kLeafTrees = 14, kConifers = 700;
    const std::uint32_t leaf_tree = leaf_tree_mesh(kit), conifer = conifer_mesh(kit);
    for (int i = 0; i < kLeafTrees; ++i)
        stand(kit, "leaf_tree_" + std::to_string(i), leaf_tree, i % 2 == 0 ? -4.6 : 5.4, -4.0 - 11.0 * i, 41.0 * i);
    // Where houses and fields are there are none.
    constexpr double kVillage_m = 130.0;
    for (int i = 0, placed = 0; placed < kConifers; ++i) {
        const glm::dvec2 share = spread(i);
        const glm::dvec2 at_m(2200.0 * (share.x - 0.5), 260.0 - 2250.0 * share.y);
        const bool wood = std::sin(at_m.x / 83.0) + std::cos(at_m.y / 104.0) > 0.15;
        if (!wood || std::hypot(at_m.x, at_m.y + 70.0) < kVillage_m) continue;
        stand(kit, "conifer_" + std::to_string(placed++), conifer, at_m.x, at_m.y, 29.0 * i);
    }
}

void add_lane(const ValleyKit& kit) {
    constexpr int kPickets = 30, kFences = 6;
    constexpr double kFence_m = 6.0, kHigh_m = 1.1, kPicket_m = 0.03, kRail_m = 0.025, kReach_m = 0.3;
    Shape fence;
    for (int i = 0; i <= kPickets; ++i) {
        const double z = kFence_m * i / kPickets;
        append(fence, make_box({-0.012, -kReach_m, z - kPicket_m}, {0.012, kHigh_m, z + kPicket_m}));
    }
    for (const double y : {0.35, 0.85}) append(fence, make_bar({0.03, y, -0.1}, {0.03, y, kFence_m + 0.1}, kRail_m, 6));
    const std::uint32_t fence_mesh = kit.glb.add_mesh("fence", fence, kit.materials.wood);
    for (int i = 0; i < kFences; ++i)
        stand(kit, "fence_" + std::to_string(i), fence_mesh, i % 2 == 0 ? -3.4 : 4.1, 2.0 - 14.0 * (i / 2), 0.0);
    // Beside the camera of the meadow.
    stand(kit, "fence_meadow", fence_mesh, 91.0, 34.0, 70.0);

    const std::uint32_t post =
        kit.glb.add_mesh("post", make_bar({0.0, -kReach_m, 0.0}, {0.0, 7.0, 0.0}, 0.1, 10), kit.materials.wood);
    constexpr int kPosts = 8;
    for (int i = 0; i < kPosts; ++i) stand(kit, "post_" + std::to_string(i), post, 3.2, -9.0 - 24.0 * i, 0.0);

    const std::array<glm::dvec2, 8> outline{glm::dvec2(0.0, -0.02), {0.16, -0.02}, {0.2, 0.8},  {0.26, 1.35},
                                            {0.08, 1.48},           {0.12, 1.62},  {0.1, 1.76}, {0.0, 1.8}};
    const std::uint32_t person =
        kit.glb.add_mesh("person", make_lathe(outline, 16, LatheNormals::smooth), kit.materials.bark);
    stand(kit, "person_near", person, -0.9, -2.5, 0.0);
    stand(kit, "person_far", person, 0.7, -26.0, 0.0);
    stand(kit, "person_meadow", person, 89.0, 30.0, 0.0);
}

}  // namespace gnomon::game
