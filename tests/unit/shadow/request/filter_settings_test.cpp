#include "systems/shadow/request/filter_settings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "systems/shadow/request/filter_table.h"
#include "tests/unit/not_finite.h"

namespace gnomon::shadow {
namespace {

constexpr std::uint32_t kMap_px = 1024;

/// Makes a light of that filter.
LightItem of(ShadowFilter filter, const ShadowTuning::Kernel& kernel = {}) {
    LightItem light;
    light.shadow.filter = filter;
    light.tuning.kernel = kernel;
    return light;
}
/// Makes a light of either kind with a source of that radius: radians for a sun, metres for a lamp.
LightItem sized(LightKind kind, float size) {
    LightItem light = of(ShadowFilter::pcss);
    light.kind = kind;
    (kind == LightKind::directional ? light.sun_radius_rad : light.source_radius_m) = size;
    return light;
}

TEST(FilterSettings, OfEveryRowIsAsAskedForByTheDefaults) {
    for (const FilterRow& row : filter_table()) {
        SCOPED_TRACE(row.name);
        const FilterSettings filter = filter_settings(row, {}, kMap_px);
        EXPECT_FALSE(filter.cut);
        EXPECT_GE(filter.reach_texel, row.reach_texel);
        EXPECT_GE(filter.widest_texel, filter.reach_texel);
        EXPECT_GE(row.taps({}, false), 1u);
        EXPECT_GE(row.taps({}, true), row.taps({}, false));
    }
}

TEST(FilterSettings, WhatIsReadButCannotMoveAnEdgeIsLeftOutOfTheEdgesBound) {
    for (const FilterRow& row : filter_table()) {
        SCOPED_TRACE(row.name);
        const FilterSettings filter = filter_settings(row, {}, kMap_px);
        EXPECT_EQ(edge_texel_at(filter, 0.01), reach_texel_at(filter, 0.01) - static_cast<double>(row.still_texel));
        EXPECT_GE(edge_texel_at(filter, 0.01), 0.5) << "the texel that is hit";
        EXPECT_EQ(row.still_texel > 0.0f, row.reading == MapReading::depths && !row.rays) << "rays move none";
    }
    EXPECT_EQ(edge_texel_at(filter_settings(of(ShadowFilter::sharp_4x4), kMap_px), 0.01), 0.5);
}

TEST(FilterSettings, HalfTheGridAddsToWhatOneTapReaches) {
    for (const std::uint32_t size : {1u, 3u, 5u, 7u, 31u}) {
        const float half = 0.5f * static_cast<float>(size - 1);
        EXPECT_EQ(filter_settings(of(ShadowFilter::pcf_grid, {.size_texel = size}), kMap_px).widest_texel, 0.5f + half);
        EXPECT_EQ(filter_settings(of(ShadowFilter::pcf_bilinear, {.size_texel = size}), kMap_px).widest_texel,
                  1.0f + half);
        EXPECT_EQ(filter_settings(of(ShadowFilter::hard, {.size_texel = size}), kMap_px).widest_texel, 0.5f)
            << "it has no size";
    }
}

TEST(FilterSettings, AnEvenOrAbsurdSizeBecomesTheNextOddOneBelowThatTheMapBears) {
    const auto demand = [](std::uint32_t size, std::uint32_t map_px) {
        return filter_settings(of(ShadowFilter::pcf_grid, {.size_texel = size}), map_px);
    };
    EXPECT_EQ(demand(4, kMap_px).size, 3u);
    EXPECT_EQ(demand(0, kMap_px).size, 1u);
    EXPECT_EQ(demand(4000000000u, kMap_px).size, kMostFilterSize);
    EXPECT_EQ(demand(31, 16).size, 5u) << "an eighth of 16 texels to either side";
    for (const std::uint32_t size : {0u, 4u, 33u}) EXPECT_TRUE(demand(size, kMap_px).cut) << size;
}

TEST(FilterSettings, ASpreadInTexelsIsKeptAndOneInMetresOrThatGrowsIsBoundedByTheMost) {
    LightItem light = of(ShadowFilter::poisson, {.spread_texel = 3.0f});
    EXPECT_EQ(filter_settings(light, kMap_px).widest_texel, 3.5f);
    light.tuning.kernel.doubles_m = 10.0f;
    EXPECT_EQ(filter_settings(light, kMap_px).widest_texel, 0.5f + kMostSpread_texel);
    light.tuning.kernel.doubles_m = 0.0f;
    light.tuning.kernel.spread_m = 0.1f;
    const FilterSettings metres = filter_settings(light, kMap_px);
    EXPECT_EQ(metres.widest_texel, 0.5f + kMostSpread_texel);
    EXPECT_NEAR(reach_texel_at(metres, 0.05), 2.5, 1e-6);
    EXPECT_EQ(reach_texel_at(metres, 1e-9), 0.5 + static_cast<double>(kMostSpread_texel));
    EXPECT_EQ(reach_texel_at(metres, 0.0), 0.5 + static_cast<double>(kMostSpread_texel));
    EXPECT_EQ(filter_settings(light, 64).widest_texel, 8.5f) << "an eighth of the map";
}

TEST(FilterSettings, ASourceWithASizeReachesAsFarAsTheMapBearsAndMovesNoEdge) {
    const FilterSettings point = filter_settings(of(ShadowFilter::pcss), kMap_px);
    EXPECT_FALSE(needs_distances(point));
    EXPECT_EQ(point.widest_texel, filter_row(ShadowFilter::pcss).reach_texel);
    EXPECT_EQ(point.border_texel, point.widest_texel);
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        LightItem light = sized(kind, 0.01f);
        const FilterSettings wide = filter_settings(light, kMap_px);
        EXPECT_TRUE(needs_distances(wide));
        EXPECT_FALSE(wide.cut);
        EXPECT_EQ(wide.widest_texel, point.widest_texel + kMostPenumbra_texel);
        EXPECT_EQ(2.0f * wide.border_texel, 2.0f * point.border_texel + kMostPenumbra_texel) << "the bias moves nothing";
        EXPECT_EQ(edge_texel_at(wide, 0.01), edge_texel_at(point, 0.01)) << "a penumbra lies to both sides";
        EXPECT_EQ(filter_settings(light, 64).widest_texel, point.widest_texel + 8.0f) << "an eighth of the map";
        EXPECT_EQ(filter_settings(light, 1u << 14).widest_texel, wide.widest_texel);
        light.shadow.filter = ShadowFilter::sharp_4x4;
        EXPECT_FALSE(needs_distances(filter_settings(light, kMap_px))) << "no other row asks for it";
    }
    LightItem sun = sized(LightKind::directional, 0.00465f);
    EXPECT_NEAR(filter_settings(sun, kMap_px).sun_radius_tan, 0.00465f, 1e-7f);
    sun.kind = LightKind::spot;
    EXPECT_FALSE(needs_distances(filter_settings(sun, kMap_px))) << "a sun's size is none of a lamp's";
}

TEST(FilterSettings, ASourceThatIsAbsurdIsCutAndReported) {
    for (const float absurd : {kFloatNan, kFloatInfinity, -1.0f, 1.0e30f})
        for (const LightKind kind : {LightKind::directional, LightKind::point}) {
            const FilterSettings filter = filter_settings(sized(kind, absurd), kMap_px);
            EXPECT_TRUE(filter.cut) << absurd;
            EXPECT_TRUE(filter.source_radius_m >= 0.0f && filter.source_radius_m <= kMostSourceRadius_m);
            EXPECT_TRUE(filter.sun_radius_tan >= 0.0f && filter.sun_radius_tan < 1.0f);
        }
}

TEST(FilterSettings, EachIsTakenUpToItsLimitAndCutToItBeyond) {
    using Kernel = ShadowTuning::Kernel;
    const auto settings = [](ShadowFilter filter, const Kernel& kernel) { return filter_settings(of(filter, kernel), kMap_px); };
    for (const bool beyond : {false, true}) {
        SCOPED_TRACE(beyond);
        const FilterSettings size = settings(ShadowFilter::pcf_grid, {.size_texel = beyond ? 33u : 31u});
        EXPECT_EQ(size.size, 31u);
        EXPECT_EQ(size.cut, beyond);
        const FilterSettings taps = settings(ShadowFilter::poisson, {.taps = beyond ? 33u : 32u});
        EXPECT_EQ(taps.taps, 32u);
        EXPECT_EQ(taps.cut, beyond);
        const FilterSettings spread = settings(ShadowFilter::poisson, {.spread_texel = beyond ? 16.5f : 16.0f});
        EXPECT_EQ(spread.spread_texel, 16.0f);
        EXPECT_EQ(spread.cut, beyond);
        const FilterSettings lamp = filter_settings(sized(LightKind::point, beyond ? 1.001e4f : 1.0e4f), kMap_px);
        EXPECT_EQ(lamp.source_radius_m, 1.0e4f);
        EXPECT_EQ(lamp.cut, beyond);
        constexpr float kThirtyDegrees_rad = 0.523598f;
        const FilterSettings sun = filter_settings(sized(LightKind::directional, kThirtyDegrees_rad * (beyond ? 1.01f : 1.0f)), kMap_px);
        EXPECT_NEAR(sun.sun_radius_tan, std::tan(kThirtyDegrees_rad), 2e-6f);
        EXPECT_EQ(sun.cut, beyond);
    }
}

TEST(FilterSettings, NumbersThatAreNoneGiveWayToTheDefaultsAndAreReported) {
    for (const float absurd : {kFloatNan, kFloatInfinity, -1.0f})
        for (const auto field : {&ShadowTuning::Kernel::spread_texel, &ShadowTuning::Kernel::spread_m,
                                 &ShadowTuning::Kernel::doubles_m, &ShadowTuning::Kernel::cell_m}) {
            LightItem light = of(ShadowFilter::poisson_rotated);
            const FilterSettings usual = filter_settings(light, kMap_px);
            light.tuning.kernel.*field = absurd;
            const FilterSettings filter = filter_settings(light, kMap_px);
            EXPECT_TRUE(filter.cut) << absurd;
            EXPECT_EQ(filter.widest_texel, usual.widest_texel) << absurd;
            EXPECT_GT(filter.cell_m, 0.0f);
        }
    EXPECT_TRUE(filter_settings(of(ShadowFilter::poisson, {.taps = 0}), kMap_px).cut);
    EXPECT_EQ(filter_settings(of(ShadowFilter::poisson, {.taps = 99}), kMap_px).taps, kMostFilterTaps);
    EXPECT_FALSE(filter_settings(of(ShadowFilter::hard, {.spread_m = kFloatNan}), kMap_px).cut) << "it has no spread";
}

}  // namespace
}  // namespace gnomon::shadow
