#include "sample_game/support/settings/light_settings.h"

#include <gmock/gmock.h>

#include <set>

#include "gnomon/light.h"
#include "sample_game/support/settings/setting_parsers.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::game {
namespace {

using ::testing::HasSubstr;

TEST(LightSettings, EveryKeyReadsBackWhatItPrints) {
    const LightSettings odd{
        .source_radius_m = 0.13f,
        .sun_radius_rad = 0.00465f,
        .width_m = 2.5f,
        .height_m = 0.3f,
        .shadow = {.enabled = false,
                   .filter = ShadowFilter::pcf_grid,
                   .antialias = true,
                   .max_error_px = 0.3f,
                   .narrowest_caster_px = 0.6f,
                   .resolution_px = 768,
                   .cascades = 6,
                   .refresh_error_px = 0.7f,
                   .caster_faces = CasterFaces::back,
                   .layers = 0x42,
                   .translucent_casters = false},
        .tuning = {.kernel = {.size_texel = 5,
                              .taps = 9,
                              .spread_texel = 3.3f,
                              .spread_m = 0.07f,
                              .doubles_m = 12.5f,
                              .seed = FilterSeed::screen,
                              .cell_m = 0.3f,
                              .early_bail = true,
                              .penumbra_rays = 7},
                   .moments = {.bits = 16,
                               .exponent = 3.5f,
                               .negative_exponent = 2.5f,
                               .bleeding = 0.35f,
                               .levels = 3,
                               .anisotropy = 8},
                   .bias = {.mode = BiasMode::tutorial_cosine, .offset_m = 0.0125f, .offset_texel = 2.5f},
                   .projection = {.kind = LightProjection::perspective,
                                  .eye_distance_m = 12.3f,
                                  .eye_angle_rad = 0.7f,
                                  .near_m = 0.1f,
                                  .far_m = 333.3f},
                   .cascades = {.fit = ShadowFit::tight,
                                .splits = CascadeSplits::manual,
                                .split_lambda = 0.35f,
                                .split_m = {1.5f, 7.1f, 1e11f},
                                .blend = 0.21f,
                                .warp = 0.75f},
                   .maps = {.depth_format = DepthFormat::d16,
                            .cube_route = CubeRoute::layered_geometry,
                            .multi_draw = false,
                            .short_references = false,
                            .proxies = true},
                   .reuse = {.economy = false, .keep_visibility = false}}};
    LightSettings copy;
    for (const SettingGroup& group : setting_groups())
        for (const LightSetting& setting : group.settings) {
            EXPECT_NE(setting.get(odd), setting.get(LightSettings{})) << setting.key << " is as by default";
            EXPECT_TRUE(setting.set(copy, setting.get(odd))) << setting.key;
        }
    EXPECT_EQ(copy, odd);
}

TEST(LightSettings, AreGroupedWithNoKeyTwiceAndTheAuthorsFirst) {
    constexpr std::size_t kMostInAGroup = 12;
    std::set<std::string> keys, names;
    for (const SettingGroup& group : setting_groups()) {
        EXPECT_TRUE(names.insert(group.name).second) << group.name;
        EXPECT_GE(group.settings.size(), 1u) << group.name;
        EXPECT_LE(group.settings.size(), kMostInAGroup) << group.name;
        for (const LightSetting& setting : group.settings) {
            EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
            EXPECT_EQ(find_setting(setting.key), &setting);
        }
    }
    EXPECT_EQ(find_setting("colour"), nullptr);
    // The first group, and no other, is LightShadow's.
    for (const SettingGroup& group : setting_groups())
        for (const LightSetting& setting : group.settings) {
            LightSettings settings;
            for (const char* odd : {"7", "3", "off", "both", "back", "hard", "screen", "tight", "slope", "d16",
                                    "perspective", "six_passes", "uniform", "16", "on", "0.25", "5,9"})
                if (setting.set(settings, odd) && !(settings == LightSettings{})) break;
            EXPECT_FALSE(settings == LightSettings{}) << setting.key;
            EXPECT_EQ(settings.shadow == LightShadow{}, &group != &setting_groups().front()) << setting.key;
        }
}

TEST(LightSettings, AreListedGroupByGroupAsTheTableHasThem) {
    const std::string text = list_settings();
    std::size_t at = 0;
    const auto expect_next = [&](const std::string& words) {
        const std::size_t found = text.find(words, at);
        ASSERT_NE(found, std::string::npos) << words;
        at = found + words.size();
    };
    for (const SettingGroup& group : setting_groups()) {
        expect_next("\n " + std::string(group.name) + ": " + group.meaning + "\n");
        at -= 1;  // the line's end begins the next
        for (const LightSetting& setting : group.settings) expect_next("\n  " + std::string(setting.key) + " ");
    }
}

class LightSettingsOfALight : public ::testing::Test {
protected:
    void SetUp() override {
        registry.emplace<Light>(light, {.kind = LightKind::spot, .intensity = 7.0f});
        registry.emplace<LightShadow>(light);
    }
    ecs::Registry registry;
    ecs::Entity light = registry.create();
};

TEST_F(LightSettingsOfALight, AreWrittenToTheComponentsThatHoldThemAndReadBack) {
    change_settings(registry, light, [](LightSettings& s) {
        for (const char* text : {"source_radius_m=0.5", "resolution=512", "bias=slope"})
            EXPECT_FALSE(apply_setting(s, text)) << text;
    });
    EXPECT_EQ(registry.get<Light>(light)->source_radius_m, 0.5f);
    EXPECT_EQ(registry.get<Light>(light)->intensity, 7.0f);
    EXPECT_EQ(registry.get<LightShadow>(light)->resolution_px, 512u);
    ASSERT_TRUE(registry.has<ShadowTuning>(light));
    EXPECT_EQ(registry.get<ShadowTuning>(light)->bias.mode, BiasMode::slope);
    const std::optional<LightSettings> read = settings_of(registry, light);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, (LightSettings{.source_radius_m = 0.5f,
                                    .shadow = {.resolution_px = 512},
                                    .tuning = {.bias = {.mode = BiasMode::slope}}}));
    put_settings(registry, light, {});
    EXPECT_EQ(*settings_of(registry, light), LightSettings{});
}

