#include "sample_game/app/gamepad.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace gnomon::game {
namespace {

constexpr double kDt_s = 0.1;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

Gamepad at_rest() { return {.present = true}; }
Gamepad walking(float x, float y) { return {.present = true, .left_x = x, .left_y = y}; }
Gamepad holding(PadButton button) {
    Gamepad pad = at_rest();
    pad.down[static_cast<std::size_t>(button)] = true;
    return pad;
}

GameInput one(const Gamepad& before, const Gamepad& now) {
    return gamepad_input(std::span(&before, 1), std::span(&now, 1), kDt_s);
}
GameInput one(const Gamepad& now) { return one(now, now); }

void expect_nothing(const GameInput& input) {
    EXPECT_EQ(input.forward, 0.0);
    EXPECT_EQ(input.right, 0.0);
    EXPECT_EQ(input.yaw_rad, 0.0);
    EXPECT_EQ(input.pitch_rad, 0.0);
    EXPECT_EQ(input.sun, 0.0);
    EXPECT_FALSE(input.run || input.toggle_pause || input.restart);
}

TEST(GamepadInput, UpOnTheLeftStickWalksForwardAndRightOfItToTheRight) {
    EXPECT_DOUBLE_EQ(one(walking(0.0f, -1.0f)).forward, 1.0);
    EXPECT_DOUBLE_EQ(one(walking(0.0f, 1.0f)).forward, -1.0);
    EXPECT_DOUBLE_EQ(one(walking(1.0f, 0.0f)).right, 1.0);
    EXPECT_DOUBLE_EQ(one(walking(-1.0f, 0.0f)).right, -1.0);
}

TEST(GamepadInput, TheRightStickTurnsTheHeadAsFastAsItIsPushedAndAsLongAsItLasts) {
    const GameInput right = one({.present = true, .right_x = 1.0f});
    EXPECT_DOUBLE_EQ(right.yaw_rad, -kLook_rad_per_s * kDt_s);
    EXPECT_EQ(right.forward, 0.0);
    EXPECT_DOUBLE_EQ(one({.present = true, .right_y = -1.0f}).pitch_rad, kLook_rad_per_s * kDt_s);
    const Gamepad half{.present = true, .right_x = 0.5f};
    EXPECT_NEAR(one(half).yaw_rad, -kLook_rad_per_s * kDt_s / 3.0, 1e-9);
    EXPECT_EQ(gamepad_input({}, std::span(&half, 1), 0.0).yaw_rad, 0.0);
}

TEST(GamepadInput, WithinTheDeadZoneNothingMovesAndBeyondItMotionStartsFromNothing) {
    const auto dead = static_cast<float>(kDeadZone);
    expect_nothing(one(walking(dead, 0.0f)));
    expect_nothing(one(walking(-0.17f, 0.17f)));  // round, not square
    expect_nothing(one({.present = true, .right_x = 0.2f, .right_y = -0.1f}));
    EXPECT_GT(one(walking(std::nextafter(dead, 1.0f), 0.0f)).right, 0.0);
    EXPECT_LT(one(walking(dead + 0.001f, 0.0f)).right, 0.002);
    EXPECT_GT(one(walking(0.2f, -0.2f)).forward, 0.0);
}

TEST(GamepadInput, NoCornerOfTheStickIsFasterThanItsEnd) {
    for (const auto& [x, y] : {std::pair{1.0f, 1.0f}, {-1.0f, 1.0f}, {3.0f, -4.0f}, {1.0f, 0.001f}}) {
        const GameInput input = one(walking(x, y));
        EXPECT_LE(std::hypot(input.forward, input.right), 1.0 + 1e-12) << x << ' ' << y;
        EXPECT_GT(std::hypot(input.forward, input.right), 0.99) << x << ' ' << y;
    }
}

TEST(GamepadInput, AnAxisThatIsNoNumberAsksForNothingAndTheRestStillCounts) {
    for (const float bad : {kNaN, kInfinity, -kInfinity}) {
        expect_nothing(one(walking(bad, 0.0f)));
        expect_nothing(one(walking(0.0f, bad)));
        expect_nothing(one(walking(bad, -1.0f)));
        expect_nothing(one({.present = true, .right_x = bad, .right_y = 1.0f}));
    }
    expect_nothing(one({.present = true, .left_trigger = kNaN, .right_trigger = kNaN}));
    const GameInput looks = one({.present = true, .left_x = kNaN, .right_x = 1.0f});
    EXPECT_EQ(looks.right, 0.0);
    EXPECT_LT(looks.yaw_rad, 0.0);
    EXPECT_EQ(one(walking(std::numeric_limits<float>::max(), 0.0f)).right, 1.0);
    EXPECT_EQ(one(walking(std::numeric_limits<float>::denorm_min(), 0.0f)).right, 0.0);
}

TEST(GamepadInput, TriggerAndBumpersRunAndTheCrossMovesTheSun) {
    EXPECT_FALSE(one(at_rest()).run);
    EXPECT_TRUE(one({.present = true, .right_trigger = 1.0f}).run);
    EXPECT_FALSE(one({.present = true, .right_trigger = -0.1f}).run);
    EXPECT_TRUE(one(holding(PadButton::left_bumper)).run);
    EXPECT_TRUE(one(holding(PadButton::right_bumper)).run);
    EXPECT_EQ(one(holding(PadButton::right)).sun, 1.0);
    EXPECT_EQ(one(holding(PadButton::left)).sun, -1.0);
}

TEST(GamepadInput, StartPausesAndBackRestartsOnceHoweverLongTheyAreHeld) {
    EXPECT_TRUE(one(at_rest(), holding(PadButton::start)).toggle_pause);
    EXPECT_FALSE(one(holding(PadButton::start), holding(PadButton::start)).toggle_pause);
    EXPECT_FALSE(one(holding(PadButton::start), at_rest()).toggle_pause);
    EXPECT_TRUE(one(at_rest(), holding(PadButton::back)).restart);
    EXPECT_FALSE(one(holding(PadButton::back)).restart);
    EXPECT_FALSE(one(at_rest(), holding(PadButton::start)).restart);
    expect_nothing(one(at_rest(), holding(PadButton::a)));
}

TEST(GamepadInput, PlugsGoInAndOutWithoutPressingAnything) {
    Gamepad unplugged = holding(PadButton::start);
    unplugged.present = false;
    unplugged.left_x = unplugged.right_trigger = 1.0f;
    expect_nothing(one(unplugged));
    expect_nothing(one(holding(PadButton::start), unplugged));
    expect_nothing(one({}, holding(PadButton::start)));
    expect_nothing(one(unplugged, holding(PadButton::back)));
    expect_nothing(gamepad_input({}, {}, kDt_s));
    const Gamepad held = holding(PadButton::start);
    expect_nothing(gamepad_input({}, std::span(&held, 1), kDt_s));  // more pads than before
    expect_nothing(gamepad_input(std::span(&held, 1), {}, kDt_s));
}

TEST(GamepadInput, SeveralPadsActAsOneThatIsNoFaster) {
    const std::array before{at_rest(), Gamepad{}, at_rest()};
    const std::array now{walking(0.0f, -1.0f), Gamepad{}, holding(PadButton::start)};
    const GameInput both = gamepad_input(before, now, kDt_s);
    EXPECT_EQ(both.forward, 1.0);
    EXPECT_TRUE(both.toggle_pause);
    const std::array twice{walking(0.0f, -1.0f), walking(0.0f, -1.0f)};
    EXPECT_EQ(gamepad_input({}, twice, kDt_s).forward, 1.0);
    const std::array apart{walking(0.0f, -1.0f), walking(0.0f, 1.0f)};
    EXPECT_EQ(gamepad_input({}, apart, kDt_s).forward, 0.0);
}

TEST(GamepadInput, PadAndKeysTogetherAddUpToAtMostOne) {
    const GameInput keys{.forward = 1.0, .yaw_rad = 0.1, .run = true};
    const GameInput pad{.forward = 0.5, .right = -0.5, .yaw_rad = 0.2, .restart = true};
    const GameInput both = together(keys, pad);
    EXPECT_EQ(both.forward, 1.0);
    EXPECT_EQ(both.right, -0.5);
    EXPECT_DOUBLE_EQ(both.yaw_rad, 0.3);
    EXPECT_TRUE(both.run && both.restart);
    EXPECT_FALSE(both.toggle_pause);
}

}  // namespace
}  // namespace gnomon::game
