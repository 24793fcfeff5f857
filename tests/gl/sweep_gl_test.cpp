#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "bench/sweep/sweep.h"
#include "bench/sweep/sweep_json.h"
#include "tests/gl/truth_scenes.h"

// The sweep on the real pipeline: what it finds depends on a row alone.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

bench::SweepRow row(const std::string& name, const std::vector<std::string>& settings,
                    bench::LightKinds kinds = bench::kAllKinds) {
    bench::SweepRow made;
    made.name = name;
    made.factor = "filter";
    made.settings = settings;
    made.kinds = kinds;
    return made;
}

const bench::SweepRow kDefaults = row("defaults", {}), kHard = row("hard", {"filter=hard"}),
                      kLarge = row("large", {"filter=pcf_grid", "resolution=1024"}),
                      kSunAlone = row("one cascade", {"cascades=1"}, bench::only(LightKind::directional)),
                      kSoft = row("soft", {"filter=pcss", "source_radius_m=0.02", "sun_radius_deg=1"}),
                      kNonsense = row("nonsense", {"filter=none such"});

class SweepGl : public TruthTest {
protected:
    const std::filesystem::path& root() const { return own_.path(); }
    bench::SceneSweep sweep(const std::string& folder, std::vector<bench::SweepRow> plan, std::uint32_t rounds = 0,
                            double budget_s = bench::SweepOptions().budget_s) {
        bench::StageOptions stage_options;
        stage_options.size_px = {160, 90};
        const auto stage = open(stage_options);
        if (!stage) return {};
        bench::SweepOptions options;
        options.folder = root() / folder;
        std::filesystem::create_directories(options.folder);
        options.plan = std::move(plan);
        options.rounds = rounds;
        options.budget_s = budget_s;
        options.area_side = area_side_;
        options.progress = [this](const std::string& line) { said_.push_back(line); };
        auto found = bench::measure_sweep(*stage, options);
        if (!found) {
            ADD_FAILURE() << to_line(found.error());
            return {};
        }
        EXPECT_EQ(found.value().gl_complaints, 0u);
        return std::move(found).value();
    }

    /// Returns what the sweep found of each light in this row, except times.
    static nlohmann::ordered_json found(const bench::SceneSweep& sweep, const std::string& name) {
        for (const bench::JudgedRow& judged : sweep.rows)
            if (judged.name == name) {
                auto lights = nlohmann::ordered_json::array();
                for (bench::LightRow light : judged.lights) {
                    light.figures.gpu_us = light.figures.gpu_ratio = light.figures.kept_us = light.figures.kept_ratio =
                        light.figures.cpu_us = {};
                    lights.push_back(bench::to_json(light));
                }
                return lights;
            }
        return nullptr;
    }

    OwnFolder own_;
    std::vector<std::string> said_;
    std::uint32_t area_side_ = 0;
};

TEST_F(SweepGl, JudgesEdgesByThePixelsAreaIfAsked) {
    const bench::SweepRow smooth = row("antialias=on", {"antialias=on"});
    EXPECT_TRUE(found(sweep("without", {kDefaults}), "defaults").at(0)["figures"]["area_error"].is_null());
    area_side_ = 8;
    const bench::SceneSweep judged = sweep("with", {kDefaults, smooth, kSoft});
    auto stairs = found(judged, "defaults"), shares = found(judged, "antialias=on"), soft = found(judged, "soft");
    ASSERT_EQ(stairs.size(), 3u);
    ASSERT_EQ(shares.size(), 3u);
    for (std::size_t light = 0; light < 3; ++light) {
        EXPECT_GT(stairs[light]["figures"]["area_error"].get<double>(), 0.15) << light;
        EXPECT_LT(shares[light]["figures"]["area_error"].get<double>(), 0.06) << light;
        EXPECT_LE(std::abs(shares[light]["figures"]["area_bias"].get<double>()),
                  shares[light]["figures"]["area_error"].get<double>());
        EXPECT_GT(shares[light]["figures"]["area_p99"].get<double>(),
                  shares[light]["figures"]["area_error"].get<double>());
        EXPECT_TRUE(soft[light]["figures"]["area_error"].is_null()) << "a point's truth is not that of its source";
    }
}

