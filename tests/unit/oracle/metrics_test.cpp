#include "tests/oracle/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::oracle {
namespace {

/// Masks drawn by hand: '#' shadow, '.' lit, '-' no surface, 'o' surface that is not scored, 'n' not a number.
struct Drawing {
    glm::uvec2 size{0, 0};
    std::vector<float> values;
    std::vector<std::uint8_t> scored;
};

Drawing draw(const std::vector<std::string>& rows) {
    Drawing d;
    d.size = {rows.empty() ? 0u : static_cast<unsigned>(rows[0].size()), static_cast<unsigned>(rows.size())};
    for (const std::string& row : rows)
        for (const char c : row) {
            d.values.push_back(c == '.'   ? 1.0f
                               : c == '-' ? -1.0f
                               : c == 'n' ? std::numeric_limits<float>::quiet_NaN()
                                          : 0.0f);
            d.scored.push_back(c == '.' || c == '#');
        }
    return d;
}

Metrics compare(const Drawing& truth, const Drawing& measured, std::vector<std::uint8_t> ambiguous = {}) {
    ambiguous.resize(truth.values.size());
    return compare(ComparedPictures{truth.size, measured.values, truth.values, truth.scored, ambiguous});
}

/// Draws `width` × `height` pixels with shadow left of column `edge`.
Drawing half_plane(int width, int height, int edge) {
    return draw(std::vector<std::string>(
        static_cast<std::size_t>(height),
        std::string(static_cast<std::size_t>(edge), '#') + std::string(static_cast<std::size_t>(width - edge), '.')));
}

void put(Drawing& d, unsigned x, unsigned y, float value) { d.values[y * d.size.x + x] = value; }

TEST(Metrics, AnEmptyPictureHasNoPixelsAndNoFractions) {
    const Metrics m = compare(draw({}), draw({}));
    EXPECT_EQ(m.scored, 0u);
    EXPECT_EQ(m.fraction(m.wrong), 0.0);
    EXPECT_EQ(m.edge.places, 0u);
}

TEST(Metrics, APictureIsNoDistanceFromItself) {
    const Drawing d = draw({"##......", "###.#...", "#####.#.", "..##..##", "-o##....", "ooo#.#.#"});
    const Metrics m = compare(d, d);
    EXPECT_EQ(m.scored, 43u);
    EXPECT_EQ(m.wrong, 0u);
    EXPECT_EQ(m.coverage_mismatch, 0u);
    EXPECT_GT(m.edge.places, 20u);
    EXPECT_EQ(m.edge.lost, 0u);
    EXPECT_EQ(m.edge.max_px, 0.0);
}

TEST(Metrics, AllLitIsRightAndAllDarkIsAllAcne) {
    const Drawing lit = half_plane(12, 12, 0), dark = half_plane(12, 12, 12);
    EXPECT_EQ(compare(lit, lit).wrong, 0u);
    const Metrics m = compare(lit, dark);
    EXPECT_EQ(m.false_shadow, 144u);
    EXPECT_EQ(m.acne, 144u);
    EXPECT_EQ(m.false_light + m.leak, 0u);
    EXPECT_DOUBLE_EQ(m.fraction(m.wrong), 1.0);
}

TEST(Metrics, OnePixelOfAcneIsFoundFarFromEdgesAndNotBesideThem) {
    const Drawing truth = half_plane(20, 9, 5);
    Drawing far = truth, near = truth;
    put(far, 12, 4, 0.0f);
    put(near, 6, 4, 0.0f);  // 1.5 px from the edge
    EXPECT_EQ(compare(truth, far).acne, 1u);
    EXPECT_EQ(compare(truth, far).false_shadow, 1u);
    EXPECT_EQ(compare(truth, near).acne, 0u);
    EXPECT_EQ(compare(truth, near).false_shadow, 1u);
}

TEST(Metrics, TheEdgeBandEndsAtTwoPixels) {
    const Drawing truth = half_plane(20, 9, 5);
    for (unsigned x = 5; x < 12; ++x) {
        Drawing measured = truth;
        put(measured, x, 4, 0.0f);
        EXPECT_EQ(compare(truth, measured).acne, x - 5 + 0.5 > 2.0 ? 1u : 0u) << x;
    }
}

TEST(Metrics, ALeakPatchInsideAShadowIsCountedByItsPixels) {
    const Drawing truth = half_plane(30, 20, 20);
    Drawing measured = truth;
    for (unsigned y = 8; y < 11; ++y)
        for (unsigned x = 5; x < 9; ++x) put(measured, x, y, 1.0f);
    const Metrics m = compare(truth, measured);
    EXPECT_EQ(m.false_light, 12u);
    EXPECT_EQ(m.leak, 12u);
    EXPECT_EQ(m.false_shadow + m.acne, 0u);
    EXPECT_EQ(m.edge.max_px, 0.0) << "the true edge is where it was";
}

TEST(Metrics, AnEdgeShiftedByWholePixelsIsThatFarOffWithItsSign) {
    for (const int shift : {-3, -1, 1, 2, 5}) {
        const Metrics m = compare(half_plane(40, 10, 20), half_plane(40, 10, 20 + shift));
        EXPECT_EQ(m.edge.places, 10u);
        EXPECT_NEAR(m.edge.mean_signed_px, shift, 1e-9);
        EXPECT_NEAR(m.edge.mean_px, std::abs(shift), 1e-9);
        EXPECT_NEAR(m.edge.p95_px, std::abs(shift), 1e-9);
        EXPECT_NEAR(m.edge.max_px, std::abs(shift), 1e-9);
        EXPECT_EQ(m.wrong, static_cast<std::size_t>(10 * std::abs(shift)));
        EXPECT_EQ(shift > 0 ? m.false_light : m.false_shadow, 0u);
    }
}

TEST(Metrics, ASoftEdgeIsMeasuredBetweenPixels) {
    const Drawing truth = half_plane(40, 10, 20);
    Drawing measured =
        truth;  // the step reaches one half a quarter pixel into the light: 0 at 19, 0.333… at 20, 1 at 21
    for (unsigned y = 0; y < 10; ++y) put(measured, 20, y, 1.0f / 3.0f);
    EXPECT_NEAR(compare(truth, measured).edge.mean_signed_px, 0.75, 1e-6);
}

TEST(Metrics, ADiagonalEdgeIsMeasuredAcrossItself) {
    Drawing truth, measured;
    truth.size = measured.size = {60, 60};
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
            truth.values.push_back(x + y < 60 ? 0.0f : 1.0f);
            measured.values.push_back(x + y < 64 ? 0.0f : 1.0f);
            truth.scored.push_back(1);
        }
    EXPECT_NEAR(compare(truth, measured).edge.mean_signed_px, 4.0 / std::sqrt(2.0), 0.15);
}

