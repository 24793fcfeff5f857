#include "sample_game/app/command_line.h"

#include <gmock/gmock.h>

#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result<CommandLine> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "gnomon_game");
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommandLine, DefaultsAreThoseOfTheContract) {
    const auto line = parse({});
    ASSERT_TRUE(line);
    EXPECT_EQ(line.value().size_px, glm::uvec2(1280, 720));
    EXPECT_FALSE(line.value().scene || line.value().camera || line.value().frames || line.value().time_s);
    EXPECT_FALSE(line.value().exposure_ev || line.value().headless);
    EXPECT_EQ(line.value().print, "");
}

TEST(CommandLine, EveryFlagIsUnderstood) {
    const auto line = parse({"--scene",     "a b.glb",       "--camera",   "1",
                             "--size",      "64x32",         "--headless", "--frames",
                             "3",           "--time",        "-1.5",       "--exposure",
                             "7.5",         "--stats",       "s",          "--screenshot",
                             "p",           "--visibility",  "v",          "--set",
                             "filter=hard", "--set=bias=0.5"});
    ASSERT_TRUE(line) << to_line(line.error());
    const CommandLine& l = line.value();
    EXPECT_EQ(l.scene, "a b.glb");
    EXPECT_EQ(l.camera, "1");
    EXPECT_EQ(l.size_px, glm::uvec2(64, 32));
    EXPECT_TRUE(l.headless);
    EXPECT_EQ(l.frames, 3u);
    EXPECT_EQ(l.time_s, -1.5);
    EXPECT_EQ(l.exposure_ev, 7.5f);
    EXPECT_EQ(l.settings, (std::vector<std::string>{"filter=hard", "bias=0.5"}));
}

TEST(CommandLine, ABudgetIsANumberAboveNothing) {
    const CommandLine l = parse({"--shadow-bytes", "67108864", "--shadow-ms=4.5", "--shadow-rays", "90000"}).value();
    EXPECT_EQ(l.shadow_budget, (shadow::ShadowBudget{64u << 20, 4.5f, 90000}));
    EXPECT_EQ(parse({}).value().shadow_budget, shadow::ShadowBudget{});
    EXPECT_EQ(parse({"--shadow-bytes", "any"}).value().shadow_budget.bytes, shadow::ShadowBudget::kUnlimited);
    for (const char* bad : {"0", "-1", "", "64M", "1e6", "99999999999999999999"})
        EXPECT_FALSE(parse({"--shadow-bytes", bad}) || parse({"--shadow-rays", bad})) << bad;
    for (const char* bad : {"0", "-1", "", "nan", "inf", "4ms", "1e9"})
        EXPECT_FALSE(parse({"--shadow-ms", bad})) << bad;
}

TEST(CommandLine, MistIsAShareOfLightPerMetre) {
    EXPECT_EQ(parse({}).value().mist_per_m, 0.0f);
    EXPECT_EQ(parse({"--mist", "0.06"}).value().mist_per_m, 0.06f);
    EXPECT_EQ(parse({"--mist=10"}).value().mist_per_m, 10.0f);
    for (const char* bad : {"-0.1", "10.1", "nan", "", "thick"}) EXPECT_FALSE(parse({"--mist", bad})) << bad;
}

TEST(CommandLine, TheTruthIsAPictureAndItsLightGoesWithItAlone) {
    const CommandLine l = parse({"--truth", "t.png", "--truth-light", "sun"}).value();
    EXPECT_EQ(l.truth, "t.png");
    EXPECT_EQ(l.truth_light, "sun");
    EXPECT_FALSE(parse({}).value().truth);
    EXPECT_FALSE(parse({"--truth-light", "sun"}));
    EXPECT_FALSE(parse({"--truth", ""}));
}

