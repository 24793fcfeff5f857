// Rules about what lies outside the bytes of one file: memory, other files, images that can be left out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/assets/gltf_limits.h"
#include "tests/long_run.h"
#include "tests/own_folder.h"
#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
namespace limits = assets::gltf;

TEST(BadResource, AnImageWithoutASourceIsLeftOutWithAWarning) {
    GltfBuilder builder = triangle();
    builder.push("images", json::object());
    builder.push("textures", {{"source", 0}});
    builder.push("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.doc["meshes"][0]["primitives"][0]["material"] = 0;
    const auto result = load(builder.gltf());
    ASSERT_TRUE(result) << to_line(result.error());
    EXPECT_THAT(result.value().warnings, testing::Contains(testing::AllOf(testing::HasSubstr("image.no_source"),
                                                                          testing::HasSubstr("/images/0"))));
    EXPECT_THAT(result.value().textures, testing::IsEmpty());
}

TEST(BadResource, BuffersThatAreTooLargeTogetherAreRefused) {
    const OwnFolder own;
    const fs::path& folder = own.path();
    std::ofstream(folder / "zeros.bin").close();
    fs::resize_file(folder / "zeros.bin", limits::kMaxFileBytes);  // sparse: takes no room
    GltfBuilder builder = triangle();
    const json buffer = {{"byteLength", 4}, {"uri", "zeros.bin"}};
    builder.doc["buffers"] = json::array({buffer, buffer, buffer});
    const std::string text = builder.doc.dump();
    const auto result = assets::load_gltf_memory(bytes_of(text), folder, "large.gltf");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().rule, "buffer.total_bytes") << to_line(result.error());
    EXPECT_EQ(result.error().pointer, "/buffers/2/uri");
}

TEST(BadResource, AFileThatEndsBeforeItsSizeIsRefused) {
    const fs::path shorter = "/sys/kernel/mm/transparent_hugepage/enabled";  // size 4096 bytes, content some twenty
    if (!fs::exists(shorter)) GTEST_SKIP() << "no " << shorter;
    const auto result = assets::load_gltf(shorter);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().rule, "file.unreadable") << to_line(result.error());
    EXPECT_EQ(result.error().file, shorter.string());
}

/// Exits with 0 if the loader reports that memory is exhausted, with hardly any left.
[[noreturn]] void load_without_memory(const Bytes& file) {
    constexpr rlim_t kRoom = 64 * limits::kMiB;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    constexpr std::size_t kPage = 4096;
    const rlimit limit{pages * kPage + kRoom, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &limit);
    const auto result = load(file, "large.glb");
    std::exit(!result && result.error().rule == "memory.exhausted" ? EXIT_SUCCESS : EXIT_FAILURE);
}

TEST(BadResourceDeathTest, ASceneLargerThanTheMemoryEndsInItsError) {
    if (kSanitized) GTEST_SKIP() << "the sanitizer's allocator ends the process where memory runs out";
    GltfBuilder builder = triangle();
    const std::vector<float> zeros(3 * 8'000'000);
    builder.doc["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = builder.add_accessor(zeros, "VEC3");
    const Bytes file = builder.glb();
    EXPECT_EXIT(load_without_memory(file), testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace
}  // namespace gnomon::test
