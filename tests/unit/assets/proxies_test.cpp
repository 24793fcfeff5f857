// Coarser surfaces and their bounds: no sampled point is farther away than is stated, and some point is nearly as far.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "engine/mesh/mesh_weld.h"
#include "engine/mesh/proxies/coarser_surface.h"
#include "engine/mesh/proxies/surface_distance.h"
#include "sample_game/support/built_in_scenes/city/city.h"
#include "sample_game/support/built_in_scenes/primitives.h"
#include "sample_game/support/built_in_scenes/valley/valley.h"
#include "tests/data/data_files.h"
#include "tests/long_run.h"
#include "tests/unit/assets/cube_mesh.h"

namespace gnomon::assets {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr const char* kSlow = "minutes under sanitizers; random surfaces run the same code";

/// Returns the number of samples per surface: more by GNOMON_PROXY_SAMPLES, for a run that takes hours.
std::size_t samples_wanted() {
    const char* more = std::getenv("GNOMON_PROXY_SAMPLES");
    return more ? std::strtoul(more, nullptr, 10) : 3000;
}

struct Soup {
    std::vector<glm::dvec3> points;
    std::vector<WeldedFace> faces;
};

std::vector<TriangleCorners> corners_of(const Soup& soup, const std::vector<WeldedFace>& faces) {
    std::vector<TriangleCorners> corners;
    for (const WeldedFace& f : faces) corners.push_back({soup.points[f[0]], soup.points[f[1]], soup.points[f[2]]});
    return corners;
}

Soup soup_of(const Mesh& mesh) {
    Soup soup;
    const std::vector<std::uint32_t> welded = weld_by_position(mesh.vertices);
    soup.points.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < welded.size(); ++v) soup.points[welded[v]] = glm::dvec3(mesh.vertices[v].position_ms);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        soup.faces.push_back({welded[mesh.indices[i]], welded[mesh.indices[i + 1]], welded[mesh.indices[i + 2]]});
    return soup;
}

Mesh mesh_from(const game::Shape& shape) {
    Mesh mesh;
    for (const glm::vec3& position : shape.positions) mesh.vertices.push_back({position, {}, {}});
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(shape.indices.size()), 0}};
    complete(mesh);
    return mesh;
}

MeshLibrary library_of(Mesh mesh) {
    MeshLibrary library;
    library.materials.emplace_back();
    library.meshes.push_back(std::move(mesh));
    return library;
}

/// Median of stated bounds over distances that were found. The proof ends at one and a half, or at a slack that counts
/// for the smallest.
constexpr double kMostRatio = 2.0;

/// Returns the farthest of evenly spread points of `from`, measured against every triangle of `to`: no tree, no proof.
double farthest_sample_m(const std::vector<TriangleCorners>& from, const std::vector<TriangleCorners>& to,
                         std::size_t samples, bool by_tree) {
    const TriangleTree tree(to);
    std::vector<double> areas;
    for (const TriangleCorners& t : from) areas.push_back(glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) + 1e-300);
    std::mt19937 random(7);
    std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
    std::uniform_real_distribution<double> part(0.0, 1.0);
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        const TriangleCorners& t = from[choose(random)];
        double u = part(random), v = part(random);
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        const glm::dvec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
        double nearest_m = by_tree ? tree.nearest(p, kInfinity).distance_m : kInfinity;
        for (std::size_t k = 0; !by_tree && k < to.size(); ++k) nearest_m = std::min(nearest_m, distance_to(to[k], p));
        farthest_m = std::max(farthest_m, nearest_m);
    }
    return farthest_m;
}

/// Checks every form of a surface. Returns bound over what was found, of each.
std::vector<double> check_forms(const Soup& soup, const std::string& name, std::size_t samples, bool by_tree) {
    std::vector<double> ratios;
    const auto whole = corners_of(soup, soup.faces);
    std::size_t last = soup.faces.size();
    double last_m = 0.0;
    for (const CoarserSurface& form : coarser_surfaces(soup.points, soup.faces)) {
        EXPECT_LT(form.faces.size(), last) << name;
        EXPECT_GT(form.bound_m, last_m) << name;
        EXPECT_LE(form.found_m, form.bound_m) << name;
        last = form.faces.size();
        last_m = form.bound_m;
        if (form.faces.empty()) continue;
        const auto coarse = corners_of(soup, form.faces);
        EXPECT_LE(farthest_sample_m(whole, coarse, samples, by_tree), form.bound_m) << name;
        EXPECT_LE(farthest_sample_m(coarse, whole, samples, by_tree), form.bound_m) << name;
        ratios.push_back(form.bound_m / std::max(form.found_m, 1e-30));
    }
    return ratios;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

TEST(Proxies, DistanceToATriangleIsThatOfItsNearestPoint) {
    const TriangleCorners t{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 3, 0}};
    EXPECT_DOUBLE_EQ(distance_to(t, {1, 1, 2}), 2.0);                   // above the inside
    EXPECT_DOUBLE_EQ(distance_to(t, {-3, -4, 0}), 5.0);                 // beyond a corner
    EXPECT_DOUBLE_EQ(distance_to(t, {2, -1.5, 2}), 2.5);                // beside an edge
    EXPECT_DOUBLE_EQ(distance_to({t[0], t[0], t[1]}, {2, 3, 0}), 3.0);  // without area
}

