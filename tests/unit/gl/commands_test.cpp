#include "engine/gl/commands.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::gl {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CommandList sample() {
    CommandList list;
    list.add(BeginGroup{"sun"});
    list.add(BeginPass{.target = {7}, .viewport = {0, 0, 512, 256}, .clear_depth = true, .depth = 0.0f});
    list.add(SetPipeline{{.program = {3}, .cull = CullMode::front, .depth_test = DepthTest::greater}});
    list.add(EndPass{});
    list.add(EndGroup{});
    return list;
}

TEST(CommandList, ListsWithTheSameCommandsAreEqual) { EXPECT_EQ(sample(), sample()); }

TEST(CommandList, OneChangedFieldMakesListsDiffer) {
    CommandList changed = sample();
    std::get<BeginPass>(changed.commands[1]).viewport.height = 255;
    EXPECT_NE(changed, sample());
    CommandList longer = sample();
    longer.add(DrawTriangle{});
    EXPECT_NE(longer, sample());
}

TEST(CommandList, UpdateCopiesTheValuesBehindEarlierOnes) {
    CommandList list;
    const std::array<std::uint32_t, 2> first = {1, 2};
    const std::array<float, 1> second = {0.5f};
    list.update(BufferHandle{4}, 16, std::span<const std::uint32_t>{first});
    list.update(BufferHandle{5}, 0, std::span<const float>{second});
    ASSERT_EQ(list.commands.size(), 2u);
    EXPECT_EQ(std::get<UpdateBuffer>(list.commands[0]), (UpdateBuffer{{4}, 16, 0, 8}));
    EXPECT_EQ(std::get<UpdateBuffer>(list.commands[1]), (UpdateBuffer{{5}, 0, 8, 4}));
    float stored = 0.0f;
    std::memcpy(&stored, list.bytes.data() + 8, sizeof stored);
    EXPECT_EQ(stored, 0.5f);
}

TEST(CommandList, UpdateOfNothingAddsNoCommand) {
    CommandList list;
    list.update(BufferHandle{4}, 0, std::span<const float>{});
    EXPECT_EQ(list, CommandList{});
}

TEST(CommandList, ListsWithTheSameCommandsButOtherPayloadDiffer) {
    CommandList a, b;
    const std::array<float, 1> one = {1.0f}, two = {2.0f};
    a.update(BufferHandle{1}, 0, std::span<const float>{one});
    b.update(BufferHandle{1}, 0, std::span<const float>{two});
    EXPECT_EQ(a.commands, b.commands);
    EXPECT_NE(a, b);
}

TEST(GroupLabel, HoldsItsTextAndComparesByIt) {
    EXPECT_EQ(GroupLabel("sun").text(), "sun");
    EXPECT_EQ(GroupLabel(std::string("sun")), GroupLabel("sun"));
    EXPECT_NE(GroupLabel("sun"), GroupLabel("sung"));
    EXPECT_EQ(GroupLabel("shadow", "sun", "3").text(), "shadow sun 3");
    EXPECT_EQ(GroupLabel().text(), "");
}

TEST(GroupLabel, OfALongNameKeepsWhatStandsAroundIt) {
    const GroupLabel cut("shadow", std::string(1000, 'x'), "faces");
    EXPECT_EQ(cut.text(), "shadow " + std::string(GroupLabel::kMost - 13, 'x') + " faces");
    EXPECT_EQ(GroupLabel(std::string(1000, 'x')).text(), std::string(GroupLabel::kMost, 'x'));
    EXPECT_EQ(GroupLabel("shadow", "sun", std::string(1000, '7')).text().size(), GroupLabel::kMost);
}

TEST(GroupLabel, IsCutBetweenCharacters) {
    std::string name = "x";
    for (int i = 0; i < 100; ++i) name += "\u00e4";  // two bytes each
    EXPECT_EQ(GroupLabel(name).text(), name.substr(0, GroupLabel::kMost)) << "63 bytes: one and 31 twos";
    EXPECT_EQ(GroupLabel(name.substr(1)).text(), name.substr(1, GroupLabel::kMost - 1));
}

