#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

#include "bench/accuracy/reference_images.h"
#include "bench/compare/evaluate_configuration.h"
#include "bench/sweep/sweep_plan.h"
#include "gnomon/components.h"
#include "tests/gl/recorded_errors.h"
#include "tests/gl/truth_scenes.h"
#include "tests/source_paths.h"

// The regression gate: a small fixed sweep. Its wrong pixels are counted and may not exceed the recorded numbers. Only
// one software device counts the same everywhere, to the pixel. Times are never gated.
namespace gnomon {
namespace {

using test::ErrorCounts;
using test::ErrorsByRow;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr glm::uvec2 kGateSize_px{400, 225};
/// Rows of the quick sweep, beside what tutorials set up: one per way to filter, fit, store and bias.
constexpr std::string_view kRows[] = {bench::kDefaultsRow, "fit=tight", "fit=stable",         "cascades=1",
                                      "cascades=4",        "hard",      "bias=normal_offset", "hard, resolution=512",
                                      "depth_format=d24",  "sharp_4x4", "hardware_2x2",       "poisson_4",
                                      "pcf_grid_3",        "moments_3", "resolution=1024",    "evsm4_3"};

std::filesystem::path record_file() {
    return test::source_folder() / "tests/gl/recorded_errors.txt";
}

std::vector<bench::SweepRow> gated_rows() {
    std::vector<bench::SweepRow> rows = bench::sweep_plan(bench::SweepSize::quick);
    std::erase_if(rows, [](const bench::SweepRow& row) {
        return row.factor != bench::kTutorialFactor &&
               std::find(std::begin(kRows), std::end(kRows), row.name) == std::end(kRows);
    });
    return rows;
}

class ErrorGate : public TruthTest {
protected:
    /// Opens the stage and traces its truths. Returns false, and fails the test, if either fails.
    bool open_stage() {
        bench::StageOptions options;
        options.size_px = kGateSize_px;
        stage_ = open(options);
        if (!stage_) return false;
        auto truths = bench::trace_truths(*stage_);
        if (!truths) {
            ADD_FAILURE() << to_line(truths.error());
            return false;
        }
        truths_ = std::move(truths).value();
        return true;
    }
    const std::string& device() const { return stage_->device().info().name; }
    bool counts_as_recorded() const { return device().find("llvmpipe") != std::string::npos; }

    ErrorsByRow judge(const std::vector<bench::SweepRow>& rows) {
        ErrorsByRow found;
        for (const bench::SweepRow& row : rows) {
            const bench::JudgedRow judged = bench::judge_row(*stage_, truths_, row, {.edges = false});
            EXPECT_FALSE(judged.error) << row.name << ": " << judged.error.value_or("");
            for (const bench::LightRow& light : judged.lights) found[{light.light, row.name}] = counts(light.figures);
        }
        return found;
    }
    ErrorsByRow judge(const bench::SweepRow& row) { return judge(std::vector<bench::SweepRow>{row}); }

    static bench::SweepRow row_named(const std::string& name, const std::vector<std::string>& more = {}) {
        for (bench::SweepRow row : gated_rows())
            if (row.name == name) {
                row.settings.insert(row.settings.end(), more.begin(), more.end());
                return row;
            }
        ADD_FAILURE() << name;
        return {};
    }
    /// Returns the recorded errors of the row `name`.
    static ErrorsByRow recorded(const std::string& name) {
        ErrorsByRow rows = test::read_errors(record_file()).rows;
        std::erase_if(rows, [&](const auto& row) { return row.first.second != name; });
        return rows;
    }

