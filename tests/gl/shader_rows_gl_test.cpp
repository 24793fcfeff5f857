#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/gl_test_context.h"
#include "tests/gl/program_sources.h"

// The programs that a frame can need, on the real compiler. The fixture fails on any driver message.
namespace gnomon {
namespace {

class ShaderRows : public GlTest {};

// Counts and compares all, and compiles one of seven, so each output with some rows: ShaderLayout compiles all in long
// runs.
TEST_F(ShaderRows, EveryRowAndOutputIsThereOnceAndCompilesInSilence) {
    constexpr std::size_t kStride = 7;  // no factor in common with kOutputs
    const auto programs = all_programs();
    constexpr std::size_t kArea = 4, kPlain = 3;  // kinds of lights
    const std::size_t kinds = shadow::light_kind_table().size(), filters = map_filters().size();
    ASSERT_EQ(kinds, kArea + kPlain);
    const auto rows_of = [&](std::size_t some) {  // all but cubes fade; perspective and warped suns, aimed points
        return kPlain * 2 * some + (kPlain - 1) * some + 4 * some;
    };
    constexpr std::size_t kAreaRows = 4 + 3, kAreaPrefiltered = 1;  // four of rectangles, one of each other kind
    constexpr std::size_t kAreaByTriangles = 1;
    const auto prefiltered = static_cast<std::size_t>(
        std::count_if(shadow::filter_table().begin(), shadow::filter_table().end(), reads_moments));
    const auto by_triangles = static_cast<std::size_t>(
        std::count_if(shadow::filter_table().begin(), shadow::filter_table().end(), reads_triangles));
    constexpr std::size_t kMaskedOrNot = 2;
    // Rows of rays alone: as every row, and aimed points. With sheets, one program per kind and output reads what is
    // found. Blended surfaces, catchers, fog, verdicts and rays have their own, masked or not.
    const std::size_t by_rays = (kPlain + 1) * kMaskedOrNot * (shadow::filter_table().size() - filters) + kArea;
    const std::size_t with_sheets = 2 * kinds + 5 * by_rays;
    constexpr std::size_t kOutputs = 5, kDepth = 6, kCompute = 5, kBlur = 1, kSources = 3;
    // Surfaces, with places or without, and blended ones: lit or unlit, coloured or not. Catchers, coloured or not, and
    // their shares. Luminance, and tone curve with a background or without. What fog takes.
    constexpr std::size_t kCommon = 3 * 2 * 2 + 3 + 3 + 1;
    // Rows by a pixel's footprint count, too, and so do rows of masked casters.
    const std::size_t rows = kinds + rows_of(filters) + rows_of(prefiltered) + rows_of(by_triangles) + by_rays +
                             kAreaRows + kAreaPrefiltered + kAreaByTriangles;
    std::size_t views_programs = 1;  // lines
    for (const debug::ViewRow& view : debug::view_table()) {
        if (view.drawer->medium == debug::ViewMedium::flat) ++views_programs;
        if (view.drawer->medium != debug::ViewMedium::lookups) continue;
        EXPECT_GT(lookup_rows(view.name).size(), kPlain);  // perspective and warped suns
        views_programs += lookup_rows(view.name).size();
    }
    ASSERT_EQ(programs.size(), rows * kOutputs + with_sheets + kCommon + kDepth + kCompute + kBlur +
                                   kSources * prefiltered + views_programs);
    std::set<std::string> sources;
    for (const gl::ProgramDesc& desc : programs) {
        ASSERT_NE(desc.fragment + desc.compute, "") << desc.label;
        EXPECT_TRUE(sources.insert(desc.vertex + desc.fragment + desc.compute).second)
            << desc.label << " equals another program";
        if (sources.size() % kStride != 0) continue;
        const auto made = device().create_program(desc);
        EXPECT_TRUE(made) << desc.label << ": " << made.log;
        EXPECT_EQ(made.log, "") << desc.label;
        device().destroy(made.handle);
    }
}

TEST_F(ShaderRows, ASourceWithAMistakeIsRefused) {
    auto desc = all_programs().front();
    desc.fragment += "\nfloat unfinished( {\n";
    EXPECT_EQ(device().create_program(desc).failure, gl::Failure::compile_failed);
    take_messages();
}

TEST_F(ShaderRows, ARowWhoseFilterIsMissingIsRefusedAndTheOthersStay) {
    lighting::LightPrograms programs(device());
    shadow::ShaderKey row = all_rows().back();
    row.filter_file = "shadow/filters/none_such.glsl";
    EXPECT_FALSE(programs.row(row, lighting::ShaderPass::blended));
    EXPECT_TRUE(programs.row(all_rows().back(), lighting::ShaderPass::blended));
}

/// Returns the interface of a stage toward its neighbours, in lines of its text.
std::vector<std::string> varyings(const std::string& text, bool inputs, bool outputs) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    const std::regex varying(R"(^(layout\(.*\) )?((flat|smooth|noperspective) )?(in|out) .*)");
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, match, varying) && (match[4] == "in" ? inputs : outputs)) found.push_back(line);
    return found;
}

// NVIDIA gives the others locations that are taken, and refuses to link.
TEST(ShaderVaryings, AllOfAProgramHaveLocationsOrNoneHas) {
    std::size_t with = 0, without = 0;
    for (const gl::ProgramDesc& desc : all_programs()) {
        std::vector<std::string> all = varyings(desc.vertex, false, true);
        for (const auto& more : {varyings(desc.geometry, true, true), varyings(desc.fragment, true, false)})
            all.insert(all.end(), more.begin(), more.end());
        const auto located = static_cast<std::size_t>(std::count_if(
            all.begin(), all.end(), [](const std::string& line) { return line.rfind("layout(location", 0) == 0; }));
        EXPECT_TRUE(located == 0 || located == all.size()) << desc.label << ": " << ::testing::PrintToString(all);
        with += located > 0;
        without += located == 0 && !all.empty();
    }
    EXPECT_GT(with, 0u);
    EXPECT_GT(without, 0u);
}

}  // namespace
}  // namespace gnomon