TEST_F(LightSettingsOfALight, WriteNothingThatIsAsItWas) {
    ecs::ChangeCursor shadows, sizes;
    (void)registry.changes<LightShadow>(shadows);
    (void)registry.changes<Light>(sizes);
    change_settings(registry, light, [](LightSettings&) {});
    EXPECT_TRUE(registry.changes<LightShadow>(shadows).entries.empty());
    EXPECT_TRUE(registry.changes<Light>(sizes).entries.empty());
    EXPECT_FALSE(registry.has<ShadowTuning>(light)) << "nobody needs it";
    change_settings(registry, light, [](LightSettings& s) { s.shadow.cascades = 3; });
    EXPECT_EQ(registry.changes<LightShadow>(shadows).entries.size(), 1u) << "the control";
}

TEST_F(LightSettingsOfALight, AreNoneWithoutAShadow) {
    registry.remove<LightShadow>(light);
    EXPECT_FALSE(settings_of(registry, light));
    change_settings(registry, light, [](LightSettings&) { ADD_FAILURE() << "nothing to change"; });
    put_settings(registry, light, {.shadow = {.cascades = 2}});
    ASSERT_TRUE(settings_of(registry, light));
    EXPECT_EQ(settings_of(registry, light)->shadow.cascades, 2u);
}

TEST(LightSettings, EveryFilterOfTheTableCanBeChosen) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        LightSettings settings;
        EXPECT_FALSE(apply_setting(settings, "filter=" + std::string(row.name)));
        EXPECT_EQ(settings.shadow.filter, row.id);
        EXPECT_THAT(list_settings(), HasSubstr(std::string(row.name)));
    }
}

