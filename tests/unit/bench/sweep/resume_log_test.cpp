#include "bench/sweep/resume_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "bench/sweep/sweep_json.h"
#include "tests/own_folder.h"

namespace gnomon::bench {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kHeader = R"({"journal":1,"scene":"a"})";

class SweepJournalTest : public ::testing::Test {
protected:
    SweepJournal open(const std::string& header = kHeader) const {
        auto journal = SweepJournal::open(file_, header);
        if (!journal) throw std::runtime_error(to_line(journal.error()));
        return std::move(journal).value();
    }
    std::string read() const {
        std::ifstream in(file_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

    /// Makes a row with every figure, each with a different value.
    static JudgedRow full_row(const std::string& name) {
        JudgedRow row{name, std::nullopt, {}};
        LightRow& light = row.lights.emplace_back();
        light.light = "a \"light\"";
        light.kind = LightKind::spot;
        light.state = "rendered";
        light.reason = "filter_cut";
        double value = 0.125;
        for (const FigureColumn& column : figure_columns()) column.set(light.figures, value += 1.0);
        return row;
    }

    OwnFolder folder_;
    std::filesystem::path file_ = folder_.path() / "journal.jsonl";
};

TEST_F(SweepJournalTest, WhatWasFoundIsThereAgainToTheLastFigure) {
    {
        SweepJournal journal = open();
        EXPECT_FALSE(journal.add(full_row("a"), 2.0));
        EXPECT_FALSE(journal.add(JudgedRow{"b", "cannot", {}}, 1.0));
        EXPECT_FALSE(journal.add(TimedRow{"a", 1, {{10.0, std::nullopt, 0.1}}, {{20.0, 5.0, 0.2}}}, 0.5));
    }
    const SweepJournal again = open();
    ASSERT_THAT(again.judged(), SizeIs(2));
    EXPECT_EQ(to_json(again.judged()[0].lights.at(0)), to_json(full_row("a").lights[0]));
    EXPECT_EQ(again.judged()[1].error, "cannot");
    ASSERT_THAT(again.timed(), SizeIs(1));
    EXPECT_EQ(again.timed()[0].round, 1u);
    EXPECT_EQ(again.timed()[0].times.at(0).drawn_us, 10.0);
    EXPECT_EQ(again.timed()[0].times.at(0).kept_us, std::nullopt);
    EXPECT_EQ(again.timed()[0].base.at(0).kept_us, 5.0);
    EXPECT_DOUBLE_EQ(again.spent_s(), 3.5);
    EXPECT_DOUBLE_EQ(again.timed_s(), 0.5) << "that rows took to be judged is no time of a round";
}

TEST_F(SweepJournalTest, ALineThatWasCutShortCountsAsNotWrittenAndIsWrittenAnew) {
    EXPECT_FALSE(open().add(full_row("a"), 2.0));
    const std::string whole = read();
    EXPECT_FALSE(open().add(full_row("b"), 2.0));
    const std::string both = read();
    for (const std::size_t cut : {both.size() - 1, whole.size() + 1, whole.size() + 40}) {
        write(both.substr(0, cut));
        SweepJournal journal = open();
        ASSERT_THAT(journal.judged(), SizeIs(1)) << cut;
        EXPECT_FALSE(journal.add(full_row("b"), 2.0));
        EXPECT_EQ(read(), both) << cut;
    }
}

TEST_F(SweepJournalTest, AnotherHeaderBeginsAnew) {
    EXPECT_FALSE(open().add(full_row("a"), 2.0));
    EXPECT_THAT(open(R"({"journal":1,"scene":"b"})").judged(), IsEmpty());
    EXPECT_EQ(read(), "{\"journal\":1,\"scene\":\"b\"}\n");
}

TEST_F(SweepJournalTest, WhatIsNoFindingEndsIt) {
    for (const std::string line : {"garbage", "{}", "[]", R"({"row":1,"s":2})", R"({"row":"a","s":"x","lights":[]})"}) {
        write(std::string(kHeader) + "\n" + line + "\n");
        EXPECT_THAT(open().judged(), IsEmpty()) << line;
    }
}

TEST_F(SweepJournalTest, AFolderThatIsNotThereIsAnError) {
    const auto journal = SweepJournal::open(file_ / "no" / "folder", kHeader);
    ASSERT_FALSE(journal);
    EXPECT_EQ(journal.error().rule, "output.write");
}

}  // namespace
}  // namespace gnomon::bench
