#include "bench/sweep/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/sweep/sweep_report.h"
#include "tests/unit/bench/sweep/made_up_sweep.h"

namespace gnomon::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr auto kPoint = SweepTruth::point;
constexpr auto kDrawn = SweepCost::drawn;

std::vector<std::string> front_of(const SceneSweep& sweep) {
    std::vector<std::string> names;
    for (const Choice& choice : choices(sweep, "sun", kPoint, kDrawn))
        if (choice.best) names.push_back(sweep.plan[choice.row].name);
    return names;
}

TEST(SweepFindings, TheFrontIsWhatNothingBeatsTheCheapestFirst) {
    const SceneSweep sweep =
        made_up_sweep({{"defaults", 0.02, 1.0}, {"fine", 0.005, 3.0}, {"poor", 0.03, 2.0}, {"cheap", 0.04, 0.5}});
    EXPECT_THAT(front_of(sweep), ElementsAre("cheap", "defaults", "fine"));
}

TEST(SweepFindings, TheDefaultsCostOneWhateverTheirOwnRowShows) {
    const SceneSweep sweep = made_up_sweep({{"defaults", 0.02, 1.4}, {"other", 0.03, 1.2}});
    EXPECT_THAT(front_of(sweep), ElementsAre("defaults"));
    EXPECT_EQ(choices(sweep, "sun", kPoint, kDrawn).front().cost, 1.0);
}

TEST(SweepFindings, WhereEachHalvingTakesTwiceTheTimeTheFactorIsTwo) {
    const SceneSweep sweep =
        made_up_sweep({{"a", 0.08, 1.0}, {"b", 0.04, 2.0}, {"c", 0.02, 4.0}, {"d", 0.01, 8.0}, {"beaten", 0.05, 3.0}});
    const HalvingCost found = halving_cost(sweep, "sun", kPoint, kDrawn);
    ASSERT_EQ(found.steps.size(), 3u);
    for (const Halving& step : found.steps) {
        EXPECT_DOUBLE_EQ(step.error_factor(), 0.5);
        EXPECT_DOUBLE_EQ(step.cost_factor(), 2.0);
    }
    ASSERT_TRUE(found.factor);
    EXPECT_NEAR(*found.factor, 2.0, 1.0e-9);
}

TEST(SweepFindings, AStepThatGainsMoreThanHalfCountsForAsManyHalvings) {
    const SceneSweep sweep = made_up_sweep({{"a", 0.08, 1.0}, {"b", 0.01, 8.0}});  // an eighth for eight times the time
    const HalvingCost found = halving_cost(sweep, "sun", kPoint, kDrawn);
    ASSERT_EQ(found.steps.size(), 1u);
    EXPECT_NEAR(*found.factor, 2.0, 1.0e-9);
}

TEST(SweepFindings, FromTheDefaultsItIsTheCheapestRowWithHalfTheirError) {
    const SceneSweep sweep = made_up_sweep(
        {{"defaults", 0.02, 1.0, "defaults"}, {"half", 0.01, 1.5}, {"finer", 0.001, 4.0}, {"cheap", 0.1, 0.5}});
    const HalvingCost found = halving_cost(sweep, "sun", kPoint, kDrawn);
    ASSERT_TRUE(found.from_defaults);
    EXPECT_EQ(sweep.plan[found.from_defaults->to.row].name, "half");
    EXPECT_DOUBLE_EQ(found.from_defaults->cost_factor(), 1.5);
}

TEST(SweepFindings, WhereNothingIsTwiceAsGoodThereIsNoFactor) {
    const SceneSweep sweep = made_up_sweep({{"defaults", 0.02, 1.0, "defaults"}, {"fine", 0.015, 3.0}});
    const HalvingCost found = halving_cost(sweep, "sun", kPoint, kDrawn);
    EXPECT_THAT(found.steps, IsEmpty());
    EXPECT_FALSE(found.factor);
    EXPECT_FALSE(found.from_defaults);
    EXPECT_FALSE(halving_cost(sweep, "no such light", kPoint, kDrawn).factor);
}

