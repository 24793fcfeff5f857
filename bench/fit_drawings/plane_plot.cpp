#include "bench/fit_drawings/plane_plot.h"

#include <glm/geometric.hpp>

namespace gnomon::bench {
namespace {

constexpr double kLeastGrid_px =
    7.0;  // between two lines of the texel grid, where they do not run parallel in the mean

}  // namespace

int draw_grid(Panel& panel, const MapOutline& map, const glm::dvec2& texels, const std::string& colour) {
    const Points c = map.corners();
    const double width = 0.5 * (glm::distance(c[0], c[1]) + glm::distance(c[3], c[2]));
    int step = 1;
    while (panel.length(width) / texels.x * step < kLeastGrid_px) step *= 2;
    const std::string style = "stroke='" + colour + "' stroke-width='0.4' stroke-opacity='0.6'";
    for (double i = 0.0; i <= texels.x; i += step)
        panel.line(map.at({i / texels.x, 0.0}), map.at({i / texels.x, 1.0}), style);
    for (double i = 0.0; i <= texels.y; i += step)
        panel.line(map.at({0.0, i / texels.y}), map.at({1.0, i / texels.y}), style);
    return step;
}

}  // namespace gnomon::bench
