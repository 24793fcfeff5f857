#include "tests/oracle/edge_exceptions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kSize_px = 120;
constexpr double kWidth_m = 12.0;  // 10 px to a metre
const glm::dvec3 kOverhead(0.0, 1.0, 0.0), kSlanting(2.0, 1.0, 0.0);

/// A floor from above, with plates before the sun.
struct Floor : AnalyticScene {
    explicit Floor(const glm::dvec3& toward_sun) : light(sun(toward_sun)) { place_floor(100.0); }

    /// Adds a level plate from x0 to x1, 8 m deep.
    void plate(double x0, double x1, double y) {
        place(add_cube(), {0.5 * (x0 + x1), y, 0.0}, glm::dmat3({x1 - x0, 0, 0}, {0, 1e-3, 0}, {0, 0, 8}));
        snapshot.instances.back().visible = false;
    }

    /// Judges the truth shifted `shift_px` to the right, or an all-lit picture, by texels of that size.
    EdgeExceptions judge(int shift_px, double texel_m, double error_px, bool all_lit = false) {
        const ConsumerItem camera = view_from_above(kSize_px, kWidth_m);
        const ReferenceTracer tracer = this->tracer();
        const PrimaryHits hits = tracer.trace_primary(camera);
        const LightTruth truth = tracer.trace_light(hits, light, true);
        std::vector<float> measured(truth.visibility.size(), 1.0f);
        for (int y = 0; y < static_cast<int>(kSize_px) && !all_lit; ++y)
            for (int x = 0; x < static_cast<int>(kSize_px); ++x) {
                const int from = std::clamp(x - shift_px, 0, static_cast<int>(kSize_px) - 1);
                measured[static_cast<std::size_t>(y) * kSize_px + static_cast<std::size_t>(x)] =
                    truth.visibility[static_cast<std::size_t>(y) * kSize_px + static_cast<std::size_t>(from)];
            }
        const Metrics metrics =
            compare({{kSize_px, kSize_px}, measured, truth.visibility, truth.scored, truth.ambiguous});
        places = metrics.edge.places;
        const glm::dmat3& axes = light.rotation_ws;
        const auto texel_at = [&](const glm::dvec3&, const glm::dvec3&) {
            return TexelThere{axes[0] * texel_m, axes[1] * texel_m, 0.5, reach_texel, error_px, depth_m};
        };
        return edge_exceptions(tracer, hits, camera, light, truth, metrics.edge, texel_at);
    }

    LightItem light;
    double reach_texel = 0.5, depth_m = 0.0;  // for the texels that judge() assumes
    std::size_t places = 0;
};

TEST(EdgeExceptions, AnEdgeWithinItsBoundIsNone) {
    Floor floor(kOverhead);
    floor.plate(-2.0, 2.0, 3.0);
    EXPECT_EQ(floor.judge(1, 0.1, 1.5).beyond(), 0u);
    EXPECT_GT(floor.places, 100u);
}

TEST(EdgeExceptions, AWideShadowsEdgeBeyondItsBoundIsUnexplained) {
    Floor floor(kOverhead);
    floor.plate(-2.0, 2.0, 3.0);
    const EdgeExceptions e = floor.judge(3, 0.1, 1.5);
    EXPECT_GT(e.unexplained, 100u);
    EXPECT_EQ(e.unexplained, e.unexplained_places.size());
    EXPECT_EQ(e.truth_ambiguous, 0u);
    EXPECT_LE(e.sub_texel_caster, 8u) << "the corners, at most";
}

TEST(EdgeExceptions, AShadowThinnerThanATexelMayVanishAndAWiderOneMayNot) {
    Floor floor(kOverhead);
    floor.plate(0.01, 0.32, 3.0);  // 3 px
    const EdgeExceptions coarse = floor.judge(0, 0.5, 5.0, true);
    EXPECT_GT(coarse.sub_texel_caster, 100u);
    EXPECT_EQ(coarse.unexplained, 0u);
    EXPECT_GT(floor.judge(0, 0.1, 2.0, true).unexplained, 100u);
}

TEST(EdgeExceptions, SoMayAGapOfLight) {
    Floor floor(kOverhead);
    floor.plate(-3.0, 0.01, 3.0);
    floor.plate(0.32, 3.0, 3.0);
    for (const double texel_m : {0.5, 0.1}) {
        const EdgeExceptions e = floor.judge(5, texel_m, 0.5 * texel_m * 10.0 + 1.0);
        EXPECT_EQ(e.sub_texel_caster > 150, texel_m > 0.3);  // both sides of the gap
        EXPECT_GT(e.unexplained, 100u) << "the plates' outer edges";
    }
}

TEST(EdgeExceptions, ACasterNearerThanTheSlopeOfItsReceiverOverATexelIsBelowATexel) {
    for (const double above_m : {0.02, 1.0}) {
        Floor floor(kSlanting);
        floor.plate(-2.0, 2.0, above_m);
        const EdgeExceptions e = floor.judge(4, 0.2, 2.0);
        EXPECT_EQ(e.unexplained == 0, above_m < 0.1);
        EXPECT_GT(e.beyond(), 100u);
    }
}

TEST(EdgeExceptions, ACasterNearerThanTheDepthsThatAMapTellsApartIsBelowATexel) {
    for (const double min_resolvable_gap_m : {0.9, 1.1}) {
        Floor floor(kOverhead);
        floor.plate(-2.0, 2.0, 1.0);
        floor.depth_m = min_resolvable_gap_m;
        const EdgeExceptions e = floor.judge(3, 0.1, 1.5);
        EXPECT_EQ(e.unexplained == 0, min_resolvable_gap_m > 1.0);
        EXPECT_GT(e.beyond(), 100u);
    }
}

TEST(EdgeExceptions, ASlitThatAWideFilterSeesBetweenTwoOfItsWidthsIsFound) {
    for (const double slit_m : {0.0, 0.04}) {
        Floor floor(kOverhead);
        floor.reach_texel = 4.0;
        floor.plate(-2.0, 1.48, 3.0);
        floor.plate(1.48 + slit_m, 2.0, 3.0);
        // Right of the slit no footprint of 0.8 m lies within the plate, left of it all are farther off than the bound.
        const EdgeExceptions e = floor.judge(6, 0.1, 5.5);
        EXPECT_GT(e.unexplained, 50u) << "the left edge";
        EXPECT_EQ(e.sub_texel_caster > 50, slit_m > 0.0) << "the right edge";
    }
}

TEST(EdgeExceptions, WhatIsDecidedByTheLastDigitsIsAmbiguous) {
    Floor floor(kOverhead);
    floor.plate(-2.0, 2.05, 3.0);                       // its right edge runs through the pixels' centres
    const EdgeExceptions e = floor.judge(3, 0.0, 1.0);  // a map without end
    EXPECT_GT(e.truth_ambiguous, 50u);
    EXPECT_GT(e.unexplained, 50u) << "the left edge";
}

}  // namespace
}  // namespace gnomon::oracle
