// Bent meshes against another evaluation, in long double and point by point; and the boxes that must hold them.
#include "engine/mesh/deformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <random>

#include "gnomon/assets.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::assets {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
glm::vec3 point(Random& random, double size) {
    return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

struct Bent {
    Mesh mesh;
    std::vector<glm::dmat4x3> joints;
    std::vector<float> weights;
    MeshPose pose() const { return {joints, weights}; }
};

/// Draws any affine matrix: turned, stretched, mirrored, flattened, far away.
glm::dmat4x3 any_matrix(Random& random) {
    const glm::dquat turn = glm::normalize(
        glm::dquat(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)));
    const glm::dmat3 r = glm::mat3_cast(turn);
    const double sizes[] = {1.0, 1.0, -1.0, 0.0, 1e-3, 30.0};
    const auto size = [&] { return sizes[random() % std::size(sizes)]; };
    const double far[] = {0.0, 1.0, 1000.0};
    return {r[0] * size(), r[1] * size(), r[2] * size(), glm::dvec3(point(random, 1.0)) * far[random() % 3]};
}

Bent random_mesh(Random& random, bool skinned) {
    Bent bent;
    const std::size_t joints = 1 + random() % 5, targets = random() % 3;
    Deformer deformer;
    for (std::size_t v = 0; v < 30; ++v) {
        bent.mesh.vertices.push_back(
            {point(random, 2.0), glm::normalize(point(random, 1.0) + glm::vec3(0.0f, 2.0f, 0.0f)), {0.25f, 0.5f}});
        if (v < 27) bent.mesh.indices.push_back(static_cast<std::uint32_t>(v));  // the last three in no triangle
        if (!skinned) continue;
        deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
        const std::size_t count = 1 + random() % 5;
        double sum = 0.0;
        std::vector<double> shares(count);
        for (double& share : shares) sum += share = uniform(random, 0.01, 1.0);
        for (const double share : shares)
            deformer.influences.push_back(
                {static_cast<std::uint32_t>(random() % joints), static_cast<float>(share / sum)});
    }
    if (skinned) deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
    for (std::size_t t = 0; t < targets; ++t) {
        Deformer::Target& target = deformer.targets.emplace_back();
        for (std::size_t v = 0; v < 30; ++v) target.positions.push_back(point(random, 1.5));
        if (t == 0)
            for (std::size_t v = 0; v < 30; ++v) target.normals.push_back(point(random, 0.5));
        bent.weights.push_back(static_cast<float>(uniform(random, -1.5, 1.5)));
    }
    for (const std::uint32_t v : bent.mesh.indices)
        bent.mesh.bounds_ms = math::extended(bent.mesh.bounds_ms, glm::dvec3(bent.mesh.vertices[v].position_ms));
    for (std::size_t j = 0; skinned && j < joints; ++j) bent.joints.push_back(any_matrix(random));
    measure(deformer, bent.mesh);
    bent.mesh.deformer = std::make_shared<const Deformer>(std::move(deformer));
    return bent;
}

/// Sums, over joints, weight times the point to which that joint alone takes the vertex.
glm::dvec3 oracle(const Bent& bent, std::size_t v) {
    const Deformer& deformer = *bent.mesh.deformer;
    long double p[3], sum[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) {
        p[i] = bent.mesh.vertices[v].position_ms[i];
        for (std::size_t t = 0; t < deformer.targets.size(); ++t)
            p[i] += static_cast<long double>(bent.weights[t]) * deformer.targets[t].positions[v][i];
    }
    if (!deformer.has_skin()) return {p[0], p[1], p[2]};
    for (std::uint32_t k = deformer.first_influence[v]; k < deformer.first_influence[v + 1]; ++k) {
        const glm::dmat4x3& m = bent.joints[deformer.influences[k].joint];
        for (int row = 0; row < 3; ++row)
            sum[row] += static_cast<long double>(deformer.influences[k].weight) *
                        (m[0][row] * p[0] + m[1][row] * p[1] + m[2][row] * p[2] + m[3][row]);
    }
    return {sum[0], sum[1], sum[2]};
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

class BentMeshes : public ::testing::Test {
protected:
    const std::uint64_t seed = print_seed();
    Random random{seed};
};

TEST_F(BentMeshes, HaveTheirVerticesWhereAnotherEvaluationHasThem) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Vertex> found;
    for (int round = 0; round < 400; ++round) {
        const Bent bent = random_mesh(random, round % 4 != 0);
        deform(bent.mesh, bent.pose(), found);
        ASSERT_EQ(found.size(), bent.mesh.vertices.size());
        for (std::size_t v = 0; v < found.size(); ++v) {
            const glm::dvec3 wanted = oracle(bent, v);
            ASSERT_LE(largest(glm::dvec3(found[v].position_ms) - wanted), 0x1p-23 * std::max(largest(wanted), 1e-3));
            ASSERT_EQ(found[v].uv, bent.mesh.vertices[v].uv);
        }
    }
}

TEST_F(BentMeshes, LieWithinTheirBoundsWhateverTheirJointsAndWeights) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Vertex> found;
    std::size_t touching = 0;
    for (int round = 0; round < 2000; ++round) {
        const Bent bent = random_mesh(random, round % 4 != 0);
        deform(bent.mesh, bent.pose(), found);
        const math::Aabb box = posed_bounds(bent.mesh, bent.pose());
        math::Aabb exact;
        for (const std::uint32_t v : bent.mesh.indices) exact = math::extended(exact, glm::dvec3(found[v].position_ms));
        for (int i = 0; i < 3; ++i) {
            ASSERT_LE(box.min[i], exact.min[i]) << "round " << round;
            ASSERT_GE(box.max[i], exact.max[i]) << "round " << round;
            touching += box.max[i] - exact.max[i] < 1e-3 * (exact.max[i] - exact.min[i]) ? 1 : 0;
        }
    }
    EXPECT_GT(touching, 100u) << "bounds that are never close hold anything";
}

