#include "sample_game/support/settings/setting_uses.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace gnomon::game {
namespace {

const SettingUse& use_of(std::string_view key) {
    for (const PurposeGroup& group : purpose_groups())
        for (const SettingUse& use : group.settings)
            if (key == use.key) return use;
    static const SettingUse kNone{""};
    ADD_FAILURE() << "no group has " << key;
    return kNone;
}

bool is_idle(std::string_view key, LightKind kind, std::initializer_list<const char*> settings = {}) {
    LightSettings light;
    for (const char* setting : settings) EXPECT_FALSE(apply_setting(light, setting)) << setting;
    return !why_idle(use_of(key), light, kind).empty();
}

TEST(SettingUses, HaveEachKeyInOneGroupAndNoOther) {
    std::map<std::string, int> uses;
    for (const PurposeGroup& group : purpose_groups())
        for (const SettingUse& use : group.settings) ++uses[use.key];
    for (const SettingGroup& group : setting_groups())
        for (const LightSetting& setting : group.settings) {
            EXPECT_EQ(uses[setting.key], 1) << setting.key;
            uses.erase(setting.key);
        }
    EXPECT_TRUE(uses.empty()) << uses.begin()->first << " is no key";
}

TEST(SettingUses, StateWhatIsNeededWhereverAKeyMayBeIdle) {
    for (const PurposeGroup& group : purpose_groups())
        for (const SettingUse& use : group.settings)
            EXPECT_EQ(use.works == nullptr, std::string_view(use.needs).empty()) << use.key;
}

TEST(SettingUses, DependOnTheKindOfLight) {
    EXPECT_FALSE(is_idle("cascades", LightKind::directional));
    EXPECT_TRUE(is_idle("cascades", LightKind::spot));
    EXPECT_TRUE(is_idle("cascades", LightKind::directional, {"projection=perspective"}));
    EXPECT_FALSE(is_idle("cube_route", LightKind::point));
    EXPECT_TRUE(is_idle("cube_route", LightKind::spot));
    EXPECT_FALSE(is_idle("source_radius_m", LightKind::point, {"filter=pcss"}));
    EXPECT_TRUE(is_idle("source_radius_m", LightKind::directional, {"filter=pcss"}));
    EXPECT_FALSE(is_idle("sun_radius_deg", LightKind::directional, {"filter=exact_soft"}));
}

TEST(SettingUses, DependOnTheFilterAndOnOtherSettings) {
    EXPECT_FALSE(is_idle("antialias", LightKind::point));
    EXPECT_FALSE(is_idle("antialias", LightKind::spot, {"filter=triangles"}));
    for (const char* filter : {"filter=exact", "filter=exact_soft", "filter=pcss"})
        EXPECT_FALSE(is_idle("antialias", LightKind::point, {filter})) << filter;
    for (const char* filter : {"filter=hard", "filter=pcf_grid", "filter=evsm4", "filter=pcss_moments"})
        EXPECT_TRUE(is_idle("antialias", LightKind::point, {filter})) << filter;
    EXPECT_TRUE(is_idle("filter_size", LightKind::point));
    EXPECT_FALSE(is_idle("filter_size", LightKind::point, {"filter=pcf_grid"}));
    EXPECT_FALSE(is_idle("filter_size", LightKind::point, {"filter=vsm"}));
    EXPECT_FALSE(is_idle("moment_bleeding", LightKind::point, {"filter=pcss_moments"}));
    EXPECT_TRUE(is_idle("moment_bleeding", LightKind::point, {"filter=pcss"}));
    EXPECT_TRUE(is_idle("moment_exponent", LightKind::point, {"filter=moments"}));
    EXPECT_FALSE(is_idle("moment_exponent", LightKind::point, {"filter=evsm2"}));
    EXPECT_TRUE(is_idle("moment_negative_exponent", LightKind::point, {"filter=evsm2"}));
    EXPECT_FALSE(is_idle("moment_negative_exponent", LightKind::point, {"filter=evsm4"}));
    EXPECT_TRUE(is_idle("filter_spread_texel", LightKind::point, {"filter=poisson", "filter_spread_m=0.1"}));
    EXPECT_TRUE(is_idle("bias", LightKind::point, {"filter=exact"}));
    EXPECT_TRUE(is_idle("bias_texel", LightKind::point, {"bias=constant"}));
    EXPECT_FALSE(is_idle("bias_m", LightKind::point, {"bias=constant"}));
    EXPECT_TRUE(is_idle("warp", LightKind::directional));
    EXPECT_FALSE(is_idle("warp", LightKind::directional, {"fit=tight"}));
    EXPECT_TRUE(is_idle("resolution", LightKind::directional, {"enabled=off"}));
    EXPECT_FALSE(is_idle("enabled", LightKind::directional, {"enabled=off"}));
}

TEST(SettingUses, ResetOneGroupAlone) {
    LightSettings light;
    ASSERT_FALSE(apply_setting(light, "resolution=512"));
    ASSERT_FALSE(apply_setting(light, "economy=off"));
    for (const PurposeGroup& group : purpose_groups())
        if (std::string_view(group.name) == "quality") reset_group(group, light);
    EXPECT_EQ(light.shadow.resolution_px, 0u);
    EXPECT_FALSE(light.tuning.reuse.economy);
    EXPECT_FALSE(is_default(*find_setting("economy"), light));
    EXPECT_TRUE(is_default(*find_setting("resolution"), light));
}

}  // namespace
}  // namespace gnomon::game