TEST(Proxies, BoundOfTwoPlanesIsTheirDistanceWhereverTheirTrianglesMeet) {
    const std::vector<TriangleCorners> one{{glm::dvec3(0, 0, 0), {2, 0, 0}, {0, 2, 0}},
                                           {glm::dvec3(2, 0, 0), {2, 2, 0}, {0, 2, 0}}};
    const std::vector<TriangleCorners> other{{glm::dvec3(0, 0, 1), {2, 0, 1}, {2, 2, 1}},
                                             {glm::dvec3(0, 0, 1), {2, 2, 1}, {0, 2, 1}}};
    const SurfaceDistance found = surface_distance(one, TriangleTree(other), 1e-3);
    EXPECT_DOUBLE_EQ(found.least_m, 1.0);
    EXPECT_GE(found.most_m, 1.0);
    EXPECT_LE(found.most_m, 1.5);
    EXPECT_TRUE(lies_within(one, TriangleTree(other), 1.01, {}));
    EXPECT_FALSE(lies_within(one, TriangleTree(other), 0.99, {}));
}

TEST(Proxies, EveryBoundHoldsForSamplesOfRandomSurfaces) {
    std::vector<double> ratios;
    for (unsigned seed = 0; seed < 24; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> place(0.0, 1.0);
        Soup soup;
        const std::size_t points = 20 + 13 * seed;
        for (std::size_t i = 0; i < points; ++i) soup.points.emplace_back(place(random), place(random), place(random));
        std::uniform_int_distribution<std::uint32_t> pick(0, static_cast<std::uint32_t>(points) - 1);
        if (seed % 3 == 0) {  // any three points, twice or without area, too
            for (std::size_t i = 0; i < 2 * points; ++i)
                soup.faces.push_back({pick(random), pick(random), pick(random)});
        } else {  // a bumpy ball, or one with a hole
            const game::Shape ball = game::make_sphere(1.0, 12 + seed, 8 + seed / 2);
            soup = soup_of(mesh_from(ball));
            for (glm::dvec3& p : soup.points) p *= 1.0 + 0.02 * std::sin(9.0 * p.x + seed) * std::cos(7.0 * p.y);
            if (seed % 3 == 2) soup.faces.resize(soup.faces.size() - soup.faces.size() / 5);
        }
        for (const double ratio : check_forms(soup, "seed " + std::to_string(seed), 2000, false))
            ratios.push_back(ratio);
    }
    EXPECT_GT(ratios.size(), 12u);
    EXPECT_LT(median(ratios), kMostRatio);
}

TEST(Proxies, SmallPartsNearLargeOnesGo) {
    game::Shape wall = game::make_box({-5, 0, -5}, {5, 10, 5});
    for (int i = 0; i < 6; ++i) append(wall, game::make_box({5.0, 1.5 * i + 0.5, -4.0}, {5.1, 1.5 * i + 1.3, 4.0}));
    MeshLibrary house = library_of(mesh_from(wall));
    add_proxies(house);
    const auto& proxies = house.meshes[0].proxies;
    EXPECT_TRUE(std::any_of(proxies.begin(), proxies.end(), [&](const MeshProxy& p) {
        return house.meshes[p.mesh].indices.size() / 3 <= 12 && p.bound_m < 0.3f;
    }));
}

TEST(Proxies, ClosedSurfacesStayClosedAndEqualInputGivesEqualOutput) {
    for (const game::Shape& shape : {game::make_sphere(1.0, 32, 16), game::make_ring(1.0, 0.3, 24, 12)}) {
        MeshLibrary library = library_of(mesh_from(shape)), again = library_of(mesh_from(shape));
        ASSERT_TRUE(library.meshes[0].topology.outward);
        EXPECT_GT(add_proxies(library), 0u);
        EXPECT_EQ(add_proxies(library), 0u) << "it has them";
        add_proxies(again);
        EXPECT_EQ(again.meshes[0].proxies, library.meshes[0].proxies);
        for (const MeshProxy& proxy : library.meshes[0].proxies) {
            EXPECT_TRUE(library.meshes[proxy.mesh].topology.closed);
            EXPECT_EQ(again.meshes[proxy.mesh].indices, library.meshes[proxy.mesh].indices);
        }
        const std::size_t count = library.meshes.size();
        library.remove(0);
        for (std::uint32_t m = 0; m < count; ++m) EXPECT_TRUE(library.is_removed(m));
    }
}

