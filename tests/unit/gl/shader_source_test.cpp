#include "engine/gl/shader_source.h"

#include <gmock/gmock.h>

#include <array>

namespace gnomon::gl {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::array kFiles = {
    ShaderFile{"plain.glsl", "void main() {}\n"},
    ShaderFile{"top.glsl", "first;\n#include \"lib/a.glsl\"\n  #  include \"lib/b.glsl\" // why\nlast;\n"},
    ShaderFile{"lib/a.glsl", "in_a;\n#include \"lib/b.glsl\"\n"},
    ShaderFile{"lib/b.glsl", "in_b;"},
    ShaderFile{"loop.glsl", "#include \"loop2.glsl\"\n"},
    ShaderFile{"loop2.glsl", "x;\n#include \"loop.glsl\"\n"},
    ShaderFile{"self.glsl", "#include \"self.glsl\"\n"},
    ShaderFile{"broken.glsl", "a;\nb;\n#include \"no/such.glsl\"\n"},
    ShaderFile{"comment.glsl", "// #include \"no/such.glsl\"\n#include <no/such.glsl>\n#included \"no\"\nend;\n"},
    ShaderFile{"empty.glsl", ""},
    ShaderFile{"chosen.glsl", "#include PART\nend;\n"},
};

Result<std::string> expand(std::string_view path, std::vector<std::string> defines = {}) {
    return expand_shader(kFiles, path, defines);
}

TEST(ShaderSource, VersionComesFirstThenDefinesThenTheFile) {
    const auto text = expand("plain.glsl", {"TAPS 9", "SUN"});
    ASSERT_TRUE(text);
    EXPECT_EQ(text.value(),
              "#version 450 core\n#define TAPS 9\n#define SUN\n#line 1 0  // plain.glsl\nvoid main() {}\n");
}

TEST(ShaderSource, IncludesAreReplacedOnceAndLinesStayTrue) {
    const auto text = expand("top.glsl");
    ASSERT_TRUE(text);
    EXPECT_EQ(text.value(),
              "#version 450 core\n"
              "#line 1 1  // top.glsl\n"
              "first;\n"
              "#line 1 2  // lib/a.glsl\n"
              "in_a;\n"
              "#line 1 3  // lib/b.glsl\n"
              "in_b;\n"
              "#line 3 2  // lib/a.glsl\n"
              "#line 3 1  // top.glsl\n"
              "#line 4 1  // top.glsl\n"
              "last;\n");
}

TEST(ShaderSource, ADefineNamesTheFileToInclude) {
    const auto text = expand("chosen.glsl", {"PART_OF 1", "PART \"lib/b.glsl\""});
    ASSERT_TRUE(text);
    EXPECT_EQ(text.value(),
              "#version 450 core\n"
              "#define PART_OF 1\n"
              "#line 1 10  // chosen.glsl\n"
              "#line 1 3  // lib/b.glsl\n"
              "in_b;\n"
              "#line 2 10  // chosen.glsl\n"
              "end;\n");
    for (const std::vector<std::string>& without :
         {std::vector<std::string>{}, {"PART 1"}, {"PART_OF \"lib/b.glsl\""}}) {
        const auto missing = expand("chosen.glsl", without);
        ASSERT_FALSE(missing);
        EXPECT_EQ(missing.error().rule, "shader.missing");
        EXPECT_THAT(missing.error().message, HasSubstr("\"PART\""));
    }
}

TEST(ShaderSource, AnEmptyFileExpandsToItsHeaderOnly) {
    const auto text = expand("empty.glsl");
    ASSERT_TRUE(text);
    EXPECT_EQ(text.value(), "#version 450 core\n#line 1 9  // empty.glsl\n");
}

TEST(ShaderSource, OnlyIncludeDirectivesInQuotesAreTaken) {
    const auto text = expand("comment.glsl");
    ASSERT_TRUE(text);
    EXPECT_THAT(text.value(), StartsWith("#version 450 core\n"));
    EXPECT_THAT(text.value(),
                HasSubstr("// #include \"no/such.glsl\"\n#include <no/such.glsl>\n#included \"no\"\nend;"));
}

TEST(ShaderSource, AMissingFileIsAnErrorThatSaysWhereItIsWanted) {
    const auto text = expand("broken.glsl");
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().rule, "shader.missing");
    EXPECT_EQ(text.error().file, "broken.glsl");
    EXPECT_THAT(text.error().message, HasSubstr("no/such.glsl"));
    EXPECT_THAT(text.error().message, HasSubstr("line 3"));
    EXPECT_EQ(expand("nothing.glsl").error().rule, "shader.missing");
}

TEST(ShaderSource, CyclesAreErrors) {
    for (const char* path : {"loop.glsl", "loop2.glsl", "self.glsl"}) {
        const auto text = expand(path);
        ASSERT_FALSE(text) << path;
        EXPECT_EQ(text.error().rule, "shader.cycle") << path;
    }
}

TEST(ShaderSource, LogsNameFilesInThePlaceOfTheirNumbers) {
    EXPECT_EQ(with_paths("2(13) : error C5121: bad 3\n1:7(2): error: x\nERROR: 0:4: y\n", kFiles),
              "lib/a.glsl(13) : error C5121: bad 3\ntop.glsl:7(2): error: x\nERROR: plain.glsl:4: y\n");
    EXPECT_EQ(with_paths("surface (fragment): 3:7(1): z\n99:1(2): of no file\n2 apples, 3:4\n", kFiles),
              "surface (fragment): lib/b.glsl:7(1): z\n99:1(2): of no file\n2 apples, 3:4\n");
    EXPECT_EQ(with_paths("", kFiles), "");
}

TEST(ShaderSource, TwoIncludesOfOneFileAreNoCycle) { EXPECT_TRUE(expand("top.glsl")); }

}  // namespace
}  // namespace gnomon::gl
