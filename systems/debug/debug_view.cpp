#include "systems/debug/debug_view.h"

#include <algorithm>
#include <iterator>

namespace gnomon::debug {
namespace {

constexpr auto kFlat = ViewMedium::flat, kLines = ViewMedium::lines, kLookups = ViewMedium::lookups;
constexpr const char* kLineShader = "debug/lines.frag";

constexpr ViewDrawer kCascades{kLookups, "debug/cascades.frag", draw_cascades};
constexpr ViewDrawer kTexels{kLookups, "debug/texels.frag", draw_texels};
constexpr ViewDrawer kBias{kLookups, "debug/bias.frag", draw_bias};
constexpr ViewDrawer kPenumbra{kLookups, "debug/penumbra.frag", draw_penumbra};
constexpr ViewDrawer kFrusta{kLines, kLineShader, draw_frusta};
constexpr ViewDrawer kSets{kLines, kLineShader, draw_sets};
constexpr ViewDrawer kDepth{kFlat, "debug/depth.frag", draw_depth};

constexpr ViewRow kRows[] = {
    {"cascades", true, "which map of a light serves which pixel, in colours", &kCascades},
    {"texels", true, "the texels of a light's maps on the surfaces they serve", &kTexels},
    {"bias", true, "how far the bias moves what is compared with a light's map, in mm", &kBias},
    {"penumbra", true, "how wide the filter blurs the edges of a light's shadows, in mm", &kPenumbra},
    {"frusta", false, "what the maps of a light, or of all, hold, as frames in the world", &kFrusta},
    {"sets", true, "boxes of what a light's shadows may fall on (PSR) and of what may cast them (PSC)", &kSets},
    {"depth", true, "a light's depth maps: black is near, white far, by distance in metres; blue holds nothing",
     &kDepth},
};

}  // namespace

std::span<const ViewRow> view_table() { return kRows; }

const ViewRow* find_view(std::string_view name) {
    const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const ViewRow& r) { return r.name == name; });
    return row == std::end(kRows) ? nullptr : row;
}

}  // namespace gnomon::debug
