#include "systems/debug/depth_tiles.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::debug {
namespace {

using shadow::ShadowView;
using shadow::ViewProjection;

std::vector<ShadowView> views_of(std::uint32_t count, ViewProjection projection) {
    std::vector<ShadowView> views(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        views[i].layer = i;
        views[i].projection = projection;
        views[i].depth.near_m = 0.5;
        views[i].depth.far_m = 20.0 + i;
        views[i].depth.alpha = -0.25;
        views[i].depth.beta = 0.75;
    }
    return views;
}

bool apart(const DepthTile& a, const DepthTile& b) {
    return a.place.x + a.place.z <= b.place.x || b.place.x + b.place.z <= a.place.x ||
           a.place.y + a.place.z <= b.place.y || b.place.y + b.place.z <= a.place.y;
}

void expect_within(const std::vector<DepthTile>& tiles, const gl::Rect& area) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const glm::vec4& p = tiles[i].place;
        EXPECT_GE(p.x, static_cast<float>(area.x));
        EXPECT_GE(p.y, static_cast<float>(area.y));
        EXPECT_LE(p.x + p.z, static_cast<float>(area.x + area.width));
        EXPECT_LE(p.y + p.z, static_cast<float>(area.y + area.height));
        for (std::size_t k = 0; k < i; ++k) EXPECT_TRUE(apart(tiles[i], tiles[k])) << i << ' ' << k;
    }
}

TEST(DepthTiles, FourCascadesLieAsTheAreaMakesThemLargest) {
    const auto views = views_of(4, ViewProjection::orthographic);
    EXPECT_EQ(depth_tiles(views, {0, 0, 400, 100}).front().place.z, 100.0f);
    EXPECT_EQ(depth_tiles(views, {0, 0, 100, 400}).front().place.z, 100.0f);
    EXPECT_EQ(depth_tiles(views, {0, 0, 200, 200}).front().place.z, 100.0f);
    const auto tiles = depth_tiles(views, {10, 20, 210, 205});
    expect_within(tiles, {10, 20, 210, 205});
    EXPECT_LT(tiles[0].place.x, tiles[1].place.x);  // read as a page is: the first at the upper left
    EXPECT_GT(tiles[0].place.y, tiles[2].place.y);
}

TEST(DepthTiles, EveryCountFitsEveryArea) {
    for (std::uint32_t count = 1; count <= kMaxTiles; ++count)
        for (const gl::Rect area : {gl::Rect{0, 0, 320, 180}, {7, 3, 31, 200}, {0, 0, 8, 8}, {5, 5, 1000, 9}}) {
            const auto tiles = depth_tiles(views_of(count, ViewProjection::orthographic), area);
            ASSERT_EQ(tiles.size(), count);
            expect_within(tiles, area);
        }
}

TEST(DepthTiles, WithoutViewsOrAPixelForEachThereIsNothing) {
    EXPECT_TRUE(depth_tiles({}, {0, 0, 100, 100}).empty());
    EXPECT_TRUE(depth_tiles(views_of(4, ViewProjection::orthographic), {0, 0, 1, 3}).empty());
    EXPECT_TRUE(depth_tiles(views_of(6, ViewProjection::cube_face), {0, 0, 3, 3}).empty());
    EXPECT_TRUE(depth_tiles(views_of(1, ViewProjection::orthographic), {0, 0, 0, 0}).empty());
}

TEST(DepthTiles, MoreViewsThanTheShaderHoldsAreLeftOut) {
    EXPECT_EQ(depth_tiles(views_of(kMaxTiles + 3, ViewProjection::orthographic), {0, 0, 900, 900}).size(), kMaxTiles);
}

TEST(DepthTiles, OnlyPerspectiveMapsCarryAlphaAndBeta) {
    const gl::Rect area{0, 0, 100, 100};
    EXPECT_EQ(depth_tiles(views_of(1, ViewProjection::orthographic), area).front().depth,
              glm::vec4(0.5f, 20.0f, 0.0f, 0.0f));
    EXPECT_EQ(depth_tiles(views_of(1, ViewProjection::perspective), area).front().depth,
              glm::vec4(0.5f, 20.0f, -0.25f, 0.75f));
}

TEST(DepthTiles, OnlyFacesOfACubeCarryAxesAndTheyLookWhereTheFacesDo) {
    const gl::Rect area{0, 0, 400, 300};
    EXPECT_EQ(depth_tiles(views_of(1, ViewProjection::perspective), area).front().forward, glm::vec4(0.0f));
    const auto faces = depth_tiles(views_of(6, ViewProjection::cube_face), area);
    for (std::uint32_t face = 0; face < 6; ++face) {
        const DepthTile& t = faces[face];
        EXPECT_EQ(glm::dvec3(t.forward), -shadow::cube_face(face).axis_back) << face;
        // Seen from the light, not from outside: right, up and back are right-handed.
        EXPECT_EQ(glm::cross(glm::vec3(t.right), glm::vec3(t.up)), -glm::vec3(t.forward)) << face;
    }
}

TEST(DepthTiles, NeighboursInTheCrossMeetAtTheEdgeTheyShare) {
    const auto faces = depth_tiles(views_of(6, ViewProjection::cube_face), {0, 0, 400, 300});
    ASSERT_EQ(faces.size(), 6u);
    expect_within(faces, {0, 0, 400, 300});
    const auto direction = [](const DepthTile& t, const glm::vec2& px) {
        const glm::vec2 tangent = 2.0f * (px - glm::vec2(t.place)) / t.place.z - 1.0f;
        return glm::vec3(t.forward) + tangent.x * glm::vec3(t.right) + tangent.y * glm::vec3(t.up);
    };
    int seams = 0;
    for (const DepthTile& a : faces)
        for (const DepthTile& b : faces) {
            const bool beside = a.place.y == b.place.y && a.place.x + a.place.z == b.place.x;
            const bool above = a.place.x == b.place.x && a.place.y + a.place.z == b.place.y;
            if (!beside && !above) continue;
            ++seams;
            for (const float along : {0.0f, 25.0f, 100.0f}) {
                const glm::vec2 px = glm::vec2(b.place) + (beside ? glm::vec2(0.0f, along) : glm::vec2(along, 0.0f));
                EXPECT_EQ(direction(a, px), direction(b, px));
            }
        }
    EXPECT_EQ(seams, 5);  // a cross of six squares
}

TEST(DepthTiles, AFaceThatIsAloneFillsTheArea) {
    auto face = views_of(1, ViewProjection::cube_face);
    face[0].layer = 3;
    const auto tiles = depth_tiles(face, {0, 0, 300, 200});
    ASSERT_EQ(tiles.size(), 1u);
    EXPECT_EQ(tiles[0].place, glm::vec4(50.0f, 0.0f, 200.0f, 3.0f));
    EXPECT_EQ(glm::vec3(tiles[0].forward), glm::vec3(0.0f, -1.0f, 0.0f));
}

}  // namespace
}  // namespace gnomon::debug
