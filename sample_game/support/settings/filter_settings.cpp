#include "sample_game/support/settings/filter_settings.h"

#include <algorithm>

#include "gnomon/light.h"
#include "sample_game/inside/filter_figures.h"
#include "sample_game/support/settings/setting_parsers.h"

namespace gnomon::game {
namespace {

constexpr auto kFilters = static_cast<std::size_t>(ShadowFilter::count);

std::string taps_text(const FilterFigures& figures) {
    std::string text = std::to_string(figures.taps) + (figures.taps == 1 ? " tap" : " taps");
    if (figures.cube_taps != figures.taps) text += ", " + std::to_string(figures.cube_taps) + " of a cube";
    return text;
}

}  // namespace

bool set_filter(LightSettings& settings, std::string_view text) {
    for (std::size_t i = 0; i <= kFilters; ++i) {
        if (text != filter_name(i)) continue;
        settings.shadow.filter = i == 0 ? ShadowFilter::automatic : static_cast<ShadowFilter>(i - 1);
        return true;
    }
    return false;
}
std::string get_filter(const LightSettings& settings) { return to_text(settings.shadow.filter); }
std::string_view filter_name(std::size_t index) {
    if (index == 0) return kAutomatic;
    return index <= kFilters ? to_text(static_cast<ShadowFilter>(index - 1)) : std::string_view{};
}

std::string filter_names() {
    std::string names(kAutomatic);
    for (std::size_t i = 1; i <= kFilters; ++i) names += " | " + std::string(filter_name(i));
    return names;
}

std::string list_filters() {
    constexpr std::size_t kNameWidth = 20;
    std::string text = "Filters (taps and half-width E as the defaults have it):\n";
    for (std::size_t i = 0; i < kFilters; ++i) {
        const FilterFigures figures = figures_of(static_cast<ShadowFilter>(i));
        std::string name = to_text(static_cast<ShadowFilter>(i));
        name.resize(std::max(kNameWidth, name.size()), ' ');
        if (figures.rays != FilterRays::none) {
            text += "  " + name + (figures.rays == FilterRays::to_source ? "rays to the source" : "a ray") +
                    " for each pixel of which its map is not certain\n";
            continue;
        }
        text += "  " + name + taps_text(figures) + ", E " + number_text(figures.widest_texel) + " texels, " +
                figures.sampler + "\n";
    }
    return text;
}

}  // namespace gnomon::game
