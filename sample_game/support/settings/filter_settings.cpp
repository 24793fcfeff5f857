#include "sample_game/support/settings/filter_settings.h"

#include <algorithm>

#include "sample_game/support/settings/setting_parsers.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::game {
namespace {

std::string taps_text(const shadow::FilterRow& row) {
    const ShadowTuning::Kernel usual;
    const std::uint32_t flat = row.taps(usual, false), cube = row.taps(usual, true);
    std::string text = std::to_string(flat) + (flat == 1 ? " tap" : " taps");
    if (cube != flat) text += ", " + std::to_string(cube) + " of a cube";
    return text;
}

const char* sampler_text(shadow::MapReading reading) {
    if (reading == shadow::MapReading::depths) return "depth, read as it is";
    if (reading == shadow::MapReading::moments) return "moments, linear sampler";
    return reading == shadow::MapReading::compare_linear ? "depth, linear sampler" : "depth, nearest sampler";
}

}  // namespace

bool set_filter(LightSettings& settings, std::string_view text) {
    const shadow::FilterRow* row = shadow::find_filter(text);
    if (!row && text != kAutomatic) return false;
    settings.shadow.filter = row ? row->id : ShadowFilter::automatic;
    return true;
}
std::string get_filter(const LightSettings& settings) {
    const bool chosen = settings.shadow.filter == ShadowFilter::automatic;
    return std::string(chosen ? kAutomatic : shadow::filter_row(settings.shadow.filter).name);
}
std::string_view filter_name(std::size_t index) {
    const auto rows = shadow::filter_table();
    if (index == 0) return kAutomatic;
    return index <= rows.size() ? rows[index - 1].name : std::string_view{};
}

std::string filter_names() {
    std::string names(kAutomatic);
    for (const shadow::FilterRow& row : shadow::filter_table()) names += " | " + std::string(row.name);
    return names;
}

std::string list_filters() {
    constexpr std::size_t kNameWidth = 20;
    constexpr std::uint32_t kUsualMap_px = 2048;
    std::string text = "Filters (taps and half-width E as the defaults have it):\n";
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        std::string name(row.name);
        name.resize(std::max(kNameWidth, name.size()), ' ');
        if (row.rays) {
            text += "  " + name + (row.rays->per_source ? "rays to the source" : "a ray") +
                    " for each pixel of which its map is not certain\n";
            continue;
        }
        text += "  " + name + taps_text(row) + ", E " +
                number_text(shadow::filter_settings(row, LightItem{}, kUsualMap_px).widest_texel) + " texels, " +
                sampler_text(row.reading) + "\n";
    }
    return text;
}

}  // namespace gnomon::game
