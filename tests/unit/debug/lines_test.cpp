#include "systems/debug/lines.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "engine/math/projection.h"

namespace gnomon::debug {
namespace {

using ::testing::SizeIs;

TEST(Lines, ABoxHasItsEightCornersAndTwelveEdgesOfThreeLengths) {
    const math::Aabb box{{-1.0, 2.0, 3.0}, {1.0, 5.0, 7.0}};
    const Corners corners = corners_of(box);
    EXPECT_EQ(corners[0], box.min);
    EXPECT_EQ(corners[7], box.max);
    EXPECT_EQ(corners[1], glm::dvec3(1.0, 2.0, 3.0));
    LineDrawing lines(ConsumerItem{});
    lines.add(corners, glm::vec3(1.0f));
    const std::vector<LineVertex> vertices = lines.take();
    ASSERT_THAT(vertices, SizeIs(24));
    std::array<int, 3> edges{};
    for (std::size_t i = 0; i < vertices.size(); i += 2) {
        const glm::dvec3 edge(glm::vec3(vertices[i + 1].position_ca_m - vertices[i].position_ca_m));
        for (int axis = 0; axis < 3; ++axis) {
            if (edge[axis] == 0.0) continue;
            EXPECT_EQ(std::abs(edge[axis]), glm::length(edge)) << "not along an axis";
            EXPECT_EQ(std::abs(edge[axis]), box.max[axis] - box.min[axis]);
            ++edges[static_cast<std::size_t>(axis)];
        }
    }
    EXPECT_THAT(edges, ::testing::ElementsAre(4, 4, 4));
}

TEST(Lines, FarFromTheOriginTheyLieAsExactlyAsNearIt) {
    const glm::dvec3 far(1.0e8, -3.0e7, 2.0e8), from(0.125, 0.25, -0.5), to(1.5, 0.0, -2.0);
    ConsumerItem camera;
    camera.position_ws_m = far;
    LineDrawing lines(camera);
    lines.add(far + from, far + to, glm::vec3(0.5f));
    const std::vector<LineVertex> vertices = lines.take();
    ASSERT_THAT(vertices, SizeIs(2));
    EXPECT_EQ(glm::dvec3(vertices[0].position_ca_m), from);
    EXPECT_EQ(glm::dvec3(vertices[1].position_ca_m), to);
}

TEST(Lines, ColoursAreLinear) {
    LineDrawing lines(ConsumerItem{});
    lines.add({}, {1.0, 0.0, 0.0}, {0.0f, 0.5f, 1.0f});
    const glm::vec4 colour = lines.take().front().colour;
    EXPECT_EQ(colour.r, 0.0f);
    EXPECT_NEAR(colour.g, 0.21404f, 1e-4f);  // IEC 61966-2-1
    EXPECT_NEAR(colour.b, 1.0f, 1e-6f);
}

TEST(Lines, AnOrthographicViewIsItsBoxAroundItsAnchor) {
    shadow::ShadowView view;
    view.pose.anchor_ws_m = {1.0e6, 5.0, -3.0};
    view.clip_from_anchor = glm::mat4(math::reversed_orthographic(-2.0, 4.0, -1.0, 3.0, 0.5, 20.5));
    const Corners corners = corners_of(view);
    const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), 1e-5); };
    expect_near(corners[0], view.pose.anchor_ws_m + glm::dvec3(-2.0, -1.0, -20.5));
    expect_near(corners[3], view.pose.anchor_ws_m + glm::dvec3(4.0, 3.0, -20.5));
    expect_near(corners[4], view.pose.anchor_ws_m + glm::dvec3(-2.0, -1.0, -0.5));
    expect_near(corners[7], view.pose.anchor_ws_m + glm::dvec3(4.0, 3.0, -0.5));
}

TEST(Lines, APerspectiveViewWidensFromNearToFar) {
    shadow::ShadowView view;
    view.pose.anchor_ws_m = {3.0, 4.0, 5.0};
    constexpr double kNear = 0.001, kFar = 50.0, kTan = 0.75;
    view.clip_from_anchor = glm::mat4(math::reversed_perspective(-kTan, 0.5 * kTan, -kTan, kTan, kNear, kFar));
    const Corners corners = corners_of(view);
    const auto expect_at = [&](std::size_t i, const glm::dvec3& offset) {
        EXPECT_LT(glm::distance(corners[i], view.pose.anchor_ws_m + offset), 1e-4 * glm::length(offset)) << i;
    };
    expect_at(0, {-kTan * kFar, -kTan * kFar, -kFar});
    expect_at(1, {0.5 * kTan * kFar, -kTan * kFar, -kFar});
    expect_at(7, {0.5 * kTan * kNear, kTan * kNear, -kNear});
}

}  // namespace
}  // namespace gnomon::debug
