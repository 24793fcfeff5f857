#include "systems/extract/drawable_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace gnomon {
namespace {

glm::dmat3 turned(const glm::dvec3& scale) {
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.3, 0.5, -0.7, 0.2)));
    const glm::dmat3 stretch(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(0, 0, scale.z));
    return turn * stretch * glm::mat3_cast(glm::normalize(glm::dquat(0.9, -0.1, 0.4, 0.3)));
}

double farthest(const glm::dmat3& a, const glm::dmat3& b) {
    double off = 0.0;
    for (int i = 0; i < 3; ++i) off = std::max(off, glm::length(a[i] - b[i]));
    return off;
}

TEST(DrawableBasis, IsTheOwnOneOfWhatHasAVolume) {
    for (const glm::dvec3& scale :
         {glm::dvec3(1, 1, 1), {1e-4, 1, 1e4}, {-1e8, 1e8, 1e8}, {1, 1e-8, 1}, {1e-100, 1e-100, 1e-100}}) {
        EXPECT_EQ(drawable_basis(turned(scale)), turned(scale)) << scale.x << ' ' << scale.y << ' ' << scale.z;
        EXPECT_EQ(drawable_basis(glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z)).value()[1].y, scale.y);
    }
}

TEST(DrawableBasis, GivesWhatIsFlatAnInverseAndMovesNothingByWhatFloatsHold) {
    for (const double size : {1e-6, 1.0, 1e6})
        for (const glm::dvec3& scale : {glm::dvec3(1, 0, 1), {0, 2, 1}, {-1, 0, 3}, {1, 1e-14, 1}, {1, 1e-3, 0}}) {
            for (const glm::dmat3& flat :
                 {turned(scale * size), glm::dmat3(scale.x * size, 0, 0, 0, scale.y * size, 0, 0, 0, scale.z * size)}) {
                const std::optional<glm::dmat3> drawn = drawable_basis(flat);
                ASSERT_TRUE(drawn) << scale.x << ' ' << scale.y << ' ' << scale.z;
                EXPECT_LT(farthest(*drawn, flat), 0x1p-30 * 3.01 * size);
                const glm::dmat3 inverse = glm::inverse(*drawn);
                EXPECT_LT(farthest(*drawn * inverse, glm::dmat3(1.0)), 1e-4);
                EXPECT_EQ(drawable_basis(*drawn), *drawn) << "what has its thickness keeps it";
            }
        }
}

TEST(DrawableBasis, TurnsNormalsAsTheCofactorsDo) {
    const glm::dmat3 drawn = drawable_basis(glm::dmat3(1, 0, 0, 0, 0, 0, 0, 0, 1)).value();
    EXPECT_GT(glm::determinant(drawn), 0.0);
    EXPECT_GT(drawn[1].y, 0.0);
    const glm::dmat3 mirrored = drawable_basis(glm::dmat3(-1, 0, 0, 0, 0, 0, 0, 0, 1)).value();
    EXPECT_GT(glm::determinant(mirrored), 0.0);
    EXPECT_LT(mirrored[1].y, 0.0) << "its upper face looks down, as its winding says";
}

TEST(DrawableBasis, ALineHasNoArea) {
    for (const glm::dvec3& scale : {glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1e6, 0}, {1, 0, 1e-20}}) {
        EXPECT_FALSE(drawable_basis(turned(scale))) << scale.x << ' ' << scale.y << ' ' << scale.z;
        EXPECT_FALSE(drawable_basis(glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z)));
    }
    EXPECT_FALSE(drawable_basis(turned({std::numeric_limits<double>::quiet_NaN(), 1, 1})));
    EXPECT_FALSE(drawable_basis(turned({std::numeric_limits<double>::infinity(), 1, 1})));
}

}  // namespace
}  // namespace gnomon