TEST_F(BentMeshes, MoveNoVertexFartherThanTheBoundOfTheirBend) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::size_t near_bound = 0;
    for (int round = 0; round < 2000; ++round) {
        const Bent before = random_mesh(random, round % 4 != 0);
        Bent after = before;
        for (glm::dmat4x3& joint : after.joints)
            if (random() % 2 == 0) joint += any_matrix(random) * uniform(random, 0.0, 1.0);
        for (float& weight : after.weights) weight += static_cast<float>(uniform(random, -0.5, 0.5));
        const double bound_m = farthest_bend_m(before.mesh, before.pose(), after.pose());
        double most_m = 0.0;
        for (const std::uint32_t v : before.mesh.indices)
            most_m = std::max(most_m, glm::length(oracle(after, v) - oracle(before, v)));
        ASSERT_LE(most_m, bound_m * (1.0 + 1e-12) + 1e-9) << "round " << round;
        near_bound += bound_m > 0.0 && most_m > 0.3 * bound_m ? 1 : 0;
        EXPECT_EQ(farthest_bend_m(before.mesh, before.pose(), before.pose()), 0.0);
    }
    EXPECT_GT(near_bound, 500u) << "a bound that is never close holds anything";
}

TEST_F(BentMeshes, HaveNormalsAcrossTheirBentPlanes) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Vertex> found;
    for (int round = 0; round < 200; ++round) {
        // One joint, a triangle with its plane's normal: what is bent is still a plane.
        Bent bent = random_mesh(random, true);
        Deformer deformer;
        deformer.first_influence = {0, 1, 2, 3};
        deformer.influences = {{0, 1.0f}, {0, 1.0f}, {0, 1.0f}};
        bent.mesh.vertices.resize(3);
        bent.mesh.indices = {0, 1, 2};
        auto corner = [&](std::size_t v) { return glm::dvec3(bent.mesh.vertices[v].position_ms); };
        const glm::vec3 plane(glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0))));
        for (Vertex& v : bent.mesh.vertices) v.normal_ms = plane;
        measure(deformer, bent.mesh);
        bent.mesh.deformer = std::make_shared<const Deformer>(deformer);
        bent.weights.clear();
        const glm::dmat3 basis(bent.joints[0][0], bent.joints[0][1], bent.joints[0][2]);
        if (!(std::abs(glm::determinant(basis)) > 1e-8)) continue;
        bent.joints[0][3] = glm::dvec3(0.0);
        deform(bent.mesh, bent.pose(), found);
        const glm::dvec3 a(found[0].position_ms), b(found[1].position_ms), c(found[2].position_ms);
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double side = glm::determinant(basis) < 0.0 ? -1.0 : 1.0;  // a mirror winds the corners the other way
        if (!(glm::length(across) > 1e-6 * glm::length(b - a) * glm::length(c - a))) continue;
        EXPECT_NEAR(side * glm::dot(glm::normalize(across), glm::dvec3(found[0].normal_ms)), 1.0, 1e-3);
        EXPECT_NEAR(glm::length(found[0].normal_ms), 1.0f, 1e-6f);
    }
}

TEST_F(BentMeshes, AtRestAreThemselves) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Bent bent = random_mesh(random, true);
    std::fill(bent.joints.begin(), bent.joints.end(), glm::dmat4x3(1.0));
    bent.weights.clear();  // missing weights count as 0
    std::vector<Vertex> found;
    deform(bent.mesh, bent.pose(), found);
    for (std::size_t v = 0; v < found.size(); ++v)
        EXPECT_LE(largest(glm::dvec3(found[v].position_ms - bent.mesh.vertices[v].position_ms)), 1e-6);
}

TEST_F(BentMeshes, KnowWhetherJointsTurnThemInsideOut) {
    Bent bent = random_mesh(random, true);
    Deformer deformer;
    deformer.first_influence.assign(bent.mesh.vertices.size() + 1, 0);
    for (std::uint32_t v = 0; v < bent.mesh.vertices.size(); ++v) {
        deformer.influences.push_back({v % 2, 1.0f});
        deformer.first_influence[v + 1] = v + 1;
    }
    measure(deformer, bent.mesh);
    bent.mesh.deformer = std::make_shared<const Deformer>(deformer);
    const glm::dmat4x3 plain(1.0);
    glm::dmat4x3 mirror(1.0), flat(1.0);
    mirror[0] *= -2.0;
    flat[1] *= 0.0;
    bent.joints = {plain, plain, mirror};  // no vertex follows the third
    EXPECT_EQ(mirroring(bent.mesh, bent.pose()), Mirroring::none);
    bent.joints = {mirror, plain};
    EXPECT_EQ(mirroring(bent.mesh, bent.pose()), Mirroring::some);
    bent.joints = {mirror, mirror};
    EXPECT_EQ(mirroring(bent.mesh, bent.pose()), Mirroring::all);
    bent.joints = {mirror, flat};
    EXPECT_EQ(mirroring(bent.mesh, bent.pose()), Mirroring::all) << "what is flat has no side";
    bent.joints = {flat, flat};
    EXPECT_EQ(mirroring(bent.mesh, bent.pose()), Mirroring::none);
}

}  // namespace
}  // namespace gnomon::assets
