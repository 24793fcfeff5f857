#include "systems/debug/debug_view.h"

#include <algorithm>
#include <iterator>

namespace gnomon::debug {
namespace {

constexpr auto kOne = ViewScope::one_light, kAll = ViewScope::one_or_all;
constexpr auto kFlat = ViewMedium::flat, kLines = ViewMedium::lines, kLookups = ViewMedium::lookups;
constexpr const char* kLineShader = "debug/lines.frag";

constexpr ViewRow kRows[] = {
    {"cascades", kOne, kLookups, "which map of a light serves which pixel, in colours", "debug/cascades.frag",
     draw_cascades},
    {"texels", kOne, kLookups, "the texels of a light's maps on the surfaces they serve", "debug/texels.frag",
     draw_texels},
    {"bias", kOne, kLookups, "how far the bias moves what is compared with a light's map, in mm", "debug/bias.frag",
     draw_bias},
    {"penumbra", kOne, kLookups, "how wide the filter blurs the edges of a light's shadows, in mm",
     "debug/penumbra.frag", draw_penumbra},
    {"frusta", kAll, kLines, "what the maps of a light, or of all, hold, as frames in the world", kLineShader,
     draw_frusta},
    {"sets", kOne, kLines, "boxes of what a light's shadows may fall on (PSR) and of what may cast them (PSC)",
     kLineShader, draw_sets},
    {"depth", kOne, kFlat, "a light's depth maps: black is near, white far, by distance in metres; blue holds nothing",
     "debug/depth.frag", draw_depth},
};

}  // namespace

std::span<const ViewRow> view_table() { return kRows; }

const ViewRow* find_view(std::string_view name) {
    const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const ViewRow& r) { return r.name == name; });
    return row == std::end(kRows) ? nullptr : row;
}

}  // namespace gnomon::debug
