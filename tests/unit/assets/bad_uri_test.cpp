// What a file may name on disk: tested with real files and links in a folder of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/own_folder.h"
#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

class BadUri : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(root_ / "asset/parts");
        builder_ = triangle();
        write(root_ / "asset/mesh.bin", builder_.binary);
        write(root_ / "asset/parts/my mesh.bin", builder_.binary);
        write(root_ / "secret.bin", builder_.binary);
    }

    static void write(const fs::path& file, const Bytes& bytes) {
        std::ofstream stream(file, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

    Result<assets::SceneData> load_with_uri(const std::string& uri) {
        builder_.doc["buffers"] = json::array({{{"byteLength", builder_.binary.size()}, {"uri", uri}}});
        write(root_ / "asset/scene.gltf", builder_.gltf());
        return assets::load_gltf(root_ / "asset/scene.gltf");
    }

    std::string rule_of(const std::string& uri) {
        const auto result = load_with_uri(uri);
        if (result) return "loaded";
        EXPECT_EQ(result.error().pointer, "/buffers/0/uri") << uri;
        EXPECT_EQ(to_line(result.error()).find('\n'), std::string::npos) << uri;
        return result.error().rule;
    }

    OwnFolder own_;
    const fs::path& root_ = own_.path();
    GltfBuilder builder_;
};

TEST_F(BadUri, GoodNamesAreFoundBesideTheAssetAndBelowIt) {
    EXPECT_EQ(rule_of("mesh.bin"), "loaded");
    EXPECT_EQ(rule_of("./mesh.bin"), "loaded");
    EXPECT_EQ(rule_of("parts/my%20mesh.bin"), "loaded");
    EXPECT_EQ(rule_of("parts/my mesh.bin"), "loaded");
    fs::create_symlink(root_ / "asset/mesh.bin", root_ / "asset/inside.bin");
    EXPECT_EQ(rule_of("inside.bin"), "loaded") << "a link that stays inside";
}

TEST_F(BadUri, PathsOutOfTheFolderAreRefused) {
    EXPECT_EQ(rule_of("../secret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("%2e%2e/secret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("..%2Fsecret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("parts/../../secret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("parts/../%2e%2e/secret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("parts\\..\\..\\secret.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("mesh.bin/../../secret.bin?v=1"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("nowhere/../../asset/mesh.bin"), "uri.escapes_folder") << "it may not even be left and entered";
    EXPECT_EQ(rule_of("..\\secret.bin"), "uri.escapes_folder");
}

TEST_F(BadUri, NamesThatOtherReadersFindAreFoundWithAWarning) {
    write(root_ / "asset/example 10%.bin", builder_.binary);
    write(root_ / "asset/big%20mesh.bin", builder_.binary);
    struct Row {
        const char* uri;
        const char* rule;
    };
    const Row rows[] = {{"example 10%.bin", "uri.percent"},      {"big%20mesh.bin", "uri.escaped_name"},
                        {"mesh.bin?v=3", "uri.query"},           {"mesh.bin#part", "uri.query"},
                        {"parts\\my mesh.bin", "uri.backslash"}, {"parts\\..\\mesh.bin", "uri.backslash"},
                        {"./parts/../mesh.bin", nullptr},        {"no such folder/../mesh.bin", nullptr}};
    for (const Row& row : rows) {
        const auto result = load_with_uri(row.uri);
        ASSERT_TRUE(result) << row.uri << ": " << to_line(result.error());
        EXPECT_EQ(result.value().meshes.size(), 1U);
        if (row.rule == nullptr)
            EXPECT_THAT(result.value().warnings, testing::IsEmpty()) << row.uri;
        else
            EXPECT_THAT(result.value().warnings,
                        testing::ElementsAre(testing::AllOf(testing::StartsWith("/buffers/0/uri: "),
                                                            testing::HasSubstr("[" + std::string(row.rule) + "]"))))
                << row.uri;
    }
    write(root_ / "asset/mesh.bin?v=3", {});
    const auto named = load_with_uri("mesh.bin?v=3");
    ASSERT_FALSE(named) << "what the letter names comes first";
    EXPECT_EQ(named.error().rule, "buffer.too_short");
}

TEST_F(BadUri, LinksOutOfTheFolderAreRefused) {
    fs::create_symlink(root_ / "secret.bin", root_ / "asset/link.bin");
    fs::create_directory_symlink(root_, root_ / "asset/up");
    EXPECT_EQ(rule_of("link.bin"), "uri.escapes_folder");
    EXPECT_EQ(rule_of("up/secret.bin"), "uri.escapes_folder");
}

TEST_F(BadUri, AFolderWithTheSameBeginningIsOutside) {
    fs::create_directories(root_ / "asset2");
    write(root_ / "asset2/mesh.bin", builder_.binary);
    fs::create_symlink(root_ / "asset2/mesh.bin", root_ / "asset/near.bin");
    EXPECT_EQ(rule_of("near.bin"), "uri.escapes_folder");
}

TEST_F(BadUri, AbsolutePathsAndSchemesAreRefused) {
    EXPECT_EQ(rule_of((root_ / "asset/mesh.bin").string()), "uri.absolute");
    EXPECT_EQ(rule_of("\\\\host\\mesh.bin"), "uri.absolute");
    EXPECT_EQ(rule_of("file:mesh.bin"), "uri.scheme");
    EXPECT_EQ(rule_of("http://example.com/mesh.bin"), "uri.scheme");
    EXPECT_EQ(rule_of("C:/mesh.bin"), "uri.scheme");
}

TEST_F(BadUri, BrokenTextIsRefused) {
    EXPECT_EQ(rule_of(""), "uri.empty");
    EXPECT_EQ(rule_of("mesh%2"), "uri.not_found");
    EXPECT_EQ(rule_of("?v=3"), "uri.not_found");
    EXPECT_EQ(rule_of("mesh.bin%00.png"), "uri.control_character");
    EXPECT_EQ(rule_of("mesh\n.bin"), "uri.control_character");
}

TEST_F(BadUri, WhatIsNoFileIsRefused) {
    EXPECT_EQ(rule_of("missing.bin"), "uri.not_found");
    EXPECT_EQ(rule_of("parts"), "file.not_regular");
    ASSERT_EQ(mkfifo((root_ / "asset/pipe.bin").c_str(), 0600), 0);
    EXPECT_EQ(rule_of("pipe.bin"), "file.not_regular") << "must not wait for a writer";
}

TEST_F(BadUri, AFileBeyondTheLimitIsRefusedUnread) {
    write(root_ / "asset/huge.bin", {});
    fs::resize_file(root_ / "asset/huge.bin", std::uintmax_t{1} << 36);  // sparse: takes no room
    EXPECT_EQ(rule_of("huge.bin"), "file.too_large");
}

TEST_F(BadUri, BrokenDataUrisAreRefused) {
    EXPECT_EQ(rule_of("data:application/octet-stream"), "uri.data");
    EXPECT_EQ(rule_of("data:;base64,AA*A"), "uri.base64");
    EXPECT_EQ(rule_of("data:;base64,AAAAA"), "uri.base64");
    EXPECT_EQ(rule_of("data:,%4"), "uri.percent");
}

TEST_F(BadUri, DataUrisWithoutBase64AreRead) {
    std::string uri = "data:application/octet-stream,";
    for (const std::byte b : builder_.binary) {
        constexpr char kDigits[] = "0123456789abcdef";
        uri += {'%', kDigits[std::to_integer<int>(b) >> 4], kDigits[std::to_integer<int>(b) & 15]};
    }
    EXPECT_EQ(rule_of(uri), "loaded");
}

TEST_F(BadUri, ASceneFromMemoryCannotNameFiles) {
    builder_.doc["buffers"] = json::array({{{"byteLength", builder_.binary.size()}, {"uri", "mesh.bin"}}});
    const auto result = load(builder_.gltf());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().rule, "uri.no_base_folder");
    EXPECT_TRUE(assets::load_gltf_memory(builder_.gltf(), root_ / "asset", "scene.gltf"));
}

TEST_F(BadUri, TheMainFileItselfMustBeARegularFile) {
    const auto missing = assets::load_gltf(root_ / "none.gltf");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().rule, "file.not_found");
    EXPECT_EQ(missing.error().file, (root_ / "none.gltf").string());
    const auto folder = assets::load_gltf(root_ / "asset");
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().rule, "file.not_regular");
    const auto endless = assets::load_gltf("/dev/zero");
    ASSERT_FALSE(endless);
    EXPECT_EQ(endless.error().rule, "file.not_regular");
}

}  // namespace
}  // namespace gnomon::test
