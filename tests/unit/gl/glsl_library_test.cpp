#include "engine/gl/glsl_library.h"

#include <gmock/gmock.h>

#include "engine/gl/glsl_tokens.h"

namespace gnomon::gl {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string joined(std::string_view text) {
    const auto tokens = glsl_tokens(text);
    return tokens ? glsl_text(tokens.value()) : "error: " + tokens.error().message;
}

TEST(GlslTokens, CommentsAndDirectivesAreGone) {
    EXPECT_EQ(joined("#version 450 core\n#line 1 2  // a.glsl\nfloat a; // b\nint /* c\n d */ e;\n"), "float a;\nint\n e;");
    EXPECT_EQ(joined("a / b; // x"), "a / b;");
    EXPECT_EQ(joined("int lo\\\nng;"), "int long;");
}

TEST(GlslTokens, NumbersAndOperatorsStayWhole) {
    const auto tokens = glsl_tokens("x=1.0e-5+.5f*0x7feb352du>>3<=a.xy;");
    ASSERT_TRUE(tokens);
    std::vector<std::string> texts;
    for (const GlslToken& token : tokens.value()) texts.push_back(token.text);
    EXPECT_THAT(texts, ::testing::ElementsAre("x", "=", "1.0e-5", "+", ".5f", "*", "0x7feb352du", ">>", "3", "<=", "a", ".", "xy", ";"));
}

TEST(GlslTokens, MacrosAreExpandedWhereNamesAreWhole) {
    EXPECT_EQ(joined("#define TAPS 9\nint a = TAPS, TAPS_2 = b.TAPSX;"), "int a = 9, TAPS_2 = b.TAPSX;");
    EXPECT_EQ(joined("#define A B\n#define B (A + 1)\nx = A;"), "x = (A + 1);") << "no macro within itself";
    EXPECT_EQ(joined("#define N -1\nx = -N;"), "x = - -1;") << "two signs are no decrement";
    EXPECT_EQ(joined("#define N 1\n#undef N\nx = N;"), "x = N;");
}

TEST(GlslTokens, BranchesAreChosen) {
    const std::string_view text = "#if ON\na\n#elif defined(ALSO) && !OFF\nb\n#else\nc\n#endif\n#ifdef ON\nd\n#endif\n#ifndef ON\ne\n#endif\n";
    const auto with = [&](const char* defines) { return joined(std::string(defines) + std::string(text)); };
    EXPECT_EQ(with("#define ON 1\n"), "a\nd");
    EXPECT_EQ(with("#define ON 0\n#define ALSO\n"), "b\nd");
    EXPECT_EQ(with("#define ALSO\n#define OFF 1\n"), "c\ne");
    EXPECT_EQ(joined("#if 0\n#if WHAT EVER(\n#else\nx\n#endif\n#define A 1\n#endif\nA"), "A") << "nothing of an inactive part counts";
}

TEST(GlslTokens, WhatItCannotTakeItSays) {
    for (const char* text : {"#extension all : enable\n", "#define F(x) x\n", "#if A\n", "#endif\n", "#if A + 1\n#endif\n", "#ifdef\n#endif\n"}) {
        const auto tokens = glsl_tokens(text);
        ASSERT_FALSE(tokens) << text;
        EXPECT_EQ(tokens.error().rule, "glsl.preprocessor");
    }
}

/// Returns the text of all that was added.
std::string all(const GlslLibrary& library, const GlslNames& names) {
    std::set<std::string, std::less<>> roots;
    for (const auto& [own, final] : names) roots.insert(final);
    return library.text(roots);
}

TEST(GlslLibrary, TopLevelNamesGetThePrefix) {
    GlslLibrary library("g_", {});
    const auto names = library.add("const int kA = 1, kB = kA + 2;\nconst vec2 kC[2] = { vec2(kA), vec2(kB) };\nint counter;\n"
                                   "float twice(float x) { return 2.0 * x; }\nfloat four(float x) { ++counter; return twice(twice(x)) + kC[kA].x; }\n");
    ASSERT_TRUE(names) << to_line(names.error());
    EXPECT_EQ(all(library, names.value()),
              "const int g_kA = 1, g_kB = g_kA + 2;\nconst vec2 g_kC[2] = { vec2(g_kA), vec2(g_kB) };\nint g_counter;\n"
              "float g_twice(float x) { return 2.0 * x; }\nfloat g_four(float x) { ++g_counter; return g_twice(g_twice(x)) + g_kC[g_kA].x; }\n");
    EXPECT_EQ(names.value().at("four"), "g_four");
}

TEST(GlslLibrary, MembersAndSwizzlesKeepTheirNames) {
    GlslLibrary library("g_", {{"light", "lights[i]"}});
    const auto names = library.add("const int kMost = 2;\nstruct Place { vec3 light; vec2 xy[kMost]; };\n"
                                   "vec2 xy(Place p) { return p.xy[0] + vec2(p.light.xy) + light.position.xy; }\n"
                                   "float map(vec2 xy) { return xy.x; }\nfloat of(Place p) { return map(xy(p)).xxxx.y; }\n");
    ASSERT_TRUE(names) << to_line(names.error());
    EXPECT_EQ(all(library, names.value()),
              "const int g_kMost = 2;\nstruct g_Place { vec3 light; vec2 xy[g_kMost]; };\n"
              "vec2 g_xy(g_Place p) { return p.xy[0] + vec2(p.light.xy) + lights[i].position.xy; }\n"
              // A parameter that hides a function is renamed with it.
              "float g_map(vec2 g_xy) { return g_xy.x; }\nfloat g_of(g_Place p) { return g_map(g_xy(p)).xxxx.y; }\n");
}

TEST(GlslLibrary, WhatTextsShareStandsOnceAndWhatDiffersTwice) {
    GlslLibrary library("g_", {});
    const std::string head = "float half_of(float x) { return 0.5 * x; }\n";
    const auto one = library.add(head + "float tap(float x) { return half_of(x); }\nfloat filter_it(float x) { return tap(x); }\n");
    const auto two = library.add("// the same\n" + head + "float tap(float x) { return half_of(x) + 1.0; }\nfloat filter_it(float x) { return tap(x); }\n");
    const auto three = library.add(head + "float tap(float x)  { return\n half_of(x); }\n");
    ASSERT_TRUE(one && two && three);
    EXPECT_EQ(one.value().at("half_of"), two.value().at("half_of"));
    EXPECT_EQ(one.value().at("tap"), three.value().at("tap")) << "lines and blanks are no difference";
    EXPECT_EQ(one.value().at("tap"), "g_tap");
    EXPECT_EQ(two.value().at("tap"), "g_tap_2");
    EXPECT_EQ(two.value().at("filter_it"), "g_filter_it_2") << "its text is the same, but it calls another tap";
    const std::string text = library.text({"g_filter_it", "g_filter_it_2"});
    EXPECT_THAT(text, HasSubstr("float g_filter_it_2(float x) { return g_tap_2(x); }"));
    EXPECT_EQ(text.find("g_half_of(float"), text.rfind("g_half_of(float"));
}

TEST(GlslLibrary, OnlyWhatIsNeededIsWritten) {
    GlslLibrary library("g_", {});
    ASSERT_TRUE(library.add("const int kUnused = 3;\nint one() { return 1; }\nint two() { return 2 * one(); }\nint three() { return one(); }\n"));
    EXPECT_EQ(library.text({"g_two"}), "int g_one() { return 1; }\nint g_two() { return 2 * g_one(); }\n");
    EXPECT_EQ(library.text({"g_three"}, {"g_two"}), "int g_three() { return g_one(); }\n");
    EXPECT_EQ(library.text({}), "");
}

TEST(GlslLibrary, BlocksAndSamplersAreReplacedWithTheirNames) {
    GlslLibrary library("g_", {{"light", "lights[at]"}, {"map", "maps"}, {"words", "all_words"}});
    const auto names = library.add("const int kN = 2;\nstruct View { float a; };\nlayout(std140, binding = kN) uniform Block { View views[kN]; vec4 light; } light;\n"
                                   "layout(binding = 3) uniform sampler2D map;\nlayout(std430, binding = 1) readonly buffer Words { uint words[]; };\n"
                                   "float look(vec2 at) { return texture(map, at).x + light.views[kN - 1].a + float(words[0]); }\n");
    ASSERT_TRUE(names) << to_line(names.error());
    using Member = GlslLibrary::Member;
    EXPECT_THAT(library.members("Block"), ::testing::ElementsAre(Member{"g_View", "views", true}, Member{"vec4", "light", false}));
    EXPECT_THAT(library.members("None"), ::testing::IsEmpty());
    const std::string text = library.text({"g_look"});
    EXPECT_THAT(text, HasSubstr("texture(maps, at).x + lights[at].views[g_kN - 1].a + float(all_words[0])"));
    EXPECT_THAT(text, Not(HasSubstr("uniform")));
}

TEST(GlslLibrary, ElementsBecomeCalls) {
    GlslLibrary library("g_", {{"light", "lamp"}});
    library.replace_elements("light", "views", "view_at");
    const auto names = library.add("float near(int i) { return light.views[light.views[i].next[2] + 1].near + a.light.views[3] + light.size[0]; }\n");
    ASSERT_TRUE(names) << to_line(names.error());
    EXPECT_EQ(library.text({"g_near"}), "float g_near(int i) { return view_at(view_at(i).next[2] + 1).near + a.light.views[3] + lamp.size[0]; }\n");
}

TEST(GlslLibrary, WhatItCannotJoinItSays) {
    for (const char* text : {"uniform sampler2D map;\n", "layout(binding = 1) uniform Block { vec4 a; } block;\n", "float f(float x);\n",
                             "float f(float x) { return x; }\nfloat f(vec2 x) { return x.x; }\n"}) {
        GlslLibrary library("g_", {});
        const auto names = library.add(text);
        ASSERT_FALSE(names) << text;
        EXPECT_EQ(names.error().rule, "glsl.library");
    }
}

}  // namespace
}  // namespace gnomon::gl
