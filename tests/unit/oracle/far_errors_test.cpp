#include "tests/oracle/far_errors.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kSide = 40;

/// A picture all lit and on one plane, except for what a test changes.
struct Picture {
    std::vector<float> measured = std::vector<float>(kSide * kSide, 1.0f), truth = measured;
    std::vector<std::uint8_t> scored = std::vector<std::uint8_t>(kSide * kSide, 1);
    std::vector<std::uint8_t> ambiguous = std::vector<std::uint8_t>(kSide * kSide, 0), creases = ambiguous;
    std::vector<float> allowed_px = std::vector<float>(kSide * kSide, 0.0f);
    static std::size_t at(std::size_t x, std::size_t y) { return y * kSide + x; }
    /// True shadow between pixel centres: a stripe right of column stripe_from, as wide as that.
    double stripe_from = kSide, stripe_width = 0.0;
    FarErrors errors() const {
        const LitBetween lit = [this](std::size_t pixel, const glm::dvec2& offset_px) {
            const double x = static_cast<double>(pixel % kSide) + offset_px.x;
            const bool in_stripe = x > stripe_from && x < stripe_from + stripe_width;
            return offset_px == glm::dvec2(0.0) || !in_stripe ? truth[pixel] >= 0.5f : false;
        };
        return far_errors({{kSide, kSide}, measured, truth, scored, ambiguous}, creases, allowed_px, lit);
    }
};

TEST(FarErrors, AreNoneWhereNothingIsWrong) {
    const FarErrors none = Picture{}.errors();
    EXPECT_EQ(none.false_shadow + none.false_light + none.crease_shadow + none.crease_light, 0u);
}

TEST(FarErrors, CountWhatIsWrongFarFromEverything) {
    Picture p;
    p.measured[Picture::at(20, 20)] = 0.0f;
    EXPECT_EQ(p.errors().false_shadow, 1u);
    EXPECT_EQ(p.errors().each, std::vector<std::size_t>{Picture::at(20, 20)});
    p.ambiguous[Picture::at(20, 20)] = 1;
    EXPECT_EQ(p.errors().false_shadow, 0u) << "the truth itself is in doubt";
}

TEST(FarErrors, EndWhereTheDistanceThatIsAllowedReachesATrueEdge) {
    Picture p;  // dark in truth left of column 10
    for (std::size_t y = 0; y < kSide; ++y)
        for (std::size_t x = 0; x < 10; ++x) p.truth[Picture::at(x, y)] = p.measured[Picture::at(x, y)] = 0.0f;
    p.measured[Picture::at(15, 20)] = 0.0f;  // 5.5 px from the edge
    EXPECT_EQ(p.errors().false_shadow, 1u);
    p.allowed_px[Picture::at(15, 20)] = 5.4f;
    EXPECT_EQ(p.errors().false_shadow, 1u);
    p.allowed_px[Picture::at(15, 20)] = 5.6f;
    EXPECT_EQ(p.errors().false_shadow, 0u);
    p.measured[Picture::at(2, 20)] = 1.0f;
    EXPECT_EQ(p.errors().false_light, 1u);
    p.scored.assign(p.scored.size(), 0);
    EXPECT_EQ(p.errors().false_light, 0u) << "nothing of it counts";
}

TEST(FarErrors, BesideAShadowBetweenPixelCentresAreItsEdgeDisplaced) {
    Picture p;
    p.measured[Picture::at(20, 20)] = 0.0f;
    p.stripe_width = 0.2;
    p.stripe_from = 21.4;
    EXPECT_EQ(p.errors().false_shadow, 0u);
    p.stripe_from = 22.1;  // 2 px are allowed
    EXPECT_EQ(p.errors().false_shadow, 1u);
    p.allowed_px[Picture::at(20, 20)] = 2.3f;
    EXPECT_EQ(p.errors().false_shadow, 0u);
    p.stripe_width = 0.0;
    EXPECT_EQ(p.errors().false_shadow, 1u);
}

TEST(FarErrors, BesideACreaseAreCountedApart) {
    Picture p;
    p.measured[Picture::at(20, 20)] = 0.0f;
    p.creases[Picture::at(21, 20)] = kCreaseRight;  // 1.5 px away
    EXPECT_EQ(p.errors().false_shadow, 0u);
    EXPECT_EQ(p.errors().crease_shadow, 1u);
    p.creases[Picture::at(21, 20)] = 0;
    p.creases[Picture::at(20, 22)] = kCreaseUp;  // 2.5 px
    EXPECT_EQ(p.errors().crease_shadow, 0u);
    p.allowed_px[Picture::at(20, 20)] = 2.5f;
    EXPECT_EQ(p.errors().crease_shadow, 1u);
}

TEST(FarErrors, BesideThePicturesBorderAreNotHeldAgainstPlanes) {
    Picture p;
    p.measured[Picture::at(37, 20)] = 0.0f;  // 2 px
    EXPECT_EQ(p.errors().false_shadow, 1u);
    p.allowed_px[Picture::at(37, 20)] = 3.0f;
    EXPECT_EQ(p.errors().false_shadow, 0u);
    EXPECT_EQ(p.errors().crease_shadow, 1u);
}

TEST(Creases, AreWhereSurfacesBendOrEndAndNotWhereTrianglesOfOnePlaneMeet) {
    PrimaryHits hits;  // four in a row, seen from above
    hits.size_px = {4, 1};
    hits.camera_rel_m = {0.0, 10.0, 0.0};
    hits.triangle = {0, 1, 2, kNoTriangle};
    hits.position_rel_m = {{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {0, 0, 0}};
    const glm::dvec3 up(0.0, 1.0, 0.0);
    hits.normal_ws = {up, up, glm::normalize(glm::dvec3(-0.5, 1.0, 0.0)), up};
    EXPECT_EQ(creases(hits), (std::vector<std::uint8_t>{0, kCreaseRight, kCreaseRight, 0}));
}

}  // namespace
}  // namespace gnomon::oracle