TEST_F(SweepGl, ErrorsAreTheSameInAnyOrderOfRows) {
    const auto a = sweep("a", {kDefaults, kHard, kLarge, kSoft, kSunAlone});
    const auto b = sweep("b", {kDefaults, kSunAlone, kSoft, kLarge, kHard});
    for (const char* name : {"defaults", "hard", "large", "soft", "one cascade"}) {
        ASSERT_FALSE(found(a, name).empty()) << name;
        EXPECT_EQ(found(a, name), found(b, name)) << name;
    }
    EXPECT_NE(found(a, "hard"), found(a, "defaults"));
}

TEST_F(SweepGl, ARowThatFailsIsSaidAndTheOthersAreMeasured) {
    const auto all = sweep("a", {kDefaults, kNonsense, kHard}, 1);
    ASSERT_THAT(all.rows, SizeIs(3));
    ASSERT_TRUE(all.rows[1].error);
    EXPECT_THAT(*all.rows[1].error, HasSubstr("set.value"));
    EXPECT_THAT(all.rows[1].lights, SizeIs(0));
    for (const std::size_t i : {0u, 2u}) {
        EXPECT_FALSE(all.rows[i].error);
        ASSERT_THAT(all.rows[i].lights, SizeIs(3));
        for (const bench::LightRow& light : all.rows[i].lights) EXPECT_EQ(light.figures.gpu_ratio.count, 1u);
    }
    EXPECT_THAT(said_, Contains(HasSubstr("nonsense: FAILED")));
}

TEST_F(SweepGl, WhatWasFoundBeforeIsNotMeasuredAgainAndTheRestIs) {
    const auto whole = sweep("a", {kDefaults, kHard, kSoft}, 1);
    const auto journal = root() / "a" / "journal.jsonl";
    std::string text;
    {
        std::ifstream in(journal, std::ios::binary);
        text.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::size_t kept = 0;  // the header and two rows
    for (int line = 0; line < 3; ++line) kept = text.find('\n', kept) + 1;
    std::filesystem::resize_file(journal, kept + 5);
    said_.clear();
    const auto again = sweep("a", {kDefaults, kHard, kSoft}, 1);
    EXPECT_THAT(said_, Contains(HasSubstr("2 rows are taken from an earlier run")));
    EXPECT_THAT(said_, Contains(HasSubstr("row 3 of 3: soft")));
    for (const char* name : {"defaults", "hard", "soft"}) EXPECT_EQ(found(whole, name), found(again, name)) << name;
    said_.clear();
    (void)sweep("a", {kDefaults, kHard}, 1);  // another plan begins from its first row
    EXPECT_THAT(said_, Contains(HasSubstr("row 1 of 2: defaults")));
}

TEST_F(SweepGl, ASpentBudgetEndsTheRoundsButForTheFirst) {
    const auto spent = sweep("spent", {kDefaults, kHard}, 2, 0.0);
    EXPECT_EQ(spent.rounds, 1u);
    EXPECT_THAT(said_, Contains(HasSubstr("times, round 1")));
    EXPECT_THAT(said_, Not(Contains(HasSubstr("times, round 2"))));
    for (const bench::JudgedRow& judged : spent.rows)
        for (const bench::LightRow& light : judged.lights) EXPECT_GT(light.figures.gpu_us.median, 0.0) << judged.name;
    EXPECT_EQ(sweep("ample", {kDefaults, kHard}, 2).rounds, 2u);
    EXPECT_THAT(said_, Contains(HasSubstr("times, round 2")));
}

TEST_F(SweepGl, LightsOfOtherKindsAreNotInARow) {
    const auto all = sweep("a", {kDefaults, kSunAlone});
    ASSERT_THAT(all.rows.at(1).lights, SizeIs(1));
    EXPECT_EQ(all.rows[1].lights[0].kind, LightKind::directional);
    EXPECT_EQ(all.rows[1].lights[0].figures.views, 1.0);
}

TEST_F(SweepGl, SoftRowsAreJudgedByTheDiskAloneAndHardOnesByBoth) {
    const auto all = sweep("a", {kDefaults, kSoft});
    for (const bench::LightRow& light : all.rows.at(0).lights) {
        EXPECT_TRUE(light.figures.wrong);
        EXPECT_TRUE(light.figures.disk_error);
        EXPECT_EQ(light.figures.unexplained, 0.0) << light.light;
    }
    for (const bench::LightRow& light : all.rows.at(1).lights) {
        EXPECT_FALSE(light.figures.wrong);
        EXPECT_TRUE(light.figures.disk_error);
    }
}

}  // namespace
}  // namespace gnomon