TEST(CommandText, EachCommandIsOneLineThatNamesIt) {
    const std::string text = to_text(sample());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
    EXPECT_THAT(text, HasSubstr("BeginGroup \"sun\"\n"));
    EXPECT_THAT(text, HasSubstr("BeginPass target=#7 viewport=0,0 512x256 depth=0\n"));
    EXPECT_THAT(text, HasSubstr("program=#3 cull=front depth_test=greater blend=off"));
}

TEST(CommandText, WhatABeginPassDoesNotClearIsNotNamed) {
    EXPECT_THAT(to_text(Command{BeginPass{}}), Not(HasSubstr("depth")));
    EXPECT_THAT(to_text(Command{BeginPass{.clear_colour = true}}), HasSubstr("colour=0,0,0,0"));
}

TEST(CommandText, CommandsThatDifferHaveDifferentText) {
    const std::vector<Command> commands = {
        SetScissor{},
        SetScissor{{1, 2, 3, 4}},
        BindTexture{1, {2}, {3}},
        BindTexture{1, {3}, {2}},
        BindUniforms{0, {1}, 256, 64},
        BindStorage{0, {1}},
        BindTexels{0, {1}},
        BindTexels{1, {1}},
        UpdateBuffer{{1}, 0, 4, 8},
        ClearBuffer{{1}, 8, 4},
        BindMeshes{{1}, {2}, {3}},
        BindMeshes{{1}, {2}, {3}, {.stride = 12}},
        BindMeshes{{1}, {2}, {3}, {.stride = 16}},
        BindMeshes{{1}, {2}, {3}, {.stride = 12, .position_offset = 4}},
        BindMeshes{{1}, {2}, {3}, {.stride = 12, .position = PositionFormat::float16}},
        BindMeshes{{1}, {2}, {3}, {.stride = 12, .short_indices = true}},
        DrawMeshes{0, 3, 1, 0, 1},
        DrawMeshes{0, 3, -1, 0, 1},
        DrawMeshesIndirect{{1}, 0, 3, 6, 1},
        DrawMeshesIndirect{{2}, 0, 3, 6, 1},
        DrawMeshesIndirect{{1}, 1, 3, 6, 1},
        DrawMeshesIndirect{{1}, 0, 2, 6, 1},
        DrawMeshesIndirect{{1}, 0, 3, 7, 1},
        DrawMeshesIndirect{{1}, 0, 3, 6, 2},
        DrawTriangle{},
        DrawTriangle{0.0f},
        DrawTriangle{0.5f},
        DrawLines{6},
        DrawPoints{0, 6},
        DrawPoints{6, 6},
        DrawPulled{0, 6},
        DrawPulled{6, 6},
        Dispatch{{1}, 2, 3},
        Dispatch{{1}, 3, 2},
        CopyBuffer{{1}, {2}},
        CopyBuffer{{2}, {1}},
        CopyBuffer{{2}, {1}, 0, 0, 4},
        CopyBuffer{{2}, {1}, 4, 0, 4},
        CopyBuffer{{2}, {1}, 0, 4, 4},
        CopyTexture{{1}, {2}, 0},
        CopyTexture{{2}, {1}, 0},
        CopyTexture{{2}, {1}, 1},
        CopyTexture{{2}, {1}, 1, {0, 1, 2, 3}},
        GenerateMips{{1}},
        Blit{{1}, {2}, {0, 0, 1, 1}, {0, 0, 2, 2}},
        BeginTimer{1},
        EndTimer{1},
        SetPipeline{{.front_is_clockwise = true}},
        SetPipeline{{.depth_write = true}},
        SetPipeline{{.depth_clamp = true}},
        SetPipeline{{.blend = Blend::alpha}},
        SetPipeline{{.blend = Blend::largest}}};
    for (std::size_t i = 0; i < commands.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(to_text(commands[i]), to_text(commands[j]));
    }
}

}  // namespace
}  // namespace gnomon::gl
