#include "sample_game/support/settings/light_settings.h"

#include <gmock/gmock.h>

#include "sample_game/support/settings/setting_parsers.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::game {
namespace {

using ::testing::HasSubstr;

TEST(LightSettings, EveryKeyReadsBackWhatItPrints) {
    LightShadow odd{.enabled = false,
                    .filter = ShadowFilter::pcf_grid,
                    .filter_size = 5,
                    .filter_taps = 9,
                    .filter_spread_texel = 3.3f,
                    .filter_spread_m = 0.07f,
                    .filter_doubles_m = 12.5f,
                    .filter_seed = FilterSeed::screen,
                    .filter_cell_m = 0.3f,
                    .moment_bits = 16,
                    .moment_exponent = 3.5f,
                    .moment_negative_exponent = 2.5f,
                    .moment_bleeding = 0.35f,
                    .moment_levels = 3,
                    .moment_anisotropy = 8,
                    .source_radius_m = 0.13f,
                    .sun_radius_rad = 0.00465f,
                    .penumbra_rays = 7,
                    .early_bail = true,
                    .resolution_px = 768,
                    .max_error_px = 0.3f,
                    .refresh_error_px = 0.7f,
                    .bias = BiasMode::tutorial_cosine,
                    .bias_m = 0.0125f,
                    .bias_texel = 2.5f,
                    .projection = LightProjection::perspective,
                    .eye_distance_m = 12.3f,
                    .eye_angle_rad = 0.7f,
                    .near_m = 0.1f,
                    .far_m = 333.3f,
                    .cube_route = CubeRoute::layered_geometry,
                    .depth_format = DepthFormat::d16,
                    .fit = ShadowFit::quantised,
                    .cascades = 6,
                    .splits = CascadeSplits::manual,
                    .split_lambda = 0.35f,
                    .split_m = {1.5f, 7.1f, 1e11f},
                    .cascade_blend = 0.21f,
                    .warp = 0.75f,
                    .caster_faces = CasterFaces::back,
                    .layers = 0x42,
                    .economy = false};
    LightShadow copy;
    for (const LightSetting& setting : light_settings())
        EXPECT_TRUE(setting.set(copy, setting.get(odd))) << setting.key;
    EXPECT_EQ(copy, odd);
}

TEST(LightSettings, EveryFilterOfTheTableCanBeChosen) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        LightShadow shadow;
        EXPECT_FALSE(apply_setting(shadow, "filter=" + std::string(row.name)));
        EXPECT_EQ(shadow.filter, row.id);
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
        LightShadow shadow;
        const auto error = apply_setting(shadow, row.text);
        ASSERT_TRUE(error) << row.text;
        EXPECT_EQ(error->rule, row.rule) << row.text;
        EXPECT_EQ(shadow, LightShadow{}) << row.text;
    }
}

TEST(LightSettings, AMetreValueSwitchesTheBiasToConstantAndAutomaticSwitchesBack) {
    LightShadow shadow;
    EXPECT_FALSE(apply_setting(shadow, "bias=0.02"));
    EXPECT_EQ(shadow.bias, BiasMode::constant);
    EXPECT_FLOAT_EQ(shadow.bias_m, 0.02f);
    EXPECT_FALSE(apply_setting(shadow, "bias=automatic"));
    EXPECT_EQ(shadow.bias, BiasMode::automatic);
}

TEST(LightSettings, EveryBiasModeHasAWordAndKeepsItsNumbers) {
    for (std::size_t mode = 0; mode < static_cast<std::size_t>(BiasMode::count); ++mode) {
        LightShadow shadow{.bias_m = 0.5f, .bias_texel = 3.0f};
        const std::string name(word<BiasMode>(mode));
        EXPECT_FALSE(apply_setting(shadow, "bias=" + name)) << name;
        EXPECT_EQ(shadow, (LightShadow{.bias = static_cast<BiasMode>(mode), .bias_m = 0.5f, .bias_texel = 3.0f}));
        EXPECT_THAT(list_settings(), HasSubstr(name));
    }
}

}  // namespace
}  // namespace gnomon::game