TEST(SweepFindings, NoWrongPixelAtAllCountsAsHalfOfOne) {
    const SceneSweep sweep = made_up_sweep({{"a", 1.0e-6, 1.0}, {"none", 0.0, 2.0}});
    const auto all = choices(sweep, "sun", kPoint, kDrawn);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_DOUBLE_EQ(all.back().error, 0.5e-6);
    EXPECT_NEAR(*halving_cost(sweep, "sun", kPoint, kDrawn).factor, 2.0, 1.0e-6);
}

TEST(SweepFindings, RowsThatFailedOrHaveNoTimesAreNoChoice) {
    SceneSweep sweep = made_up_sweep({{"a", 0.08, 1.0}, {"failed", 0.04, 2.0}, {"untimed", 0.02, 4.0}});
    sweep.rows[1].error = "cannot";
    sweep.rows[1].lights.clear();
    sweep.rows[2].lights[0].figures.gpu_ratio = {};
    EXPECT_THAT(front_of(sweep), ElementsAre("a"));
}

TEST(SweepFindings, DefaultsAboveTheirBoundSayWhyAndWhatReachingItTakes) {
    SceneSweep sweep = made_up_sweep(
        {{"defaults", 0.0011, 1.0}, {"fine", 0.0004, 3.0}, {"finer", 0.0001, 5.0}, {"nearly", 0.0006, 1.5}});
    RowFigures& figures = sweep.rows[0].lights[0].figures;
    figures.sub_texel_caster = 40.0;
    figures.truth_ambiguous = 2.0;
    figures.unexplained = 0.0;
    const auto missed = missed_by_defaults(sweep, "sun", kDrawn);
    ASSERT_TRUE(missed);
    EXPECT_EQ(missed->sub_texel, 40.0);
    EXPECT_EQ(missed->beyond, 42.0);
    ASSERT_TRUE(missed->reached);
    EXPECT_EQ(sweep.plan[missed->reached->row].name, "fine");
    const std::string said = halving_sentences(sweep).at(0);
    EXPECT_THAT(said, HasSubstr("Above what defaults are to keep: 0.11 % wrong (0.05 %); of the 42 places"));
    EXPECT_THAT(said, HasSubstr("40 belong to shadows or lights narrower than a texel"));
    EXPECT_THAT(said, HasSubstr("Reaching it takes × 3 their time, by “fine” (0.04 %)."));
    sweep.rows[1] = sweep.rows[2] = JudgedRow{};
    EXPECT_THAT(halving_sentences(sweep).at(0), HasSubstr("No row of this sweep reaches it."));
}

TEST(SweepFindings, DefaultsThatLeakOrHaveAcneSaySoAndWhichRowDoesNot) {
    SceneSweep sweep = made_up_sweep({{"defaults", 0.0004, 1.0}, {"leaks", 0.0001, 2.0}, {"tight", 0.0003, 3.0}});
    sweep.rows[0].lights[0].figures.leak = 0.00012;
    sweep.rows[1].lights[0].figures.leak = 0.00011;
    EXPECT_THAT(halving_sentences(sweep).at(0), HasSubstr("0.012 % leak (0.01 %). "));
    EXPECT_THAT(halving_sentences(sweep).at(0), Not(HasSubstr("true edge"))) << "nobody looked";
    sweep.rows[0].lights[0].figures.false_light_far = 0.0;
    EXPECT_THAT(halving_sentences(sweep).at(0),
                HasSubstr("0.012 % leak (0.01 %), all of that within half a texel of the map of a true edge."));
    EXPECT_THAT(halving_sentences(sweep).at(0), HasSubstr("Reaching it takes × 3 their time, by “tight” (0.03 %)."));
    EXPECT_THAT(halving_sentences(sweep).at(0), Not(HasSubstr("0.05 %"))) << "of wrong pixels it has few enough";
    sweep.rows[0].lights[0].figures.false_light_far = 3.0e-5;
    EXPECT_THAT(halving_sentences(sweep).at(0), HasSubstr("(0.01 %), 75 % of that within half a texel"));
    sweep.rows[0].lights[0].figures.leak = 0.0001;
    EXPECT_FALSE(missed_by_defaults(sweep, "sun", kDrawn));
    sweep.rows[0].lights[0].figures.acne = 1.0e-6;
    ASSERT_TRUE(missed_by_defaults(sweep, "sun", kDrawn));
    EXPECT_THAT(halving_sentences(sweep).at(0), HasSubstr("0.0001 % acne (none)"));
}