TEST(Proxies, SmallAndUnusableMeshesHaveNone) {
    for (Mesh mesh : {mesh_of(kCorners, kCubeFaces), Mesh()}) {
        mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
        MeshLibrary library = library_of(std::move(mesh));
        EXPECT_EQ(add_proxies(library), 0u);
    }
    Mesh ball = mesh_from(game::make_sphere(1.0, 16, 8));
    ball.vertices[3].position_ms.y = std::numeric_limits<float>::quiet_NaN();
    MeshLibrary nan = library_of(ball);
    EXPECT_EQ(add_proxies(nan), 0u);
    Mesh point = mesh_from(game::make_sphere(1.0, 16, 8));
    for (Vertex& vertex : point.vertices) vertex.position_ms = glm::vec3(3.0f);
    MeshLibrary degenerate = library_of(point);
    EXPECT_EQ(add_proxies(degenerate), 0u);
    Mesh masked = mesh_from(game::make_sphere(1.0, 16, 8));
    MeshLibrary leaves = library_of(masked);
    leaves.materials[0].alpha_mode = AlphaMode::mask;
    EXPECT_EQ(add_proxies(leaves), 0u);
}

TEST(Proxies, MaskedPartsStayAsTheyAre) {
    game::Shape both = game::make_sphere(1.0, 24, 12);
    const auto trunk = static_cast<std::uint32_t>(both.indices.size());
    append(both, game::make_sphere(0.5, 16, 8));
    Mesh mesh = mesh_from(both);
    mesh.submeshes = {{0, trunk, 0}, {trunk, static_cast<std::uint32_t>(both.indices.size()) - trunk, 1}};
    MeshLibrary library = library_of(mesh);
    library.materials.emplace_back().alpha_mode = AlphaMode::mask;
    ASSERT_GT(add_proxies(library), 0u);
    for (const MeshProxy& proxy : library.meshes[0].proxies) {
        const Mesh& coarse = library.meshes[proxy.mesh];
        ASSERT_EQ(coarse.submeshes.size(), 2u);
        EXPECT_EQ(coarse.submeshes[1].material, 1u);
        EXPECT_EQ(coarse.submeshes[1].index_count, mesh.submeshes[1].index_count);
        EXPECT_LT(coarse.submeshes[0].index_count, trunk);
        for (std::uint32_t i = 0; i < coarse.submeshes[1].index_count; ++i)
            EXPECT_EQ(coarse.vertices[coarse.indices[coarse.submeshes[1].first_index + i]],
                      mesh.vertices[mesh.indices[trunk + i]]);
    }
}

/// Checks the proxies of a scene's meshes, and adds their ratios.
void check_scene(SceneData scene, const std::string& name, std::size_t samples, std::vector<double>& ratios) {
    MeshLibrary library;
    library.meshes = std::move(scene.meshes);
    library.materials = std::move(scene.materials);
    for (const Mesh& mesh : library.meshes)
        if (!mesh.deformer)
            for (const double ratio : check_forms(soup_of(mesh), name + " " + mesh.name, samples, true))
                ratios.push_back(ratio);
}

TEST(Proxies, EveryBoundHoldsForSamplesOfTheBuiltInScenes) {
    if (kSanitized) GTEST_SKIP() << kSlow;
    std::vector<double> ratios;
    auto city = load_gltf_memory(game::make_city().glb, {}, "city");
    auto valley = load_gltf_memory(game::make_valley().glb, {}, "valley");
    ASSERT_TRUE(city && valley);
    check_scene(std::move(city).value(), "city", samples_wanted(), ratios);
    if (is_long_run()) check_scene(std::move(valley).value(), "valley", samples_wanted(), ratios);
    EXPECT_LT(median(ratios), kMostRatio);
    RecordProperty("median_ratio", std::to_string(median(ratios)));
}

TEST(Proxies, EveryBoundHoldsForSamplesOfRealFiles) {
    if (kSanitized || !is_long_run()) GTEST_SKIP() << kSlow;
    const std::vector<std::string> files = test::data_files();
    if (files.empty()) GTEST_SKIP() << "no test data at " << test::data_folder();
    std::vector<double> ratios;
    for (const std::string& name : files) {
        auto scene = load_gltf(test::data_folder() / name);
        if (!scene) continue;
        std::size_t triangles = 0;
        for (const Mesh& mesh : scene.value().meshes) triangles += mesh.indices.size() / 3;
        if (triangles > 40'000 && !std::getenv("GNOMON_PROXY_SAMPLES")) continue;  // seconds each
        check_scene(std::move(scene).value(), name, samples_wanted(), ratios);
    }
    EXPECT_GT(ratios.size(), 25u);
    EXPECT_LT(median(ratios), kMostRatio);
    RecordProperty("median_ratio", std::to_string(median(ratios)));
}

}  // namespace
}  // namespace gnomon::assets
