#pragma once
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <iterator>
#include <random>

#include "sample_game/support/built_in_scenes/primitives.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "tests/unit/rays/triangle_soup.h"
#include "tests/unit/visibility/query_scene.h"

/// Worlds and views that try to break what sheets find about a texel.
namespace gnomon::test {

using Random = std::mt19937_64;

inline double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
inline bool chance(Random& random, double share) { return between(random, 0.0, 1.0) < share; }
inline glm::dvec3 point_in(Random& random, double size_m) {
    return {between(random, -size_m, size_m), between(random, -size_m, size_m), between(random, -size_m, size_m)};
}
inline glm::dvec3 direction(Random& random) {
    glm::dvec3 d;
    do d = point_in(random, 1.0);
    while (glm::length(d) > 1.0 || glm::length(d) < 0.1);
    return glm::normalize(d);
}

inline constexpr double kWorld_m = 6.0;  // half of its side

/// Returns a random basis: at times turned, stretched or mirrored.
inline glm::dmat3 random_basis(Random& random, double size) {
    glm::dmat3 basis(size);
    if (!chance(random, 0.4))
        basis = size * glm::mat3_cast(glm::angleAxis(between(random, 0.0, 6.0), direction(random)));
    if (chance(random, 0.3)) basis[1] *= between(random, 0.05, 3.0);
    if (chance(random, 0.3)) basis[0] = -basis[0];
    return basis;
}

inline std::uint32_t add_shape(QueryScene& scene, const game::Shape& shape, std::uint32_t material) {
    return scene.add_mesh(shape.positions, shape.indices, material);
}

/// Returns a ground, and on, in and above it boxes in contact, spheres and rings that interpenetrate, and cloths. There
/// are also upright cards along the world's axes, thin bars, soups and masked cards.
inline QueryScene sheet_world(Random& random, const glm::dvec3& offset_m) {
    QueryScene scene;
    scene.offset_m = offset_m;
    assets::Material masked;
    masked.alpha_mode = assets::AlphaMode::mask;
    masked.base_colour_texture = 0;
    scene.library.materials.push_back(masked);
    assets::Texture holes{.name = "holes", .width = 4, .height = 4, .rgba = {}, .linear_filter = false};
    for (int i = 0; i < 16; ++i)
        holes.rgba.insert(holes.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>((i / 4 + i) % 2 * 255)});
    scene.library.textures.push_back(holes);

    const std::uint32_t shapes[] = {
        scene.add_cube(),
        scene.add_square(),
        add_shape(scene, game::make_sphere(0.5, 24, 12), 0),
        add_shape(scene, game::make_ring(0.5, 0.05, 32, 8), 0),
        add_shape(scene, game::make_cloth(1.0, 1.0, 0.1, 3.0, 24, 24), 0),
        add_shape(scene, game::make_bar({0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}, 0.01, 6), 0),
        scene.add_square(1),
    };
    if (chance(random, 0.9)) scene.place_floor(2.0 * kWorld_m);
    const auto count = static_cast<int>(between(random, 3.0, 14.0));
    for (int i = 0; i < count; ++i) {
        const std::uint32_t mesh = shapes[random() % std::size(shapes)];
        glm::dvec3 at = 0.7 * point_in(random, kWorld_m);
        at.y = std::abs(at.y) * 0.5;
        const double size = std::exp(between(random, std::log(0.1), std::log(4.0)));
        glm::dmat3 basis = random_basis(random, size);
        if (mesh == shapes[0] && chance(random, 0.5)) {  // stands on the ground: faces touch
            basis = glm::dmat3(size);
            at.y = 0.5 * size;
        }
        scene.place(mesh, at, basis);
    }
    if (chance(random, 0.6)) {
        const auto kind = static_cast<Soup>(random() % static_cast<std::uint64_t>(Soup::count));
        assets::Mesh mesh = soup(kind, 20 + random() % 300, 1.0, random);
        scene.library.meshes.push_back(std::move(mesh));
        scene.place(static_cast<std::uint32_t>(scene.library.meshes.size() - 1), {0.0, 1.0, 0.0},
                    random_basis(random, between(random, 0.2, 4.0)));
    }
    for (std::uint32_t i = 0; i < scene.snapshot.instances.size(); ++i) scene.snapshot.instances[i].gpu_slot = i;
    scene.snapshot.gpu_slot_count = static_cast<std::uint32_t>(scene.snapshot.instances.size());
    scene.finish();
    return scene;
}

