#include "engine/rays/trace.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "engine/rays/exact_triangle.h"
#include "tests/long_run.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/rays/triangle_soup.h"

/// What a walk finds nearest, against every triangle, one by one.
namespace gnomon::rays {
namespace {

using test::Soup;

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Remembers the nearest, counts the questions.
class Nearest final : public ExactTest {
public:
    Nearest(const RayPacket& rays, const Frame& frame) : rays_(rays), frame_(frame) { best.fill(kNothing); }

    bool hits(std::size_t ray, const BvhTriangle& triangle, double& t) override {
        ++asked;
        const auto placed = [&](const glm::vec3& p) {
            return frame_.basis * glm::dvec3(p) + (frame_.origin_ws_m - rays_.from[ray]);
        };
        ExactHit hit;
        if (!meets(rays_.along[ray], {placed(triangle.a), placed(triangle.b), placed(triangle.c)}, hit)) return false;
        if (!(hit.t >= rays_.first[ray] && hit.t <= rays_.last && hit.t < best[ray])) return false;
        t = best[ray] = hit.t;
        return tell_;
    }
    void keep_quiet() { tell_ = false; }

    PerLane<double> best{};
    std::size_t asked = 0;

private:
    const RayPacket& rays_;
    const Frame& frame_;
    bool tell_ = true;
};

struct Case {
    assets::Mesh mesh;
    Frame frame;
    RayPacket rays;
};

/// Draws a soup of any kind and size, turned, stretched, often mirrored, now and then far away. Its rays start together
/// and go the same way, as a picture's do, with a far end or without.
Case random_case(std::mt19937_64& random, std::uint64_t number) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const auto point = [&](double size) { return size * glm::dvec3(share(random), share(random), share(random)); };
    Case scene;
    const double size_m = std::pow(10.0, 3.0 * share(random));
    scene.mesh = test::soup(static_cast<Soup>(number % static_cast<std::uint64_t>(Soup::count)), 200, size_m, random);
    scene.frame.basis = glm::mat3_cast(glm::normalize(glm::dquat(share(random), share(random), share(random), 0.5)));
    for (int axis = 0; axis < 3; ++axis) scene.frame.basis[axis] *= 3.0 * share(random);
    scene.frame.origin_ws_m = point(number % 3 == 0 ? 1e8 : 10.0 * size_m);
    const glm::dvec3 eye = scene.frame.origin_ws_m + scene.frame.basis * point(4.0 * size_m);
    const glm::dvec3 aim = scene.frame.origin_ws_m + scene.frame.basis * point(0.5 * size_m) - eye;
    scene.rays.count = number % 5 == 0 ? 1 + number % kLanes : kLanes;
    scene.rays.last = number % 2 == 0 ? kNothing : 1.5;
    for (std::size_t i = 0; i < scene.rays.count; ++i) {
        scene.rays.from[i] = eye;
        scene.rays.along[i] = aim + point(0.3 * glm::length(aim));
        scene.rays.first[i] = number % 4 == 0 ? 0.2 : 0.0;
    }
    return scene;
}

/// Returns the nearest hits that the walk finds, and adds the number of its exact tests to `asked`. `told`: hits
/// shorten the rays.
PerLane<double> walked(const Case& scene, bool told, std::size_t& asked) {
    const MeshBvh tree(scene.mesh, scene.mesh.vertices, std::vector<assets::Material>(1));
    SegmentPacket segments;
    cut_to(tree.box(), in_frame(scene.rays, scene.rays.lanes(), scene.frame), scene.rays.lanes(), segments);
    Nearest nearest(scene.rays, scene.frame);
    if (!told) nearest.keep_quiet();
    nearest_hits(tree, segments, nearest);
    asked += nearest.asked;
    return nearest.best;
}

PerLane<double> tried_one_by_one(const Case& scene) {
    const MeshBvh tree(scene.mesh, scene.mesh.vertices, std::vector<assets::Material>(1));
    Nearest nearest(scene.rays, scene.frame);
    double t = 0.0;
    for (std::size_t ray = 0; ray < scene.rays.count; ++ray)
        for (const BvhTriangle& triangle : tree.triangles()) (void)nearest.hits(ray, triangle, t);
    return nearest.best;
}

constexpr std::uint64_t kSoups = kSanitized ? 100 : 1200;

TEST(NearestTriangle, IsTheOneThatTryingAllOfThemFinds) {
    std::mt19937_64 random(print_seed());
    std::size_t asked = 0, hits = 0;
    for (std::uint64_t number = 0; number < kSoups; ++number) {
        const Case scene = random_case(random, number);
        const PerLane<double> found = walked(scene, true, asked), expected = tried_one_by_one(scene);
        for (std::size_t ray = 0; ray < scene.rays.count; ++ray) {
            ASSERT_EQ(found[ray], expected[ray]) << "case " << number << " ray " << ray;
            hits += found[ray] < kNothing;
        }
    }
    EXPECT_GT(hits, kSoups * 5 / 3);
}

TEST(NearestTriangle, WhatIsKnownToBeNearerSparesWhatLiesBehind) {
    std::mt19937_64 random(7);
    std::size_t told = 0, untold = 0;
    for (std::uint64_t number = 0; number < kSoups; ++number) {
        const Case scene = random_case(random, 0);
        EXPECT_EQ(walked(scene, true, told), walked(scene, false, untold));
    }
    // A fifth of the questions, in 4000 soups (1103 of 1378 are left); 200 of one compiler's had shown more by chance.
    EXPECT_LT(static_cast<double>(told), 0.9 * static_cast<double>(untold));
}

}  // namespace
}  // namespace gnomon::rays