    std::unique_ptr<bench::Stage> stage_;
    bench::TracedTruths truths_;

private:
    static ErrorCounts counts(const bench::RowFigures& figures) {
        const double scored = figures.scored_px.value_or(0.0);
        const auto pixels = [&](const bench::Figure& share) {
            return static_cast<std::size_t>(std::llround(share.value_or(0.0) * scored));
        };
        return {static_cast<std::size_t>(scored), pixels(figures.wrong), pixels(figures.acne), pixels(figures.leak)};
    }
};

class ErrorGateControls : public ErrorGate {};

TEST_F(ErrorGate, NoRowGetsMorePixelsWrongThanWereRecorded) {
    ASSERT_TRUE(open_stage());
    if (!counts_as_recorded()) GTEST_SKIP() << device() << " is not llvmpipe, of which the counts are";
    const ErrorsByRow found = judge(gated_rows());
    const char* const how = "GNOMON_RECORD_ERRORS=1 gl_truth --gtest_filter='ErrorGate.*' records them anew";
    if (std::getenv("GNOMON_RECORD_ERRORS") != nullptr)
        test::write_errors(record_file(), {device(), found},
                           "How many pixels of each light the rows of a small sweep get wrong\n"
                           "# (tests/gl/error_gate_gl_test.cpp); none may rise.");
    const test::RecordedErrors before = test::read_errors(record_file());
    for (const std::string& line : test::what_rose(before.rows, found)) ADD_FAILURE() << line;
    if (HasFailure())
        std::printf("recorded on %s; this is %s. If that, or a better truth, is the reason: %s\n",
                    before.device.c_str(), device().c_str(), how);
    const std::vector<std::string> fell = test::what_fell(before.rows, found);
    for (const std::string& line : fell) std::printf("better: %s\n", line.c_str());
    if (!fell.empty()) std::printf("%zu counts fell, and should stay there: %s\n", fell.size(), how);
}

TEST_F(ErrorGateControls, EveryCountIsTheSameAgainInAnotherOrder) {
    ASSERT_TRUE(open_stage());
    std::vector<bench::SweepRow> rows = {row_named("hard"), row_named("pcf_grid_3"), row_named("defaults")};
    const ErrorsByRow found = judge(rows);
    std::reverse(rows.begin(), rows.end());
    EXPECT_EQ(judge(rows), found);
}

TEST_F(ErrorGateControls, IsShutByABiasOfNothingAndByOneTooLarge) {
    ASSERT_TRUE(open_stage());
    if (!counts_as_recorded()) GTEST_SKIP() << device() << " is not llvmpipe, of which the counts are";
    EXPECT_THAT(test::what_rose(recorded("hard"), judge(row_named("hard"))), IsEmpty());
    for (const char* light : {"sun", "lantern", "guard_lamp"}) {
        EXPECT_THAT(test::what_rose(recorded("hard"), judge(row_named("hard", {"bias=0"}))),
                    Contains(HasSubstr(std::string(light) + ", \"hard\": acne")));
        EXPECT_THAT(test::what_rose(recorded("hard"), judge(row_named("hard", {"bias=0.3"}))),
                    Contains(HasSubstr(std::string(light) + ", \"hard\": leak")));
    }
}

TEST_F(ErrorGateControls, IsShutByACasterLess) {
    ASSERT_TRUE(open_stage());
    if (!counts_as_recorded()) GTEST_SKIP() << device() << " is not llvmpipe, of which the counts are";
    ecs::Registry& world = stage_->world();
    const auto with = world.entities_with<ShadowCaster>();
    const std::vector<ecs::Entity> casters(with.begin(), with.end());
    std::size_t shut = 0;
    for (std::size_t i = 0; i < casters.size(); i += casters.size() / 4) {
        const ShadowCaster caster = *world.get<ShadowCaster>(casters[i]);
        world.remove<ShadowCaster>(casters[i]);
        shut += !test::what_rose(recorded("defaults"), judge(row_named("defaults"))).empty();
        world.emplace<ShadowCaster>(casters[i], caster);
    }
    EXPECT_GE(shut, 2u) << "of four casters taken away one by one";
}

TEST(RecordedErrors, SayWhatRoseWhatFellAndWhatCannotBeCompared) {
    const ErrorsByRow before = {{{"sun", "hard"}, {100, 7, 2, 1}}, {{"sun", "a row, of words"}, {100, 5, 0, 0}}};
    EXPECT_THAT(test::what_rose(before, before), IsEmpty());
    EXPECT_THAT(test::what_fell(before, before), IsEmpty());
    ErrorsByRow found = before;
    found[{"sun", "hard"}] = {100, 8, 1, 1};
    EXPECT_THAT(test::what_rose(before, found), ElementsAre("sun, \"hard\": wrong 7 -> 8 px"));
    EXPECT_THAT(test::what_fell(before, found), ElementsAre("sun, \"hard\": acne 2 -> 1 px"));
    found[{"sun", "hard"}] = {99, 7, 2, 2};
    EXPECT_THAT(test::what_rose(before, found), SizeIs(2));
    found.erase({"sun", "hard"});
    EXPECT_THAT(test::what_rose(before, found), ElementsAre("sun, \"hard\": is missing"));
    EXPECT_THAT(test::what_rose({}, found), ElementsAre("sun, \"a row, of words\": was never recorded"));

    const OwnFolder folder;
    const auto file = folder.path() / "errors";
    test::write_errors(file, {"a device", before}, "errors");
    const test::RecordedErrors read = test::read_errors(file);
    std::filesystem::remove(file);
    EXPECT_EQ(read.device, "a device");
    EXPECT_EQ(read.rows, before);
    EXPECT_THAT(test::read_errors(file).rows, IsEmpty());
}

}  // namespace
}  // namespace gnomon
