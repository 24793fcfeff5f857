#include "systems/lookup/lookup_glsl.h"

#include <gmock/gmock.h>

#include <array>
#include <set>

#include "engine/gl/glsl_tokens.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::lookup {
namespace {

using enum ShadowFilter;

TEST(LookupRows, AFilterOfTheTextIsItsOwnAndCasesOfItAreToo) {
    for (const ShadowFilter filter : {hard, hardware_2x2, pcf_grid, pcf_bilinear, sharp_4x4, triangles, pcss})
        EXPECT_TRUE(choose_filter(filter, usual_filters()).alike) << shadow::filter_row(filter).name;
    EXPECT_EQ(choose_filter(hard, usual_filters()), (FilterChoice{.filter = pcf_grid, .alike = true, .one_tap = true}));
    EXPECT_EQ(choose_filter(sharp_4x4, usual_filters()), (FilterChoice{.filter = pcss, .alike = true, .without_source = true}));
    constexpr std::array kSharp = {sharp_4x4};
    EXPECT_EQ(choose_filter(sharp_4x4, kSharp), (FilterChoice{.filter = sharp_4x4, .alike = true}));
}

TEST(LookupRows, OthersAreLookedUpByTheNearestButNotByTriangles) {
    const auto nearest = [](ShadowFilter filter) { return choose_filter(filter, usual_filters()).filter; };
    EXPECT_EQ(nearest(vsm), pcf_bilinear);
    EXPECT_EQ(nearest(exact_soft), pcss);
    EXPECT_EQ(nearest(pcss_moments), pcss);
    EXPECT_TRUE(choose_filter(exact, usual_filters()).without_source);
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        const FilterChoice choice = choose_filter(row.id, usual_filters());
        EXPECT_EQ(choice.filter == triangles, row.id == triangles) << row.name;
        EXPECT_EQ(can_evaluate(row.id), !row.moments && !row.rays) << row.name;
        EXPECT_TRUE(can_evaluate(row.id) || !choice.alike) << row.name;
    }
}

TEST(LookupRows, UnitsFollowOneAnother) {
    const LookupUnits units = units_of({.first_texture_unit = 3, .texture_unit_count = 12});
    EXPECT_EQ((std::array{units.arrays, units.first_depths, units.first_triangles, units.first_texels}), (std::array{4u, 3u, 7u, 11u}));
    EXPECT_EQ(units_of({.texture_unit_count = 0}).arrays, 0u);
}

TEST(LookupRows, FiveUnitsAreEnoughForOneArrayAndFewerAreRefusedWithTheNumberAndThePage) {
    EXPECT_EQ(units_of({.texture_unit_count = 5}).arrays, 1u);
    EXPECT_TRUE(lookup_glsl({.texture_unit_count = 5}));
    EXPECT_EQ(units_of({.texture_unit_count = 4}).arrays, 0u);
    const auto few = lookup_glsl({.texture_unit_count = 4});
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().rule, "lookup.bindings");
    EXPECT_THAT(few.error().message, ::testing::AllOf(::testing::HasSubstr(" 5 texture units"), ::testing::HasSubstr("docs/reference/limits.md")));
}

TEST(LookupGlsl, TheSameArgumentsGiveTheSameTextAndOthersAnother) {
    const std::string text = lookup_glsl({}).value();
    EXPECT_EQ(lookup_glsl({}).value(), text);
    EXPECT_NE(lookup_glsl({.first_texture_unit = 1}).value(), text);
    EXPECT_NE(lookup_glsl({.storage_binding = 1}).value(), text);
    constexpr std::array kOne = {hard};
    EXPECT_LT(3 * lookup_glsl({}, {.filters = kOne}).value().size(), 2 * text.size());
    EXPECT_LT(lookup_glsl({}, {.cubes = false}).value().size(), text.size());
}

TEST(LookupGlsl, EveryTopLevelNameBeginsWithThePrefix) {
    const std::set<std::string, std::less<>> known = {
        "const", "int", "float", "bool", "uint", "vec2", "vec3", "vec4", "ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4", "bvec4", "mat3", "mat4",
        "struct", "void", "layout", "uniform", "restrict", "readonly", "buffer", "usamplerBuffer", "sampler2DArray", "usampler2DArray", "false", "true"};
    const auto tokens = gl::glsl_tokens(lookup_glsl({}).value());
    ASSERT_TRUE(tokens);
    int depth = 0;
    std::size_t names = 0;
    for (const gl::GlslToken& token : tokens.value()) {
        depth -= token.is("}") || token.is(")") || token.is("]") ? 1 : 0;
        if (depth == 0 && token.kind == gl::GlslKind::name && !known.contains(token.text)) {
            EXPECT_THAT(token.text, ::testing::StartsWith("gnomon_"));
            ++names;
        }
        depth += token.is("{") || token.is("(") || token.is("[") ? 1 : 0;
    }
    EXPECT_GT(names, 100u);
    EXPECT_EQ(depth, 0);
}

}  // namespace
}  // namespace gnomon::lookup
