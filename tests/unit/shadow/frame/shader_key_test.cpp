#include "systems/shadow/frame/shader_key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "shaders/embedded.h"
#include "systems/shadow/frame/shared_defines.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/source_paths.h"

/// One place states what a row's shaders are compiled with, and the guide and its example leave nothing of it out.
namespace gnomon::shadow {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using Names = std::set<std::string>;

constexpr const char* kGuide = "docs/contributors/stages.md";

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

Names found(const std::string& text, const char* pattern) {
    const std::regex expression(pattern);
    Names names;
    for (std::sregex_iterator m(text.begin(), text.end(), expression), end; m != end; ++m) names.insert((*m)[1]);
    return names;
}

/// Names alone.
Names names_of(const std::vector<std::string>& defines) {
    Names names;
    for (const std::string& define : defines) names.insert(define.substr(0, define.find(' ')));
    return names;
}

ShaderKey shadowed_row() { return {"LIGHT_SPOT", "shadow/lookup/kinds/spot.glsl", "shadow/filters/pcf/hard.glsl"}; }

/// Returns a row with everything set that may be.
ShaderKey full_row() {
    ShaderKey row = shadowed_row();
    auto& [kind_define, kind_file, filter_file, reach, fades, depths, manual_bias, triangles, sheets, moments, rays,
           masks, footprint, area_shares, tint, whole_source] = row;  // all members: another one does not compile
    for (bool* flag : {&fades, &depths, &manual_bias, &triangles, &sheets, &moments, &rays, &masks, &footprint,
                       &whole_source})
        *flag = true;
    tint = TintLookup::layers;
    area_shares = AreaShares::marked;
    return row;
}

/// Returns the rows' names that lines of C++ spell in quotes.
Names spelt_in(const std::string& code) { return found(code, "\"(SHADOW\\w*|RAY_MASKS)\\b"); }

/// Returns the code of every shader, without comments.
std::string shader_code() {
    std::string code;
    for (const gl::ShaderFile& file : shader_files()) code += std::string(file.text) + "\n";
    return std::regex_replace(code, std::regex("//[^\\n]*"), "");
}

TEST(ShaderKey, EachOfItsFlagsChangesADefineAndNoneComesOrGoes) {
    const std::vector<std::string> least = program_defines(shadowed_row());
    for (bool ShaderKey::*flag : {&ShaderKey::fades, &ShaderKey::depths, &ShaderKey::manual_bias,
                                   &ShaderKey::triangles, &ShaderKey::sheets, &ShaderKey::moments, &ShaderKey::rays,
                                   &ShaderKey::ray_masks, &ShaderKey::footprint, &ShaderKey::whole_source}) {
        ShaderKey row = shadowed_row();
        row.*flag = true;
        EXPECT_NE(program_defines(row), least);
        EXPECT_EQ(names_of(program_defines(row)), names_of(least));
    }
    for (const AreaShares shares : {AreaShares::marked, AreaShares::spread}) {
        ShaderKey row = shadowed_row();
        row.area_shares = shares;
        EXPECT_NE(program_defines(row), least);
        EXPECT_EQ(names_of(program_defines(row)), names_of(least));
    }
    EXPECT_EQ(names_of(program_defines(ShaderKey{"LIGHT_POINT", {}, {}})), names_of(least));
}

TEST(ShaderKey, EachWayToFindTintsIsAFileOfItsOwn) {
    std::set<std::string> files;
    for (const TintLookup tint : {TintLookup::none, TintLookup::layers, TintLookup::rays}) {
        ShaderKey row = shadowed_row();
        row.tint = tint;
        for (const std::string& define : program_defines(row))
            for (const std::string& path : found(define, "SHADOW_TINT \"([^\"]*)\"")) {
                files.insert(path);
                EXPECT_TRUE(std::ranges::any_of(shader_files(), [&](const gl::ShaderFile& file) { return file.path == path; }))
                    << path;
            }
    }
    EXPECT_EQ(files.size(), 3u);
}

TEST(ShaderKey, TheKindIsTheOnlyOneThatIsSet) {
    EXPECT_THAT(program_defines(ShaderKey{"LIGHT_POINT", {}, {}}),
                ::testing::IsSupersetOf({"LIGHT_DIRECTIONAL 0", "LIGHT_SPOT 0", "LIGHT_POINT 1"}));
}

TEST(ShaderKey, EveryFileThatADefineNamesIsThere) {
    std::size_t files = 0;
    for (const bool rays : {false, true})
        for (bool ShaderKey::*reading : {&ShaderKey::fades, &ShaderKey::depths, &ShaderKey::triangles,
                                          &ShaderKey::moments, &ShaderKey::footprint, &ShaderKey::ray_masks}) {
            ShaderKey row = shadowed_row();
            row.rays = rays;
            row.*reading = true;
            for (const std::string& define : program_defines(row))
                for (const std::string& path : found(define, "\"([^\"]*)\"")) {
                    ++files;
                    EXPECT_TRUE(std::ranges::any_of(shader_files(), [&](const gl::ShaderFile& file) {
                        return file.path == path;
                    })) << path;
                }
        }
    EXPECT_EQ(files, 2u * 6u * 5u);
}

/// Checks that each define that shaders read and none of them sets comes from a row, and each of a row's is read.
/// Exceptions: what LightPrograms sets for its own passes, and the share of the bias that tests take away. Texts for
/// all lights have a define more, for blended taps.
TEST(ShaderKey, NoShaderAsksForAnythingThatNobodyDefines) {
    const std::string code = shader_code();
    const Names asked = found(code, "\\b(SHADOW_[A-Z_]+|RAY_MASKS)\\b");
    const Names own = found(code, "#\\s*define\\s+(SHADOW_\\w*)");
    const Names passes{"SHADOW_SHOWN", "SHADOW_BIAS_SHARE"};
    Names rows = names_of(program_defines(full_row()));
    rows.merge(names_of(shared_defines({})));
    ASSERT_GT(asked.size(), rows.size() / 2);
    for (const std::string& name : asked)
        EXPECT_TRUE(rows.contains(name) || own.contains(name) || passes.contains(name)) << name;
    for (const std::string& name : rows)
        if (!name.starts_with("LIGHT_")) {
            EXPECT_THAT(asked, Contains(name));
        }
}

TEST(ShaderKey, TheGuideNamesEveryDefine) {
    const std::string guide = text_of(test::source_folder() / kGuide);
    const Names table = found(guide, "\n\\| `[^|]*`?(SHADOW\\w*|RAY_MASKS)` \\|");
    Names wanted;
    for (const std::string& name : names_of(program_defines(full_row())))
        if (!name.starts_with("LIGHT_")) wanted.insert(name);
    EXPECT_EQ(table, wanted);
}

/// Checks that no other code spells them once more: such code would leave the next define out.
TEST(ShaderKey, NoOtherCodeSpellsThem) {
    const std::filesystem::path root = test::source_folder();
    EXPECT_FALSE(spelt_in(text_of(root / "systems/shadow/frame/shader_key.cpp")).empty()) << "what is looked for is found";
    const Names passes{"SHADOW_SHOWN"};
    std::size_t files = 0;
    for (const char* part : {"systems", "sample_game", "tests/install_consumer", "docs"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / part)) {
            const std::string kind = entry.path().extension().string();
            if ((kind != ".cpp" && kind != ".h" && kind != ".md") || entry.path().filename() == "shader_key.cpp")
                continue;
            ++files;
            Names spelt = spelt_in(text_of(entry.path()));
            for (const std::string& name : passes) spelt.erase(name);
            EXPECT_THAT(spelt, IsEmpty()) << entry.path();
        }
    EXPECT_GT(files, 100u);
}

TEST(ShaderKey, NamesItsFilesAndTheCameraWhereTheyReadIt) {
    EXPECT_EQ(row_glsl(ShaderKey{"LIGHT_POINT", "shadow/lookup/kinds/point.glsl", {}}), "");
    EXPECT_EQ(row_glsl(shadowed_row()), "#include \"shadow/lookup/kinds/spot.glsl\"\n#include \"shadow/filters/pcf/hard.glsl\"\n");
    ShaderKey prefiltered = shadowed_row();
    prefiltered.moments = true;
    EXPECT_EQ(row_glsl(prefiltered),
              row_glsl(shadowed_row()) + "#include \"shadow/filters/prefiltered/without_bleeding.glsl\"\n");
    EXPECT_EQ(row_glsl(full_row()).find("#include \"common/camera_block.glsl\"\n"), 0u);
}

}  // namespace
}  // namespace gnomon::shadow
