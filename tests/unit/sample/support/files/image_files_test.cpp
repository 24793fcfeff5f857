#include "sample_game/support/files/image_files.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "engine/image/encode_image.h"
#include "tests/own_folder.h"

namespace gnomon::game {
namespace {

namespace fs = std::filesystem;

class PictureFiles : public ::testing::Test {
protected:
    std::string content(const fs::path& file) const {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    OwnFolder own_;
    const fs::path& folder_ = own_.path();
};

TEST_F(PictureFiles, PfmIsAHeaderAndLittleEndianFloatsBottomRowFirst) {
    const float values[] = {1.0f, -1.0f, 0.25f, 0.0f, 0.5f, 1.0f};
    ASSERT_FALSE(write_pfm(folder_ / "a.pfm", 2, 3, values));
    const std::string header = "Pf\n2 3\n-1.0\n";
    const std::string text = content(folder_ / "a.pfm");
    ASSERT_EQ(text.size(), header.size() + sizeof values);
    EXPECT_EQ(text.substr(0, header.size()), header);
    EXPECT_EQ(text.substr(header.size(), 4), std::string("\x00\x00\x80\x3f", 4));
    EXPECT_TRUE(write_pfm(folder_ / "b.pfm", 2, 2, values)) << "sizes that disagree must be refused";
}

TEST_F(PictureFiles, PfmIsReadAsItWasWrittenAndRefusedOtherwise) {
    const std::vector<float> values{1.0f, -1.0f, 0.25f, 0.0f, 0.5f, 1.0f};
    ASSERT_FALSE(write_pfm(folder_ / "a.pfm", 2, 3, values));
    const auto read = read_pfm(folder_ / "a.pfm");
    ASSERT_TRUE(read) << to_line(read.error());
    EXPECT_EQ(read.value().size_px, glm::uvec2(2, 3));
    EXPECT_EQ(read.value().values, values);

    const std::string whole = content(folder_ / "a.pfm");
    const std::string spoiled[] = {"",
                                   "PF" + whole.substr(2),                        // colours
                                   "Pf\n2 3\n1.0\n" + whole.substr(12),          // big-endian
                                   "Pf\n4294967295 4294967295\n-1.0\n",          // more than there is
                                   "Pf\n0 0\n-1.0\n", whole.substr(0, whole.size() - 1), whole + "x"};
    for (const std::string& text : spoiled) {
        std::ofstream(folder_ / "b.pfm", std::ios::binary) << text;
        const auto refused = read_pfm(folder_ / "b.pfm");
        ASSERT_FALSE(refused) << text.substr(0, 20);
        EXPECT_EQ(refused.error().rule, "input.read");
        EXPECT_THAT(refused.error().file, ::testing::HasSubstr("b.pfm"));
    }
    EXPECT_FALSE(read_pfm(folder_ / "none.pfm"));
}

TEST_F(PictureFiles, PngStartsWithItsSignatureAndSize) {
    const std::vector<std::uint8_t> rgba(std::size_t{3} * 2 * 4, 200);
    const auto png = encode_png(3, 2, rgba);
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(png[1], 'P');
    EXPECT_EQ(png[19], 3);
    EXPECT_EQ(png[23], 2);
    EXPECT_TRUE(encode_png(0, 2, {}).empty());
    EXPECT_TRUE(encode_png(4, 2, rgba).empty());
}

TEST_F(PictureFiles, JpegStartsAndEndsWithItsMarkersAndIsSmallerThanPngOfNoise) {
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t i = 0, noise = 1; i < 64 * 64 * 4; ++i, noise = noise * 1664525u + 1013904223u)
        rgba.push_back(static_cast<std::uint8_t>(noise >> 24));
    const auto jpeg = encode_jpeg(64, 64, rgba, 85);
    ASSERT_GT(jpeg.size(), 4u);
    EXPECT_EQ((std::vector(jpeg.begin(), jpeg.begin() + 2)), (std::vector<std::uint8_t>{0xff, 0xd8}));
    EXPECT_EQ((std::vector(jpeg.end() - 2, jpeg.end())), (std::vector<std::uint8_t>{0xff, 0xd9}));
    EXPECT_LT(jpeg.size(), encode_png(64, 64, rgba).size());
    EXPECT_TRUE(encode_jpeg(0, 2, {}, 85).empty());
    EXPECT_TRUE(encode_jpeg(65, 64, rgba, 85).empty());
}

TEST_F(PictureFiles, CheckingChangesNothing) {
    EXPECT_FALSE(check_writable(folder_ / "new"));
    EXPECT_FALSE(fs::exists(folder_ / "new"));
    std::ofstream(folder_ / "old") << "kept";
    EXPECT_FALSE(check_writable(folder_ / "old"));
    EXPECT_EQ(content(folder_ / "old"), "kept");
}

TEST_F(PictureFiles, WhatCannotBeWrittenIsAnErrorThatNamesTheFile) {
    const auto missing = check_writable(folder_ / "no" / "file");
    ASSERT_TRUE(missing);
    EXPECT_EQ(missing->rule, "output.write");
    EXPECT_THAT(missing->file, ::testing::HasSubstr("no"));
    EXPECT_TRUE(check_writable(folder_));
    std::ofstream(folder_ / "plain") << "x";
    EXPECT_TRUE(make_writable_folder(folder_ / "plain"));
    EXPECT_TRUE(make_writable_folder(folder_ / "plain" / "below"));
    EXPECT_FALSE(make_writable_folder(folder_ / "deep" / "er"));
    EXPECT_TRUE(fs::is_directory(folder_ / "deep" / "er"));
    EXPECT_TRUE(fs::is_empty(folder_ / "deep" / "er"));
}

}  // namespace
}  // namespace gnomon::game