TEST(Metrics, AnEdgeThatIsGoneCountsAsFarAsTheSearchGoes) {
    const Metrics m = compare(half_plane(40, 10, 20), half_plane(40, 10, 0));
    EXPECT_EQ(m.edge.lost, 10u);
    EXPECT_EQ(m.edge.places, 10u);
    EXPECT_EQ(m.edge.mean_px, kEdgeSearchPx);
    EXPECT_EQ(m.edge.mean_signed_px, 0.0) << "no direction is known";
}

TEST(Metrics, AnEdgeBesideASilhouetteIsNotGuessed) {
    const std::vector<std::string> truth(5, "oo#....ooo"), measured(5, "oo.....ooo");
    const Metrics m = compare(draw(truth), draw(measured));
    EXPECT_EQ(m.edge.unmeasured, 5u);
    EXPECT_EQ(m.edge.places, 0u);
    EXPECT_EQ(m.false_light, 5u) << "but its pixels are still wrong";
}

TEST(Metrics, TheSetChangesNoEdgeAcrossASilhouette) {
    const Drawing truth = draw({"##########o..........", "##########o..........", "##########o.........."});
    Drawing measured = truth;
    put(measured, 9, 1, 1.0f);
    const Metrics m = compare(truth, measured);
    EXPECT_EQ(m.edge.places + m.edge.unmeasured, 0u);
    EXPECT_EQ(m.leak, 1u) << "no true shadow edge is near";
}

TEST(Metrics, AmbiguousPixelsAreCountedAndExcused) {
    const Drawing truth = half_plane(20, 9, 5);
    Drawing measured = truth;
    put(measured, 12, 4, 0.0f);
    std::vector<std::uint8_t> ambiguous(truth.values.size());
    ambiguous[4 * 20 + 12] = 1;
    const Metrics m = compare(truth, measured, ambiguous);
    EXPECT_EQ(m.ambiguous, 1u);
    EXPECT_EQ(m.scored, 179u);
    EXPECT_EQ(m.wrong, 0u);
    ambiguous[4 * 20 + 12] = 0;
    ambiguous[4 * 20 + 13] = 1;
    EXPECT_EQ(compare(truth, measured, ambiguous).acne, 1u) << "a neighbour's doubt excuses nothing";
}

TEST(Metrics, AmbiguousFlagsOutsideTheScoredSetMeanNothing) {
    const Drawing truth = draw({"oo..--"});
    const Metrics m = compare(truth, truth, {1, 0, 0, 0, 1, 0});
    EXPECT_EQ(m.ambiguous, 0u);
    EXPECT_EQ(m.scored, 2u);
}

TEST(Metrics, WhatTheMeasuredPictureDoesNotCoverIsWrong) {
    const Metrics m = compare(draw({"..##-o"}), draw({".--#.-"}));
    EXPECT_EQ(m.coverage_mismatch, 4u);
    EXPECT_EQ(m.uncovered, 2u);
    EXPECT_EQ(m.wrong, 2u);
    EXPECT_EQ(m.false_shadow + m.false_light, 0u);
}

TEST(Metrics, NotANumberIsWrongAndNeverPasses) {
    const Metrics m = compare(draw({"..##"}), draw({"nn#n"}));
    EXPECT_EQ(m.wrong, 3u);
    EXPECT_EQ(m.coverage_mismatch, 3u);
}

TEST(Metrics, UnscoredSurfacesAreNeverWrong) {
    const Metrics m = compare(draw({"oooo"}), draw({"...."}));
    EXPECT_EQ(m.scored, 0u);
    EXPECT_EQ(m.wrong, 0u);
}

}  // namespace
}  // namespace gnomon::oracle
