#include "engine/gl/program_cache.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "tests/own_folder.h"

/// What the cache gives back is what was kept, for the same sources and driver, or nothing.
namespace gnomon::gl {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::SizeIs;

ProgramCache::Binary binary(const std::string& text, std::uint32_t format = 7) {
    ProgramCache::Binary b{format, {}};
    for (const char c : text) b.bytes.push_back(static_cast<std::byte>(c));
    return b;
}

class ProgramCaches : public ::testing::Test {
protected:
    ProgramCache cache(const std::string& driver = "driver 1") const { return {folder, driver}; }
    std::vector<fs::path> files() const {
        if (!fs::exists(folder)) return {};
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
        return all;
    }
    static std::string text_of(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write(const fs::path& file, const std::string& text) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    }

    OwnFolder own;
    const fs::path &root = own.path(), folder = root / "cache" / "deep";
    const ProgramDesc program{"a", "vertex text", "fragment text"};
};

TEST_F(ProgramCaches, GiveBackWhatWasKept) {
    EXPECT_EQ(cache().find(program), std::nullopt);
    EXPECT_THAT(files(), IsEmpty()) << "looking makes no folder";
    const auto kept = binary(std::string("\0binary\n\xff", 9));
    EXPECT_TRUE(cache().keep(program, kept));
    EXPECT_EQ(cache().find(program), kept);
    ProgramDesc renamed = program;
    renamed.label = "b";
    EXPECT_EQ(cache().find(renamed), kept) << "a label is no source";
    EXPECT_TRUE(cache().keep(program, binary("newer")));
    EXPECT_EQ(cache().find(program), binary("newer"));
    EXPECT_THAT(files(), SizeIs(1)) << "and nothing beside it";
}

TEST_F(ProgramCaches, AreForOneDriver) {
    EXPECT_TRUE(cache().keep(program, binary("one")));
    EXPECT_EQ(cache("driver 2").find(program), std::nullopt);
    EXPECT_EQ(cache("").find(program), std::nullopt);
}

TEST_F(ProgramCaches, TellEverySourceAndItsStageApart) {
    const std::vector<ProgramDesc> others = {
        {"a", "vertex text", "fragment texT"},  {"a", "vertex textf", "ragment text"}, {"a", "fragment text", "vertex text"},
        {"a", "vertex text", ""},               {"a", "vertex text", "", "fragment text"}, {"a", "", "", "", "vertex text"},
        {"a", "vertex text", "fragment text", "g"}};
    EXPECT_TRUE(cache().keep(program, binary("one")));
    for (const ProgramDesc& other : others) {
        EXPECT_EQ(cache().find(other), std::nullopt) << other.vertex << " | " << other.fragment;
        EXPECT_TRUE(cache().keep(other, binary(other.vertex + '|' + other.fragment + '|' + other.geometry)));
    }
    EXPECT_EQ(cache().find(program), binary("one"));
    EXPECT_THAT(files(), SizeIs(others.size() + 1));
}

TEST_F(ProgramCaches, TakeNoFileOfAnotherProgramUnderTheSameName) {
    ASSERT_TRUE(cache().keep(program, binary("one")));
    const fs::path first = files().at(0);
    ProgramDesc other = program;
    other.fragment += '!';
    ASSERT_TRUE(cache().keep(other, binary("two")));
    for (const fs::path& file : files())
        if (file != first) fs::copy_file(first, file, fs::copy_options::overwrite_existing);
    EXPECT_EQ(cache().find(other), std::nullopt) << "as if both had the same hash";
    EXPECT_EQ(cache().find(program), binary("one"));
}

TEST_F(ProgramCaches, TakeNoFileThatWasCutOrGrewOrChangedInAnyBit) {
    ASSERT_TRUE(cache().keep(program, binary("the binary")));
    const fs::path file = files().at(0);
    const std::string whole = text_of(file);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write(file, whole.substr(0, size));
        EXPECT_EQ(cache().find(program), std::nullopt) << size << " bytes of it";
    }
    write(file, whole + '\0');
    EXPECT_EQ(cache().find(program), std::nullopt) << "a byte more";
    for (std::size_t i = 0; i < whole.size() * 8; ++i) {
        std::string changed = whole;
        changed[i / 8] = static_cast<char>(changed[i / 8] ^ (1 << i % 8));
        write(file, changed);
        EXPECT_EQ(cache().find(program), std::nullopt) << "bit " << i;
    }
    write(file, whole);
    EXPECT_EQ(cache().find(program), binary("the binary"));
}

TEST_F(ProgramCaches, TakeNothingThatIsNoFile) {
    ASSERT_TRUE(cache().keep(program, binary("one")));
    const fs::path file = files().at(0);
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_EQ(cache().find(program), std::nullopt);
    EXPECT_FALSE(cache().keep(program, binary("one")));
    EXPECT_THAT(files(), SizeIs(1)) << "what could not be renamed is gone";
}

TEST_F(ProgramCaches, KeepNothingWhereNoFolderCanBe) {
    write(root / "cache", "a file");
    EXPECT_FALSE(cache().keep(program, binary("one")));
    EXPECT_EQ(cache().find(program), std::nullopt);
    EXPECT_EQ(text_of(root / "cache"), "a file");
    const ProgramCache off({}, "driver");
    EXPECT_FALSE(off.is_on());
    EXPECT_FALSE(off.keep(program, binary("one")));
    EXPECT_EQ(off.find(program), std::nullopt);
    EXPECT_FALSE(cache().keep(program, binary(""))) << "an empty binary is none";
}

TEST_F(ProgramCaches, ForgetWhatTheDriverRefused) {
    ASSERT_TRUE(cache().keep(program, binary("one")));
    cache().forget(program);
    EXPECT_EQ(cache().find(program), std::nullopt);
    EXPECT_THAT(files(), IsEmpty());
    cache().forget(program);
}

TEST_F(ProgramCaches, AreSharedByWritersAndReadersWhoSeeWholeFilesAlone) {
    ASSERT_TRUE(cache().keep(program, binary(std::string(5000, 'a'))));
    const auto writes = [&](char c) {
        for (int i = 0; i < 100; ++i) EXPECT_TRUE(cache().keep(program, binary(std::string(5000, c))));
    };
    std::thread a(writes, 'a'), b(writes, 'b');
    for (int i = 0; i < 300; ++i) {
        const auto found = cache().find(program);
        ASSERT_TRUE(found);
        EXPECT_TRUE(*found == binary(std::string(5000, 'a')) || *found == binary(std::string(5000, 'b')));
    }
    a.join();
    b.join();
    EXPECT_THAT(files(), SizeIs(1));
}

}  // namespace
}  // namespace gnomon::gl
