#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "gnomon/frame.h"
#include "gnomon/reason.h"
#include "sample_game/gui/keys.h"
#include "sample_game/support/settings/light_settings.h"
#include "sample_game/support/settings/presets.h"
#include "sample_game/support/settings/reason_rows.h"
#include "sample_game/support/settings/setting_uses.h"
#include "systems/shadow/request/filter_table.h"

/// Prints the program's own tables as JSON: .ci/generate_pages.py fills pages with them.
namespace gnomon::game {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the purpose of a key, and what it needs to have an effect.
std::pair<std::string, std::string> use_of(std::string_view key) {
    for (const PurposeGroup& group : purpose_groups())
        for (const SettingUse& use : group.settings)
            if (key == use.key) return {group.name, use.needs};
    return {};
}

Json settings_json() {
    Json groups = Json::array();
    for (const SettingGroup& group : setting_groups()) {
        Json rows = Json::array();
        for (const LightSetting& s : group.settings) {
            const auto [purpose, needs] = use_of(s.key);
            rows.push_back({{"key", s.key},
                            {"field", s.field},
                            {"values", s.values},
                            {"default", s.get(LightSettings{})},
                            {"meaning", s.meaning},
                            {"purpose", purpose},
                            {"needs", needs}});
        }
        groups.push_back({{"name", group.name}, {"meaning", group.meaning}, {"settings", std::move(rows)}});
    }
    return groups;
}

Json purposes_json() {
    Json purposes = Json::array();
    for (const PurposeGroup& group : purpose_groups())
        purposes.push_back({{"name", group.name}, {"meaning", group.meaning}});
    return purposes;
}

Json presets_json() {
    Json rows = Json::array();
    for (const Preset& preset : presets())
        rows.push_back({{"name", preset.name},
                        {"meaning", preset.meaning},
                        {"settings", std::vector<std::string>(preset.settings.begin(), preset.settings.end())}});
    return rows;
}

Json filters_json() {
    Json rows = Json::array();
    const ShadowTuning::Kernel usual;
    for (const shadow::FilterRow& row : shadow::filter_table())
        rows.push_back({{"name", row.name},
                        {"file", "shaders/" + std::string(row.file)},
                        {"taps", row.taps(usual, false)},
                        {"taps_cube", row.taps(usual, true)},
                        {"reach_texel", row.reach_texel},
                        {"soft", row.width == shadow::FilterWidth::source},
                        {"prefiltered", row.moments != nullptr},
                        {"rays", row.rays != nullptr}});
    return rows;
}

Json reasons_json() {
    Json rows = Json::array();
    for (const ReasonRow& row : reason_rows())
        rows.push_back({{"code", reason_code(row.reason)},
                        {"states", row.states},
                        {"meaning", reason_text(row.reason)},
                        {"cure", row.cure}});
    return rows;
}

Json views_json() {
    Json rows = Json::array();
    for (const debug::ViewRow& row : debug::view_table())
        rows.push_back({{"name", row.name}, {"of_all", !row.needs_light}, {"meaning", row.meaning}});
    return rows;
}

Json keys_json() {
    Json rows = Json::array();
    for (const KeyRow& row : key_table())
        rows.push_back({{"place", kKeyPlaces[static_cast<std::size_t>(row.place)]},
                        {"keys", row.keys},
                        {"gamepad", row.gamepad},
                        {"meaning", row.meaning}});
    return rows;
}

}  // namespace
}  // namespace gnomon::game

int main() {
    using namespace gnomon::game;
    const Json tables = {{"settings", settings_json()}, {"purposes", purposes_json()}, {"presets", presets_json()},
                         {"filters", filters_json()},   {"reasons", reasons_json()},   {"debug_views", views_json()},
                         {"keys", keys_json()}};
    constexpr int kIndent = 1;
    std::printf("%s\n", tables.dump(kIndent).c_str());
    return 0;
}