TEST(CommandLine, AWindowSmoothsItsPictureAndCountedFramesDoNot) {
    const CommandLine window = parse({}).value(), counted = parse({"--frames", "2"}).value(),
                      headless = parse({"--headless"}).value();
    EXPECT_EQ(still_samples(window), 64u);
    EXPECT_TRUE(smooths_edges(window));
    for (const CommandLine& line : {counted, headless}) {
        EXPECT_EQ(still_samples(line), 1u);
        EXPECT_FALSE(smooths_edges(line));
    }
    EXPECT_EQ(still_samples(parse({"--headless", "--samples", "1024"}).value()), 1024u);
    EXPECT_EQ(still_samples(parse({"--samples", "1"}).value()), 1u);
    EXPECT_TRUE(smooths_edges(parse({"--headless", "--smooth", "on"}).value()));
    EXPECT_FALSE(smooths_edges(parse({"--smooth=off"}).value()));
    for (const char* bad : {"0", "1025", "-1", "1.5", ""}) EXPECT_FALSE(parse({"--samples", bad})) << bad;
    for (const char* bad : {"", "yes", "ON"}) EXPECT_FALSE(parse({"--smooth", bad})) << bad;
}

TEST(CommandLine, APresetIsOneOfThreeWords) {
    EXPECT_EQ(parse({}).value().preset, nullptr);
    for (const char* name : {"fast", "default", "high"})
        EXPECT_EQ(parse({"--preset", name}).value().preset, find_preset(name)) << name;
    for (const char* bad : {"", "FAST", "ultra"}) EXPECT_FALSE(parse({"--preset", bad})) << bad;
    EXPECT_THAT(parse({"--list"}).value().print, HasSubstr("Presets of --preset"));
}

TEST(CommandLine, TheGameIsPlayedInAPlainWindowAndByTheDemo) {
    for (const auto& plays : {std::vector<const char*>{},
                              {"--size", "64x64"},
                              {"--demo"},
                              {"--demo", "--headless"},
                              {"--demo", "--frames", "2", "--time", "1"}})
        EXPECT_TRUE(plays_game(parse(plays).value()));
    for (const auto& looks : {std::vector<const char*>{"--headless"},
                              {"--scene", "a.glb"},
                              {"--camera", "top"},
                              {"--frames", "2"},
                              {"--time", "0"}})
        EXPECT_FALSE(plays_game(parse(looks).value())) << looks.front();
    EXPECT_FALSE(parse({"--demo", "--scene", "a.glb"}));
    EXPECT_FALSE(parse({"--demo", "--camera", "top"}));
}

TEST(CommandLine, LimitsAreInclusive) {
    EXPECT_TRUE(parse({"--size", "1x16384"}));
    EXPECT_FALSE(parse({"--size", "1x16385"}));
    EXPECT_FALSE(parse({"--size", "0x1"}));
    EXPECT_TRUE(parse({"--frames", "1"}));
    EXPECT_FALSE(parse({"--frames", "0"}));
}

TEST(CommandLine, ErrorsAreOneLineEvenIfTheArgumentIsNot) {
    for (const char* bad : {"--nonsense\nx", "line\nbreak"}) {
        const auto line = parse({bad});
        ASSERT_FALSE(line);
        EXPECT_THAT(to_line(line.error()), Not(HasSubstr("\n")));
    }
}

TEST(CommandLine, FramesEndAtTheAskedTimeOrStartAtZero) {
    CommandLine line;
    EXPECT_EQ(frame_time_s(line, 0, 3), 0.0);
    EXPECT_DOUBLE_EQ(frame_time_s(line, 2, 3), 2.0 / 60.0);
    line.time_s = 5.0;
    EXPECT_EQ(frame_time_s(line, 2, 3), 5.0);
    EXPECT_DOUBLE_EQ(frame_time_s(line, 0, 3), 5.0 - 2.0 / 60.0);
}

TEST(NumberText, NumbersAreReadWholeOrNotAtAll) {
    EXPECT_EQ(read_number("-1.5e2"), -150.0);
    for (const char* bad : {"", " 1", "1 ", "+1", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5"})
        EXPECT_EQ(read_number(bad), std::nullopt) << bad;
    EXPECT_EQ(read_count("42"), 42u);
    for (const char* bad : {"", "-1", "+1", "1.0", "0x1", "18446744073709551616"})
        EXPECT_EQ(read_count(bad), std::nullopt) << bad;
}

}  // namespace
}  // namespace gnomon::game