TEST(SweepFindings, DefaultsWithinTheirBoundMissNothing) {
    const SceneSweep sweep = made_up_sweep({{"defaults", 0.0005, 1.0}, {"fine", 0.0001, 3.0}});
    EXPECT_FALSE(missed_by_defaults(sweep, "sun", kDrawn));
    EXPECT_THAT(halving_sentences(sweep).at(0), Not(HasSubstr("above")));
    EXPECT_FALSE(missed_by_defaults(sweep, "moon", kDrawn)) << "it has no rows";
}

TEST(SweepFindings, DefaultsStandBesideTheFirstTutorialThatTheLightHas) {
    const std::string tutorials(kTutorialFactor);
    SceneSweep sweep =
        made_up_sweep({{"defaults", 0.0001, 1.0}, {"taps", 0.05, 0.625, tutorials}, {"cheaper", 0.08, 0.5, tutorials}});
    const auto beside = beside_tutorial(sweep, "sun");
    ASSERT_TRUE(beside);
    EXPECT_EQ(sweep.plan[beside->tutorial.row].name, "taps");
    EXPECT_DOUBLE_EQ(beside->drawn, 1.6);
    EXPECT_FALSE(beside->kept) << "no times";
    EXPECT_THAT(halving_sentences(sweep).at(0),
                HasSubstr(" With every map drawn anew they take × 1.6 the time of “taps” (5 %)."));
    sweep.rows[0].lights[0].figures.kept_us = {30.0, 29.0, 31.0, 3};
    sweep.rows[1].lights[0].figures.gpu_us = {24.0, 23.0, 25.0, 3};
    sweep.rows[1].lights[0].figures.kept_us = {20.0, 19.0, 21.0, 3};
    EXPECT_DOUBLE_EQ(beside_tutorial(sweep, "sun")->kept.value(), 1.25) << "the tutorial keeps nothing";
    EXPECT_THAT(
        halving_sentences(sweep).at(0),
        HasSubstr("they take × 1.25 the time of “taps” (5 %), which draws its own in every frame; × 1.6 with every"));
    EXPECT_FALSE(beside_tutorial(sweep, "moon"));
    sweep.rows[1].error = sweep.rows[2].error = "cannot";
    sweep.rows[1].lights.clear();
    sweep.rows[2].lights.clear();
    EXPECT_FALSE(beside_tutorial(sweep, "sun"));
    EXPECT_THAT(halving_sentences(sweep).at(0), Not(HasSubstr("they take")));
}

TEST(SweepFindings, ABargainIsTheBestThatNoMoreTimeBuys) {
    const SceneSweep sweep = made_up_sweep(
        {{"tutorial", 0.08, 1.0, std::string(kTutorialFactor)}, {"a", 0.04, 0.8}, {"b", 0.02, 1.0}, {"c", 0.01, 2.0}});
    const std::vector<Bargain> found = bargains(sweep, "sun", kDrawn);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(sweep.plan[found[0].best.row].name, "b");
}

TEST(SweepFindings, NeverBestAreThoseThatAreOnNoFront) {
    const SceneSweep sweep = made_up_sweep({{"a", 0.08, 1.0}, {"b", 0.1, 2.0}, {"c", 0.01, 4.0}});
    EXPECT_THAT(never_best(sweep), ElementsAre("b"));
}

}  // namespace
}  // namespace gnomon::bench
