#include "bench/text/wrap_lines.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

TEST(WrapLines, LeavesWhatFits) {
    for (const char* text : {"", "\n", "abc def", "abc def\n", "a\n\nb\n", "  indented\n"})
        EXPECT_EQ(wrapped(text, 10), text);
}

TEST(WrapLines, BreaksAtTheLastBlankThatFits) {
    EXPECT_EQ(wrapped("abc def ghi", 7), "abc def\nghi");
    EXPECT_EQ(wrapped("abc def ghi", 8), "abc def\nghi");
    EXPECT_EQ(wrapped("abc def ghi", 6), "abc\ndef\nghi");
    EXPECT_EQ(wrapped("abc def ghi\njkl mno pqr\n", 7), "abc def\nghi\njkl mno\npqr\n");
}

TEST(WrapLines, KeepsWordsThatAreTooLong) {
    EXPECT_EQ(wrapped("abcdefgh", 4), "abcdefgh");
    EXPECT_EQ(wrapped("abcdefgh ij", 4), "abcdefgh\nij");
}

TEST(WrapLines, CountsCharactersNotBytes) {
    EXPECT_EQ(wrapped("äöü äöü", 7), "äöü äöü");
    EXPECT_EQ(wrapped("äöü äöü", 6), "äöü\näöü");
}

}  // namespace
}  // namespace gnomon::bench
