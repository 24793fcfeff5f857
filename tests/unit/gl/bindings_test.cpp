#include "shaders/bindings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "engine/gl/commands.h"
#include "shaders/embedded.h"
#include "tests/source_paths.h"

/// Numbers of blocks, buffers, texture units and attributes stand in one table, for C++ and shaders alike.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

static_assert(bindings::kPositionAttribute == gl::kPositionAttribute);
static_assert(bindings::kNormalAttribute == gl::kNormalAttribute);
static_assert(bindings::kUvAttribute == gl::kUvAttribute);
static_assert(bindings::kDrawItemAttribute == gl::kDrawItemAttribute);

constexpr std::string_view kTable = "common/bindings.glsl";

/// Returns the pieces of a text that a pattern finds.
std::vector<std::string> found(const std::string& text, const char* pattern) {
    const std::regex expression(pattern);
    return {std::sregex_token_iterator(text.begin(), text.end(), expression), {}};
}

/// Returns the bindings that a shader gives by a number, and the inputs of a vertex shader.
std::vector<std::string> spelt_in_shader(const std::string& text, bool vertex) {
    std::vector<std::string> spelt = found(text, "binding\\s*=\\s*[0-9]+");
    if (vertex)
        std::ranges::copy(found(text, "location\\s*=\\s*[0-9]+\\s*\\)\\s*(flat\\s+)?in\\b"), std::back_inserter(spelt));
    return spelt;
}

/// Returns commands that bind something to a number, and constants that name one.
std::vector<std::string> spelt_in_code(const std::string& text) {
    return found(text, "Bind(Uniforms|Storage|Texture|Texels)\\{\\s*[0-9]+|k\\w*(Unit|Binding|Attribute) = [0-9]+");
}

TEST(Bindings, NumbersAreFoundWhereTheyAreSpelt) {
    EXPECT_THAT(
        spelt_in_shader("layout(binding = 4) uniform sampler2D a;\nlayout(std140, binding=0) uniform B {", false),
        ElementsAre("binding = 4", "binding=0"));
    EXPECT_THAT(spelt_in_shader("layout(binding = kLightBlock) uniform B {", false), IsEmpty());
    const std::string stage = "layout(location = 1) in vec3 normal;\nlayout(location = 0) out vec4 colour;";
    EXPECT_THAT(spelt_in_shader(stage, true), ElementsAre("location = 1) in"));
    EXPECT_THAT(spelt_in_shader(stage, false), IsEmpty());
    EXPECT_THAT(
        spelt_in_code(
            "list.add(gl::BindTexture{6, a});\n    gl::BindUniforms{\n        1, b}\nconstexpr int kMapUnit = 4;"),
        ElementsAre("BindTexture{6", "BindUniforms{\n        1", "kMapUnit = 4"));
    EXPECT_THAT(spelt_in_code("list.add(gl::BindTexture{bindings::kShadowMapUnit, a});"), IsEmpty());
}

TEST(Bindings, NoShaderSpellsOne) {
    ASSERT_FALSE(shader_files().empty());
    for (const gl::ShaderFile& file : shader_files()) {
        if (file.path == kTable) continue;
        EXPECT_THAT(spelt_in_shader(std::string(file.text), file.path.ends_with(".vert")), IsEmpty()) << file.path;
    }
}

TEST(Bindings, NoSystemSpellsOne) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_folder() / "systems")) {
        const std::string kind = entry.path().extension().string();
        if (kind != ".cpp" && kind != ".h") continue;
        ++files;
        std::ifstream file(entry.path());
        EXPECT_THAT(spelt_in_code({std::istreambuf_iterator<char>(file), {}}), IsEmpty()) << entry.path();
    }
    EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace gnomon
