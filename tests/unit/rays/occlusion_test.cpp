#include "engine/rays/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/rays/exact_triangle.h"
#include "tests/unit/rays/triangle_soup.h"

/// Float must never overrule double: against every triangle, one by one.
namespace gnomon::rays {
namespace {

using test::Soup;

struct Case {
    assets::Mesh mesh;
    Frame frame;
    RayPacket rays;
};

/// Returns whether one ray meets one triangle, in double.
bool exactly_meets(const Case& scene, std::size_t lane, const BvhTriangle& triangle) {
    const auto placed = [&](const glm::vec3& p) {
        return scene.frame.basis * glm::dvec3(p) + (scene.frame.origin_ws_m - scene.rays.from[lane]);
    };
    ExactHit hit;
    return meets(scene.rays.along[lane], {placed(triangle.a), placed(triangle.b), placed(triangle.c)}, hit) &&
           hit.t > scene.rays.first[lane] && hit.t < scene.rays.last;
}

class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits_); }
    glm::dvec3 point(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
    std::mt19937_64& bits() { return bits_; }

private:
    std::mt19937_64 bits_;
};

/// Draws a soup of any size, turned, stretched, mirrored and put far away. Its rays lie in and around it, along its
/// axes, to its corners and through its edges. They are short, long or without an end.
Case random_case(std::uint64_t seed) {
    Random random(seed);
    const double size_m = std::pow(10.0, random.in(-4.0, 4.0));
    const auto kind = static_cast<Soup>(seed % static_cast<std::uint64_t>(Soup::count));
    Case scene;
    scene.mesh = test::soup(kind, 40, size_m, random.bits());
    const glm::dquat turn = glm::normalize(glm::dquat(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1), 0.5));
    const glm::dvec3 scale(std::pow(10.0, random.in(-2, 2)), std::pow(10.0, random.in(-2, 2)), random.in(-3.0, 3.0));
    scene.frame.basis = glm::mat3_cast(turn);
    for (int axis = 0; axis < 3; ++axis) scene.frame.basis[axis] *= scale[axis];
    scene.frame.origin_ws_m = random.point(seed % 3 == 0 ? 1e8 : 10.0 * size_m);
    scene.rays.last = seed % 4 == 0 ? std::numeric_limits<double>::infinity() : 1.0;
    scene.rays.count = seed % 5 == 0 ? 1 + seed % kLanes : kLanes;
    const auto vertex = [&] {
        const auto i = static_cast<std::size_t>(random.in(0.0, static_cast<double>(scene.mesh.vertices.size())));
        return glm::dvec3(scene.mesh.vertices[std::min(i, scene.mesh.vertices.size() - 1)].position_ms);
    };
    for (std::size_t lane = 0; lane < scene.rays.count; ++lane) {
        const glm::dvec3 from = random.point(2.0 * size_m);
        glm::dvec3 to = random.point(2.0 * size_m);
        switch (static_cast<int>(random.in(0.0, 6.0))) {
            case 0:
                to = vertex();
                break;
            case 1:
                to = glm::mix(vertex(), vertex(), random.in(-0.5, 1.5));
                break;
            case 2:
                to = from + glm::dvec3(0.0, random.in(-4.0, 4.0) * size_m, 0.0);
                break;
            case 3:
                to = from + random.point(1e-6 * size_m);
                break;
            default:
                break;
        }
        scene.rays.from[lane] = scene.frame.basis * from + scene.frame.origin_ws_m;
        scene.rays.along[lane] = scene.frame.basis * (to - from) * (random.in(0.0, 1.0) < 0.3 ? 3.0 : 1.0);
        scene.rays.first[lane] = random.in(0.0, 1.0) < 0.2 ? random.in(0.0, 0.9) : 0.0;
    }
    return scene;
}

struct Tally {
    int hits = 0, unsure = 0, wrong = 0, lost = 0;
};

/// Compares float's verdict with double's for every ray and triangle; `rounding` scales what float allows for rounding.
void compare(const Case& scene, float rounding, Tally& tally) {
    const MeshBvh tree(scene.mesh, scene.mesh.vertices, std::vector<assets::Material>(1));
    SegmentPacket segments;
    cut_to(tree.box(), in_frame(scene.rays, scene.rays.lanes(), scene.frame), kAllLanes, segments);
    segments.rounding *= rounding;
    for (const BvhTriangle& triangle : tree.triangles()) {
        const glm::vec3 low = glm::min(triangle.a, glm::min(triangle.b, triangle.c));
        const glm::vec3 high = glm::max(triangle.a, glm::max(triangle.b, triangle.c));
        const Lanes near = near_box(segments, low, high);
        const Verdict verdict = judge(segments, triangle);
        const Lanes near_rays = segments.rays_of(near & segments.lanes);
        const Lanes hits = segments.rays_of(verdict.hit), unsures = segments.rays_of(verdict.unsure);
        for (std::size_t ray = 0; ray < scene.rays.count; ++ray) {
            const bool meets = exactly_meets(scene, ray, triangle);
            const bool hit = hits >> ray & 1u, unsure = unsures >> ray & 1u;
            tally.hits += meets;
            tally.unsure += unsure;
            tally.wrong += !unsure && hit != meets;
            tally.lost += meets && (near_rays >> ray & 1u) == 0;
        }
    }
}

