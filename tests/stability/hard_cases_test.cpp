#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string_view>

#include "tests/stability/hard_cases.h"
#include "tests/stability/hard_cases_oracle.h"

namespace gnomon::hard {

namespace {

class HardCases : public ::testing::TestWithParam<HardCase> {};

TEST_P(HardCases, MatricesAreFiniteReceiversInsideCastersKeptAndSkipsExplained) {
    const HardCase& row = GetParam();
    if (row.build) {
        World world;
        row.build(world);
        std::size_t darkened = 0;
        expect_sound(world, row.name, &darkened);
        const bool shows_none = std::string_view(row.name) == "empty_sets";
        EXPECT_EQ(darkened == 0, shows_none) << darkened << " points in shadow";
    }
    if (row.check) row.check();
}

TEST_P(HardCases, HoldUnderEveryFitWhileTheCameraWalks) {
    constexpr int kFrames = 4;
    const HardCase& row = GetParam();
    if (!row.build) return;
    for (const char* fit : {"fit=tight", "fit=stable", "fit=quantised"}) {
        SCOPED_TRACE(fit);
        World world;
        world.settings = {fit, "cascade_blend=0.2"};
        row.build(world);
        Stages stages(world);
        for (int i = 0; i < kFrames; ++i) {
            if (i > 0) world.nudge_cameras();
            stages.run();
        }
        expect_sound(stages, row.name);  // by now fits kept from an earlier frame may be out of date
    }
}

TEST_P(HardCases, TheSameWorldGivesTheSameBits) {
    const HardCase& row = GetParam();
    if (!row.build) return;
    std::vector<glm::mat4> matrices[2];
    for (auto& all : matrices) {
        World world;
        row.build(world);
        Stages stages(world);
        stages.run();
        for (const shadow::ShadowView& view : stages.frame().fitted.views) all.push_back(view.clip_from_anchor);
    }
    EXPECT_EQ(matrices[0], matrices[1]);
}

INSTANTIATE_TEST_SUITE_P(EachRow, HardCases, ::testing::ValuesIn(hard_cases().begin(), hard_cases().end()),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(HardCaseTable, HasEachRowOnceUnderANameOfItsOwn) {
    constexpr std::size_t kRows = 44;  // as many situations as the list has that the table was made from
    std::set<std::string> names;
    for (const HardCase& row : hard_cases()) {
        names.insert(row.name);
        EXPECT_TRUE(row.build || row.check) << row.name;
    }
    EXPECT_EQ(names.size(), hard_cases().size());
    EXPECT_EQ(names.size(), kRows);
}

// Negative controls: the oracle must see what is broken on purpose.
TEST(HardCaseOracle, SeesACasterThatIsNotInItsViewsList) {
    World world;
    world.ground(6.0);
    world.box({-0.6, 0.5, -0.5}, {0.5, 1.2, 0.6});
    world.sun(kSlant);
    world.camera();
    Stages stages(world);
    stages.run();
    EXPECT_EQ(judge(stages).missed, 0u);
    for (shadow::ShadowView& view : const_cast<shadow::ShadowFrame&>(stages.frame()).fitted.views) view.casters.count = 0;
    const Verdict verdict = judge(stages);
    EXPECT_GT(verdict.missed, 10u);
    EXPECT_NE(verdict.first, "");
}

TEST(HardCaseOracle, SeesReceiversOutsideAndMatricesThatAreNone) {
    World world;
    world.ground(6.0);
    world.box({-0.6, 0.5, -0.5}, {0.5, 1.2, 0.6});
    world.sun(kSlant);
    world.camera();
    Stages stages(world);
    stages.run();
    auto& views = const_cast<shadow::ShadowFrame&>(stages.frame()).fitted.views;
    const auto sound = views;
    for (shadow::ShadowView& view : views) view.map_from_anchor[3][0] += 0.3f;
    EXPECT_GT(judge(stages).outside, 10u);
    views = sound;
    views.front().clip_from_anchor[2][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(judge(stages).not_finite, 1u);
}

}  // namespace
}  // namespace gnomon::hard