TEST(LightSettings, AWrongValueChangesNothingAndNamesItsRule) {
    const struct {
        const char* text;
        const char* rule;
    } rows[] = {{"filter", "set.syntax"},          {"", "set.syntax"},
                {"colour=red", "set.key"},         {"=hard", "set.key"},
                {"filter=soft", "set.value"},      {"resolution=-1", "set.value"},
                {"resolution=65537", "set.value"}, {"max_error_px=0", "set.value"},
                {"max_error_px=nan", "set.value"}, {"max_error_px=1e-60", "set.value"},
                {"bias=-1", "set.value"},          {"bias=steep", "set.value"},
                {"bias=", "set.value"},            {"bias_m=2e6", "set.value"},
                {"bias_m=-0.1", "set.value"},      {"bias_m=nan", "set.value"},
                {"bias_texel=-1", "set.value"},    {"bias_texel=inf", "set.value"}, {"economy=1", "set.value"},
                {"projection=flat", "set.value"},  {"projection=", "set.value"},
                {"eye_distance_m=-1", "set.value"}, {"eye_angle_deg=0", "set.value"},
                {"eye_angle_deg=161", "set.value"}, {"eye_angle_deg=1e-60", "set.value"},
                {"near_m=-0.1", "set.value"},      {"far_m=inf", "set.value"},
                {"far_m=2e11", "set.value"},       {"near_m=nan", "set.value"},
                {"depth_format=d8", "set.value"},  {"fit=loose", "set.value"},        {"cascades=9", "set.value"},
                {"cascades=-1", "set.value"},      {"splits=some", "set.value"},
                {"split_lambda=1.1", "set.value"}, {"cascade_blend=0.6", "set.value"},
                {"split_m=5,4", "set.value"},      {"split_m=", "set.value"},
                {"split_m=1,2,3,4,5,6,7,8", "set.value"}, {"split_m=1,,2", "set.value"},
                {"caster_faces=inside", "set.value"}, {"layers=256", "set.value"}, {"layers=-1", "set.value"},
                {"filter_size=4", "set.value"},    {"filter_size=33", "set.value"},
                {"filter_taps=0", "set.value"},    {"filter_taps=33", "set.value"},
                {"filter_spread_texel=17", "set.value"}, {"filter_spread_m=-1", "set.value"},
                {"filter_doubles_m=nan", "set.value"}, {"filter_seed=time", "set.value"},
                {"source_radius_m=-1", "set.value"}, {"source_radius_m=1e5", "set.value"},
                {"sun_radius_deg=31", "set.value"}, {"sun_radius_deg=-1", "set.value"},
                {"filter_cell_m=0", "set.value"},  {"early_bail=yes", "set.value"},
                {"moment_bits=24", "set.value"},   {"moment_exponent=85", "set.value"},
                {"moment_exponent=nan", "set.value"}, {"moment_negative_exponent=-1", "set.value"},
                {"moment_bleeding=0.91", "set.value"}, {"moment_bleeding=-0.1", "set.value"},
                {"moment_levels=0", "set.value"},  {"moment_levels=5", "set.value"},
                {"moment_anisotropy=17", "set.value"},
                {"split_m=-1", "set.value"},       {"split_m=1,", "set.value"}};
    for (const auto& row : rows) {
        LightSettings settings;
        const auto error = apply_setting(settings, row.text);
        ASSERT_TRUE(error) << row.text;
        EXPECT_EQ(error->rule, row.rule) << row.text;
        EXPECT_EQ(settings, LightSettings{}) << row.text;
    }
}

TEST(LightSettings, LimitsAreTakenAndTheErrorOfMoreNamesThem) {
    const struct {
        const char *most, *beyond, *allowed;
    } rows[] = {{"resolution=65536", "resolution=65537", "resolution takes 0 ... 65536 (px)"},
                {"cascades=8", "cascades=9", "cascades takes 0 ... 8"},
                {"layers=255", "layers=256", "layers takes 0 ... 255"},
                {"filter_size=31", "filter_size=33", "filter_size takes 1 ... 31, odd"},
                {"filter_taps=32", "filter_taps=33", "filter_taps takes 1 ... 32"},
                {"filter_spread_texel=16", "filter_spread_texel=16.5", "filter_spread_texel takes 0 ... 16 (texels)"},
                {"source_radius_m=10000", "source_radius_m=10001", "source_radius_m takes 0 ... 1e4 (m)"},
                {"sun_radius_deg=30", "sun_radius_deg=30.1", "sun_radius_deg takes 0 ... 30 (degrees)"}};
    for (const auto& row : rows) {
        LightSettings settings;
        EXPECT_FALSE(apply_setting(settings, row.most)) << row.most;
        const auto error = apply_setting(settings, row.beyond);
        ASSERT_TRUE(error) << row.beyond;
        EXPECT_THAT(error->message, HasSubstr(row.allowed)) << row.beyond;
    }
}

TEST(LightSettings, AMetreValueSwitchesTheBiasToConstantAndAutomaticSwitchesBack) {
    LightSettings settings;
    EXPECT_FALSE(apply_setting(settings, "bias=0.02"));
    EXPECT_EQ(settings.tuning.bias.mode, BiasMode::constant);
    EXPECT_FLOAT_EQ(settings.tuning.bias.offset_m, 0.02f);
    EXPECT_FALSE(apply_setting(settings, "bias=automatic"));
    EXPECT_EQ(settings.tuning.bias.mode, BiasMode::automatic);
}

TEST(LightSettings, EveryBiasModeHasAWordAndKeepsItsNumbers) {
    for (std::size_t mode = 0; mode < static_cast<std::size_t>(BiasMode::count); ++mode) {
        LightSettings settings{.tuning = {.bias = {.offset_m = 0.5f, .offset_texel = 3.0f}}};
        const std::string name(word<BiasMode>(mode));
        EXPECT_FALSE(apply_setting(settings, "bias=" + name)) << name;
        const ShadowTuning::Bias wanted{.mode = static_cast<BiasMode>(mode), .offset_m = 0.5f, .offset_texel = 3.0f};
        EXPECT_EQ(settings, (LightSettings{.tuning = {.bias = wanted}}));
        EXPECT_THAT(list_settings(), HasSubstr(name));
    }
}

}  // namespace
}  // namespace gnomon::game