TEST(Occlusion, FloatIsNeverSureOfWhatDoubleDenies) {
    Tally tally, careless;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        const Case scene = random_case(seed);
        const int before = tally.wrong + tally.lost;
        compare(scene, 1.0f, tally);
        EXPECT_EQ(tally.wrong + tally.lost, before) << "seed " << seed;
        compare(scene, 0.0f, careless);
    }
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_EQ(tally.lost, 0);
    EXPECT_GT(tally.hits, 4000);
    EXPECT_GT(careless.wrong, 100) << "without bounds of rounding this test has to fail";
    RecordProperty("unsure", tally.unsure);
}

struct BruteForce final : ExactTest {
    explicit BruteForce(const Case& the_case) : scene(the_case) {}
    bool hits(std::size_t ray, const BvhTriangle& triangle, double&) override {
        ++asked;
        return exactly_meets(scene, ray, triangle);
    }
    const Case& scene;
    int asked = 0;
};

TEST(Occlusion, TheWalkBlocksWhatAnyTriangleBlocks) {
    int blocked = 0, open = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        const Case scene = random_case(seed);
        const MeshBvh tree(scene.mesh, scene.mesh.vertices, std::vector<assets::Material>(1));
        SegmentPacket segments;
        cut_to(tree.box(), in_frame(scene.rays, scene.rays.lanes(), scene.frame), kAllLanes, segments);
        BruteForce exact(scene);
        const Lanes found = blocked_rays(tree, segments, exact);
        Lanes expected = 0;
        for (std::size_t lane = 0; lane < scene.rays.count; ++lane)
            for (const BvhTriangle& triangle : tree.triangles())
                if (exactly_meets(scene, lane, triangle)) expected |= 1u << lane;
        EXPECT_EQ(found, expected) << "seed " << seed;
        for (std::size_t lane = 0; lane < scene.rays.count; ++lane) (expected >> lane & 1u ? blocked : open)++;
    }
    EXPECT_GT(blocked, 3000);
    EXPECT_GT(open, 5000);
}

TEST(Occlusion, NoRaySlipsBetweenTrianglesThatShareAnEdge) {
    Random random(23);
    int crossed = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p = random.point(10.0), q = random.point(10.0), from = random.point(10.0);
        const glm::dvec3 along = glm::mix(p, q, random.in(0.01, 0.99)) - from;
        const glm::dvec3 side = glm::cross(q - p, along);
        if (glm::length(side) < 1e-3) continue;
        const glm::dvec3 left = glm::mix(p, q, 0.5) + side, right = glm::mix(p, q, 0.5) - side;
        ExactHit hit;
        const bool one = meets(along, {p - from, q - from, left - from}, hit);
        const bool other = meets(along, {q - from, p - from, right - from}, hit);
        EXPECT_TRUE(one || other) << i;
        crossed += one != other;
    }
    EXPECT_GT(crossed, 1000) << "rays are aimed so near to the edge that rounding alone decides";
}

TEST(Occlusion, AFrameThatFloatCannotHoldIsLeftToDouble) {
    std::mt19937_64 bits(29);
    for (const double size_m : {1e-30, 1e-12, 1e12, 1e25}) {
        Case scene;
        scene.mesh = test::soup(Soup::loose, 30, size_m, bits);
        scene.rays.count = kLanes;
        Random random(31);
        Tally tally;
        for (int packet = 0; packet < 30; ++packet) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                scene.rays.from[lane] = random.point(2.0 * size_m);
                scene.rays.along[lane] = random.point(2.0 * size_m) - scene.rays.from[lane];
            }
            compare(scene, 1.0f, tally);
        }
        EXPECT_GT(tally.hits, 10) << size_m;
        EXPECT_EQ(tally.wrong + tally.lost, 0) << size_m;
        EXPECT_EQ(tally.unsure, 30 * 30 * static_cast<int>(kLanes)) << size_m;
    }
}

}  // namespace
}  // namespace gnomon::rays
