#include "bench/text/replace_doc_section.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/own_folder.h"

namespace gnomon::bench {
namespace {

class MarkedText : public ::testing::Test {
protected:
    void write(const std::string& text) const { std::ofstream(page_, std::ios::binary) << text; }
    std::string read() const {
        std::ifstream file(page_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    OwnFolder folder_;
    std::filesystem::path page_ = folder_.path() / "page.md";
};

TEST_F(MarkedText, OnlyWhatStandsBetweenTheMarksIsReplaced) {
    write("before\n<!-- rows -->\nold\nolder\n<!-- end of rows -->\nafter\n");
    EXPECT_FALSE(replace_marked(page_, "rows", "new\n"));
    EXPECT_EQ(read(), "before\n<!-- rows -->\nnew\n<!-- end of rows -->\nafter\n");
    EXPECT_FALSE(replace_marked(page_, "rows", "newer\n"));
    EXPECT_EQ(read(), "before\n<!-- rows -->\nnewer\n<!-- end of rows -->\nafter\n");
}

TEST_F(MarkedText, APageWithoutBothMarksInOrderStaysAsItIs) {
    for (const std::string text : {"nothing\n", "<!-- rows -->\n", "<!-- end of rows -->\n<!-- rows -->\n",
                                   "<!-- other -->\n<!-- end of other -->\n"}) {
        write(text);
        const auto error = replace_marked(page_, "rows", "new\n");
        ASSERT_TRUE(error) << text;
        EXPECT_EQ(error->rule, "page.marks");
        EXPECT_EQ(read(), text);
    }
}

TEST_F(MarkedText, APageThatIsNotThereIsNotMade) {
    const auto error = replace_marked(page_, "rows", "new\n");
    ASSERT_TRUE(error);
    EXPECT_EQ(error->rule, "page.read");
    EXPECT_FALSE(std::filesystem::exists(page_));
}

}  // namespace
}  // namespace gnomon::bench
