#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "sample_game/support/built_in_scenes/city/parts.h"
#include "sample_game/support/built_in_scenes/textures.h"
#include "sample_game/support/built_in_scenes/tree_crown.h"

namespace gnomon::game {
namespace {

// Nothing that stands ends at the ground's own height: its foot reaches into it.
constexpr double kSunk_m = 0.3;

struct CityMaterials {
    std::uint32_t paving, asphalt, glass, slate, iron, wood, bark, needles, leaves, skin;
    std::array<std::uint32_t, 3> walls, paints;
};

CityMaterials add_materials(GlbBuilder& glb) {
    const auto plain = [&](const char* name, const glm::vec3& colour, float roughness = 0.9f) {
        return glb.add_material({.name = name, .base_colour = glm::vec4(colour, 1.0f), .roughness = roughness});
    };
    CityMaterials m{};
    m.paving = glb.add_material({.name = "paving", .texture = glb.add_texture("paving", paving_texture_png())});
    m.asphalt = plain("asphalt", {0.11f, 0.11f, 0.12f});
    m.glass = plain("glass", {0.05f, 0.07f, 0.09f}, 0.2f);
    m.slate = plain("slate", {0.16f, 0.17f, 0.19f});
    m.iron = plain("iron", {0.08f, 0.09f, 0.09f}, 0.5f);
    m.wood = plain("wood", {0.33f, 0.21f, 0.12f});
    m.bark = plain("bark", {0.16f, 0.11f, 0.07f}, 1.0f);
    m.needles = plain("needles", {0.06f, 0.15f, 0.07f}, 1.0f);
    m.skin = plain("cloth", {0.25f, 0.16f, 0.2f}, 1.0f);
    m.leaves = glb.add_material({.name = "leaves",
                                 .texture = glb.add_texture("leaves", leaf_texture_png()),
                                 .alpha_cutoff = 0.5f,
                                 .double_sided = true});
    m.walls = {plain("sandstone", {0.6f, 0.51f, 0.38f}), plain("brick", {0.42f, 0.17f, 0.11f}),
               plain("render", {0.62f, 0.62f, 0.58f})};
    m.paints = {plain("red", {0.45f, 0.04f, 0.03f}, 0.3f), plain("blue", {0.04f, 0.1f, 0.3f}, 0.3f),
                plain("silver", {0.55f, 0.56f, 0.57f}, 0.3f)};
    return m;
}

/// Makes a house of 14 by 13 m: a shaft, bands of windows that stand out a little, a ledge, a roof.
std::uint32_t add_house(GlbBuilder& glb, const CityMaterials& m, int kind) {
    constexpr double kStorey_m = 3.2, kX = 7.0, kZ = 6.5, kBand = 0.12, kLedge = 0.4;
    const int storeys = 3 + 2 * kind + kind % 2;
    const double top = storeys * kStorey_m + 0.8;
    Shape walls = make_box({-kX, -kSunk_m, -kZ}, {kX, top, kZ}), windows, roof;
    for (int storey = 0; storey < storeys; ++storey) {
        const double low = storey * kStorey_m + 1.3, side = 0.7;
        append(windows, make_box({-kX + side, low, -kZ - kBand}, {kX - side, low + 1.5, kZ + kBand}));
        append(windows, make_box({-kX - kBand, low, -kZ + side}, {kX + kBand, low + 1.5, kZ - side}));
    }
    append(walls, make_box({-kX - kLedge, top - 0.5, -kZ - kLedge}, {kX + kLedge, top + 0.1, kZ + kLedge}));
    if (kind % 2 == 0) {
        const std::array<glm::dvec2, 3> gable{glm::dvec2(-kX, 0.0), {kX, 0.0}, {0.0, 4.0}};
        append(roof, make_extrusion(gable, 2.0 * kZ), glm::translate(glm::dmat4(1.0), {0.0, top - 0.2, 0.0}));
        append(roof, make_box({2.6, top, 1.0}, {3.6, top + 4.2, 2.2}));
    } else {
        append(roof, make_box({-2.5, top, -3.0}, {2.0, top + 2.8, 1.5}));
        append(roof, make_bar({4.5, top, 3.5}, {4.5, top + 5.0, 3.5}, 0.06, 6));
    }
    const std::array<PartSpec, 3> parts{PartSpec{walls, m.walls[static_cast<std::size_t>(kind) % 3]},
                                        PartSpec{windows, m.glass}, PartSpec{roof, m.slate}};
    return glb.add_mesh("house_" + std::to_string(kind), parts);
}

std::uint32_t add_leaf_tree(GlbBuilder& glb, const CityMaterials& m) {
    const std::array<glm::dvec2, 5> trunk{
        glm::dvec2(0.0, -kSunk_m), {0.24, -kSunk_m}, {0.17, 0.4}, {0.1, 3.0}, {0.0, 3.4}};
    const Shape bark = make_lathe(trunk, 8, LatheNormals::smooth);
    const Shape crown = make_tree_crown({.radius_m = 1.9, .card_m = 1.4, .height_m = 4.2, .cards = 40});
    const std::array<PartSpec, 2> parts{PartSpec{bark, m.bark}, PartSpec{crown, m.leaves}};
    return glb.add_mesh("leaf_tree", parts);
}

std::uint32_t add_conifer(GlbBuilder& glb, const CityMaterials& m) {
    const std::array<glm::dvec2, 4> trunk{glm::dvec2(0.0, -kSunk_m), {0.2, -kSunk_m}, {0.15, 1.6}, {0.0, 1.8}};
    const std::array<glm::dvec2, 5> crown{glm::dvec2(0.0, 1.2), {1.6, 1.1}, {0.7, 3.4}, {1.1, 3.2}, {0.0, 7.0}};
    const Shape bark = make_lathe(trunk, 6, LatheNormals::smooth),
                needles = make_lathe(crown, 8, LatheNormals::creased);
    const std::array<PartSpec, 2> parts{PartSpec{bark, m.bark}, PartSpec{needles, m.needles}};
    return glb.add_mesh("conifer", parts);
}

/// Makes a post with an arm over the street, along +z. Its light hangs below the arm's end.
std::uint32_t add_post(GlbBuilder& glb, const CityMaterials& m) {
    Shape post = make_bar({0.0, -kSunk_m, 0.0}, {0.0, kLamp_m + 0.5, 0.0}, 0.07, 8);
    append(post, make_bar({0.0, kLamp_m + 0.35, 0.0}, {0.0, kLamp_m + 0.45, kLampArm_m}, 0.04, 6));
    append(post, make_box({-0.16, kLamp_m + 0.15, kLampArm_m - 0.35}, {0.16, kLamp_m + 0.42, kLampArm_m + 0.35}));
    return glb.add_mesh("post", post, m.iron);
}

std::uint32_t add_bench(GlbBuilder& glb, const CityMaterials& m) {
    Shape slats, feet;
    for (const double z : {-0.2, 0.0, 0.2}) append(slats, make_box({-0.8, 0.42, z - 0.07}, {0.8, 0.46, z + 0.07}));
    append(slats, make_box({-0.8, 0.6, 0.3}, {0.8, 0.85, 0.34}));
    for (const double x : {-0.65, 0.65}) {
        append(feet, make_box({x - 0.03, -0.1, -0.25}, {x + 0.03, 0.43, -0.18}));
        append(feet, make_box({x - 0.03, -0.1, 0.26}, {x + 0.03, 0.9, 0.32}));
    }
    const std::array<PartSpec, 2> parts{PartSpec{slats, m.wood}, PartSpec{feet, m.iron}};
    return glb.add_mesh("bench", parts);
}

std::uint32_t add_bin(GlbBuilder& glb, const CityMaterials& m) {
    const std::array<glm::dvec2, 5> outline{glm::dvec2(0.0, -0.1), {0.22, -0.1}, {0.27, 0.8}, {0.2, 0.92}, {0.0, 0.98}};
    return glb.add_mesh("bin", make_lathe(outline, 10, LatheNormals::creased), m.iron);
}

/// Makes a car of 4.4 m along z, its front at -z.
std::uint32_t add_car(GlbBuilder& glb, const CityMaterials& m, std::size_t paint) {
    constexpr double kWheel = 0.33, kHalf = 0.85;
    const std::array<glm::dvec2, 8> body{glm::dvec2(-2.2, 0.3), {2.2, 0.3},   {2.2, 0.85},  {1.7, 0.95},
                                         {-1.0, 1.0},           {-2.0, 0.85}, {-2.2, 0.75}, {-2.25, 0.5}};
    const std::array<glm::dvec2, 4> cabin{glm::dvec2(-0.9, 0.98), {1.6, 0.93}, {1.1, 1.45}, {-0.3, 1.45}};
    const glm::dmat4 along = glm::rotate(glm::dmat4(1.0), -0.5 * glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0));
    Shape shell, glass, wheels;
    append(shell, make_extrusion(body, 2.0 * kHalf), along);
    append(glass, make_extrusion(cabin, 2.0 * kHalf - 0.2), along);
    for (const double z : {-1.35, 1.35})
        append(wheels, make_bar({-kHalf - 0.04, kWheel, z}, {kHalf + 0.04, kWheel, z}, kWheel, 12));
    const std::array<PartSpec, 3> parts{PartSpec{shell, m.paints[paint]}, PartSpec{glass, m.glass},
                                        PartSpec{wheels, m.asphalt}};
    return glb.add_mesh("car_" + std::to_string(paint), parts);
}

std::uint32_t add_person(GlbBuilder& glb, const CityMaterials& m) {
    const std::array<glm::dvec2, 9> outline{
        glm::dvec2(0.0, -0.02), {0.14, -0.02}, {0.17, 0.8}, {0.23, 1.35}, {0.08, 1.46}, {0.11, 1.6}, {0.1, 1.7},
        {0.05, 1.77},           {0.0, 1.78}};
    return glb.add_mesh("person", make_lathe(outline, 8, LatheNormals::smooth), m.skin);
}

}  // namespace

CityMeshes add_city_meshes(GlbBuilder& glb) {
    const CityMaterials m = add_materials(glb);
    constexpr double kSlab = 32.0;
    CityMeshes meshes{};
    meshes.slab = glb.add_mesh("slab", make_box({-kSlab, -kSunk_m, -kSlab}, {kSlab, kCurb_m, kSlab}), m.paving);
    meshes.street =
        glb.add_mesh("street", make_card(glm::dvec3(0.0), {kBlock_m, 0.0, 0.0}, {0.0, 0.0, -kBlock_m}), m.asphalt);
    for (std::size_t i = 0; i < meshes.houses.size(); ++i) meshes.houses[i] = add_house(glb, m, static_cast<int>(i));
    for (std::size_t i = 0; i < meshes.cars.size(); ++i) meshes.cars[i] = add_car(glb, m, i);
    meshes.leaf_tree = add_leaf_tree(glb, m);
    meshes.conifer = add_conifer(glb, m);
    meshes.post = add_post(glb, m);
    meshes.bench = add_bench(glb, m);
    meshes.bin = add_bin(glb, m);
    meshes.person = add_person(glb, m);
    return meshes;
}

}  // namespace gnomon::game
