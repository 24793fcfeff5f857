#include "sample_game/support/settings/presets.h"

#include <gtest/gtest.h>

#include <set>

#include "sample_game/support/settings/light_settings.h"

namespace gnomon::game {
namespace {

TEST(Presets, AreFastDefaultAndHighAndMadeOfSettingsThatExist) {
    ASSERT_EQ(presets().size(), 3u);
    for (const char* name : {"fast", "default", "high"}) {
        const Preset* preset = find_preset(name);
        ASSERT_TRUE(preset) << name;
        for (const char* setting : preset->settings) {
            LightSettings settings;
            EXPECT_FALSE(apply_setting(settings, setting)) << setting;
            EXPECT_NE(settings, LightSettings{}) << setting << " is the default, and says nothing";
        }
    }
    EXPECT_FALSE(find_preset("faster"));
    EXPECT_FALSE(find_preset(""));
}

TEST(Presets, TheDefaultIsTheComponentsOwn) {
    LightSettings settings;
    apply_preset(*find_preset("default"), settings);
    EXPECT_EQ(settings, LightSettings{});
}

TEST(Presets, OneAfterTheOtherIsAsTheLastAlone) {
    for (const Preset& first : presets())
        for (const Preset& last : presets()) {
            LightSettings both, alone;
            apply_preset(first, both);
            apply_preset(last, both);
            apply_preset(last, alone);
            EXPECT_EQ(both, alone) << first.name << ", " << last.name;
            EXPECT_EQ(preset_of(both), &last);
        }
}

TEST(Presets, LeaveAloneWhatNoneOfThemSets) {
    LightSettings settings;
    ASSERT_FALSE(apply_setting(settings, "max_error_px=3"));
    ASSERT_FALSE(apply_setting(settings, "bias_m=0.25"));
    for (const Preset& preset : presets()) {
        apply_preset(preset, settings);
        EXPECT_EQ(settings.shadow.max_error_px, 3.0f) << preset.name;
        EXPECT_EQ(settings.tuning.bias.offset_m, 0.25f) << preset.name;
        EXPECT_EQ(preset_of(settings), &preset);
    }
}

TEST(Presets, ASettingOfTheirsThatWasChangedIsNoPreset) {
    LightSettings settings;
    EXPECT_EQ(preset_of(settings), find_preset("default"));
    ASSERT_FALSE(apply_setting(settings, "resolution=777"));
    EXPECT_EQ(preset_of(settings), nullptr);
}

TEST(Presets, AreListedWithTheirSettings) {
    const std::string text = list_presets();
    for (const Preset& preset : presets()) {
        EXPECT_NE(text.find(preset.name), std::string::npos);
        for (const char* setting : preset.settings) EXPECT_NE(text.find(setting), std::string::npos) << setting;
    }
}

}  // namespace
}  // namespace gnomon::game