/// Returns a ground below needles that lie nearly flat. They may be so narrow that they have next to none of a texel's
/// width: a rasteriser may make anything of them.
inline QueryScene needle_world(Random& random) {
    QueryScene scene;
    scene.place_floor(2.0 * kWorld_m);
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const glm::dvec3 a = 0.8 * point_in(random, kWorld_m),
                         along = glm::dvec3(1.0, 0.1, 1.0) * point_in(random, 1.0);
        const glm::dvec3 across = std::pow(10.0, -between(random, 4.0, 9.0)) * point_in(random, 1.0);
        for (const glm::dvec3& corner : {a, a + along, a + 0.5 * along + across}) {
            indices.push_back(static_cast<std::uint32_t>(points.size()));
            points.emplace_back(glm::dvec3(corner.x, std::abs(a.y) + corner.y - a.y + 0.5, corner.z));
        }
    }
    scene.place(scene.add_mesh(points, indices), {});
    for (std::uint32_t i = 0; i < scene.snapshot.instances.size(); ++i) scene.snapshot.instances[i].gpu_slot = i;
    scene.snapshot.gpu_slot_count = static_cast<std::uint32_t>(scene.snapshot.instances.size());
    scene.finish();
    return scene;
}

/// Finds a place of a triangle at a random corner between texels, or next to it. Such a place is farthest from any
/// texel's middle. False: the triangle does not show there.
inline bool corner_place(const shadow::ShadowView& view, std::uint32_t size_px, const glm::dvec3 (&corners_ws_m)[3],
                         Random& random, glm::dvec3& at_ws_m) {
    glm::dvec4 clip[3];
    glm::dvec2 low(1.0), high(-1.0);
    for (int c = 0; c < 3; ++c) {
        clip[c] = glm::dmat4(view.clip_from_anchor) * glm::dvec4(corners_ws_m[c] - view.pose.anchor_ws_m, 1.0);
        if (!(clip[c].w > 0.0)) return false;
        low = glm::min(low, glm::dvec2(clip[c]) / clip[c].w);
        high = glm::max(high, glm::dvec2(clip[c]) / clip[c].w);
    }
    low = glm::clamp(low, -1.0, 1.0);
    high = glm::clamp(high, -1.0, 1.0);
    if (low.x > high.x || low.y > high.y) return false;
    const glm::dvec2 texel = (glm::dvec2(between(random, low.x, high.x), between(random, low.y, high.y)) * 0.5 + 0.5) *
                             static_cast<double>(size_px);
    const double aside = std::pow(10.0, between(random, -8.0, -1.5));
    const glm::dvec2 place =
        (glm::round(texel) + aside * glm::dvec2(between(random, -1.0, 1.0), between(random, -1.0, 1.0))) /
            static_cast<double>(size_px) * 2.0 -
        1.0;
    // Weights l of the corners with sum l (xy - place w) = 0.
    const auto across = [&](int c) { return glm::dvec2(clip[c]) - place * clip[c].w; };
    const auto area = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec3 weights(area(across(1), across(2)), area(across(2), across(0)), area(across(0), across(1)));
    const double sum = weights.x + weights.y + weights.z;
    if (!(glm::abs(sum) > 0.0) || glm::min(weights.x / sum, glm::min(weights.y / sum, weights.z / sum)) < 0.0)
        return false;
    at_ws_m = corners_ws_m[0] + (weights.y / sum) * (corners_ws_m[1] - corners_ws_m[0]) +
              (weights.z / sum) * (corners_ws_m[2] - corners_ws_m[0]);
    return true;
}

/// Returns places on surfaces: anywhere on them, along their edges, at corners between texels. They lie on their
/// triangles in double.
inline std::vector<visibility::Place> places_on(const QueryScene& scene, std::span<const shadow::ShadowView> views,
                                                std::uint32_t size_px, Random& random, std::size_t count) {
    std::vector<visibility::Place> places;
    while (places.size() < count) {
        const InstanceItem& item = scene.snapshot.instances[random() % scene.snapshot.instances.size()];
        const assets::Mesh& mesh = scene.library.meshes[item.mesh];
        const std::size_t triangle = random() % (mesh.indices.size() / 3);
        glm::dvec3 corners[3];
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = item.basis * glm::dvec3(mesh.vertices[mesh.indices[3 * triangle + c]].position_ms) +
                         item.translation_ws_m;
        for (int i = 0; i < 16 && places.size() < count; ++i) {
            glm::dvec3 at_ws_m;
            if (i % 2 == 0 && corner_place(views[random() % views.size()], size_px, corners, random, at_ws_m)) {
                places.push_back({at_ws_m, 0.0});
                continue;
            }
            double u = between(random, 0.0, 1.0), v = between(random, 0.0, 1.0);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            if (i % 3 == 0) v *= std::pow(10.0, -between(random, 0.0, 6.0));
            places.push_back({corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]), 0.0});
        }
    }
    return places;
}

}  // namespace gnomon::test
