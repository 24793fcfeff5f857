#include "bench/sweep/sweep_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include "gnomon/light.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {
namespace {

constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

/// Applies a row's settings to the defaults; an unknown setting fails the test.
game::LightSettings settings_of(const SweepRow& row) {
    game::LightSettings settings;
    for (const std::string& setting : row.settings)
        if (const auto error = game::apply_setting(settings, setting))
            ADD_FAILURE() << row.name << ": " << to_line(*error);
    return settings;
}

/// Returns whether a row of that factor, for that kind, has settings that satisfy `pleases`.
template <class Pleases>
bool covers(const std::vector<SweepRow>& plan, const std::string& factor, LightKind kind, const Pleases& pleases) {
    return std::any_of(plan.begin(), plan.end(), [&](const SweepRow& row) {
        return row.factor == factor && holds(row.kinds, kind) && pleases(settings_of(row));
    });
}

TEST(SweepPlan, StartsWithTheDefaultsAndNoRowOfAKindIsThereTwice) {
    for (const SweepSize size : {SweepSize::quick, SweepSize::full}) {
        const std::vector<SweepRow> plan = sweep_plan(size);
        ASSERT_FALSE(plan.empty());
        EXPECT_EQ(plan.front().name, kDefaultsRow);
        EXPECT_TRUE(plan.front().settings.empty());
        EXPECT_EQ(plan.front().kinds, kAllKinds);
        std::set<std::string> names;
        std::set<std::pair<LightKind, std::set<std::string>>> seen;
        for (const SweepRow& row : plan) {
            EXPECT_NE(row.kinds, 0) << row.name;
            for (const LightKind kind : kKinds) {
                if (!holds(row.kinds, kind)) continue;
                EXPECT_TRUE(seen.insert({kind, {row.settings.begin(), row.settings.end()}}).second) << row.name;
            }
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
        }
    }
}

TEST(SweepPlan, NoRowSetsWhatTheDefaultsAreAnyway) {
    for (const SweepRow& row : sweep_plan(SweepSize::full)) {
        if (row.factor == kDefaultsRow) continue;
        EXPECT_NE(settings_of(row), game::LightSettings{}) << row.name;
    }
}

/// Counts one row per kind of light.
std::size_t light_rows(const std::vector<SweepRow>& plan) {
    std::size_t count = 0;
    for (const SweepRow& row : plan) count += static_cast<std::size_t>(std::popcount(row.kinds));
    return count;
}

TEST(SweepPlan, IsNoLongerThanAnybodyWaitsForAndTheQuickOneAQuarterOfIt) {
    constexpr LightKinds kUsual = only(LightKind::directional) | only(LightKind::spot) | only(LightKind::point);
    const std::size_t full = light_rows(sweep_plan(SweepSize::full, kUsual));
    const std::size_t quick = light_rows(sweep_plan(SweepSize::quick, kUsual));
    EXPECT_LE(full, kMostSweepRows);
    EXPECT_GE(full, kMostSweepRows / 2);
    EXPECT_LE(quick, kMostSweepRows / 4);
}

TEST(SweepPlan, IsTheSameEveryTime) {
    const auto a = sweep_plan(SweepSize::full), b = sweep_plan(SweepSize::full);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].settings, b[i].settings);
    }
}

TEST(SweepPlan, VariesOneFactorAtATimeOverAllItsValuesForEachKind) {
    const std::vector<SweepRow> plan = sweep_plan(SweepSize::full);
    for (const LightKind kind : kKinds) {
        for (const shadow::FilterRow& row : shadow::filter_table()) {
            if (row.id == LightShadow{}.filter) continue;
            EXPECT_TRUE(covers(plan, "filter", kind, [&](const auto& s) { return s.shadow.filter == row.id; }))
                << row.name;
        }
        for (std::size_t mode = 1; mode < static_cast<std::size_t>(BiasMode::count); ++mode)
            EXPECT_TRUE(covers(plan, "bias", kind, [&](const auto& s) {
                return s.tuning.bias.mode == static_cast<BiasMode>(mode);
            })) << mode;
        for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d16})
            EXPECT_TRUE(
                covers(plan, "format", kind, [&](const auto& s) { return s.tuning.maps.depth_format == format; }));
        for (const std::uint32_t size_px : {512u, 1024u, 2048u})
            EXPECT_TRUE(
                covers(plan, "resolution", kind, [&](const auto& s) { return s.shadow.resolution_px == size_px; }));
    }
    for (const ShadowFit fit : {ShadowFit::tight, ShadowFit::stable})
        EXPECT_TRUE(
            covers(plan, "fit", LightKind::directional, [&](const auto& s) { return s.tuning.cascades.fit == fit; }));
    for (const std::uint32_t count : {1u, 2u, 8u})
        EXPECT_TRUE(covers(plan, "cascades", LightKind::directional,
                           [&](const auto& s) { return s.shadow.cascades == count; }));
}

TEST(SweepPlan, CrossesTheResolutionWithFiltersBiasesAndCascades) {
    const std::vector<SweepRow> plan = sweep_plan(SweepSize::full);
    for (const std::uint32_t size_px : {512u, 1024u, 2048u}) {
        const auto at_size = [&](const auto& also) {
            return [&, size_px](const game::LightSettings& s) { return s.shadow.resolution_px == size_px && also(s); };
        };
        for (const LightKind kind : kKinds) {
            EXPECT_TRUE(covers(plan, "resolution x filter", kind,
                               at_size([](const auto& s) { return s.shadow.filter == ShadowFilter::hard; })));
            EXPECT_TRUE(covers(plan, "resolution x bias", kind,
                               at_size([](const auto& s) { return s.tuning.bias.mode == BiasMode::normal_offset; })));
        }
        EXPECT_TRUE(covers(plan, "resolution x cascades", LightKind::directional,
                           at_size([](const auto& s) { return s.shadow.cascades == 1; })));
    }
}

TEST(SweepPlan, GivesALightOnlyWhatItsKindKnows) {
    for (const SweepRow& row : sweep_plan(SweepSize::full)) {
        const game::LightSettings settings = settings_of(row), defaults;
        if (settings.tuning.cascades.fit == defaults.tuning.cascades.fit &&
            settings.shadow.cascades == defaults.shadow.cascades)
            continue;
        EXPECT_EQ(row.kinds, only(LightKind::directional)) << row.name;
    }
    for (const LightKind kind : kKinds)
        for (const SweepRow& row : sweep_plan(SweepSize::full, only(kind)))
            EXPECT_EQ(row.kinds, only(kind)) << row.name;
    EXPECT_TRUE(sweep_plan(SweepSize::full, 0).empty());
}

TEST(SweepPlan, HasWhatATutorialGivesEachKind) {
    for (const LightKind kind : kKinds)
        EXPECT_TRUE(covers(sweep_plan(SweepSize::quick), std::string(kTutorialFactor), kind, [](const auto& s) {
            return s.shadow.resolution_px == 1024 && s.tuning.bias.mode == BiasMode::tutorial_cosine;
        }));
    EXPECT_TRUE(covers(sweep_plan(SweepSize::quick), std::string(kTutorialFactor), LightKind::directional,
                       [](const auto& s) { return s.shadow.resolution_px == 8428; }));
}

}  // namespace
}  // namespace gnomon::bench
