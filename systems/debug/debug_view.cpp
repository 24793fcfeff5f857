#include "systems/debug/debug_view.h"

#include <algorithm>
#include <iterator>

namespace gnomon::debug {
namespace {

constexpr ViewRow kRows[] = {
    {"cascades", true, ViewMedium::lookups, "which map of a light serves which pixel, in colours",
     "debug/cascades.frag", draw_cascades},
    {"depth", true, ViewMedium::flat,
     "a light's depth maps: black is near, white far, by distance in metres; blue holds nothing", "debug/depth.frag",
     draw_depth},
};

}  // namespace

std::span<const ViewRow> view_table() { return kRows; }

const ViewRow* find_view(std::string_view name) {
    const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const ViewRow& r) { return r.name == name; });
    return row == std::end(kRows) ? nullptr : row;
}

}  // namespace gnomon::debug
