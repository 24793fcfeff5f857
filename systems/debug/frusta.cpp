#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "systems/debug/lines.h"
#include "systems/debug/words.h"
#include "systems/extract/volumes.h"

/// Debug view "frusta": volumes of the maps of one light or all, as frames in the world.
namespace gnomon::debug {
namespace {

constexpr glm::vec3 kCameraColour{1.0f};

void add_light(const ViewInput& input, std::uint32_t light, LineDrawing& lines, Legend& legend) {
    const std::vector<std::size_t> views = requested_views(input, light);
    const std::string& name = input.scene.lights[light].name;
    legend.add(name + (views.empty() ? " has " + no_map(input.frame, light) : ": what its maps hold"));
    for (const std::size_t v : views) {
        const shadow::ShadowView& view = input.frame.fitted.views[v];
        const Corners corners = corners_of(view);
        lines.add(corners, map_colour(view.layer));
        legend.add(range_text(view), map_colour(view.layer));
        if (shadow::is_parallel(view)) continue;
        for (std::size_t near = 4; near < corners.size(); ++near)
            lines.add(shadow::apex_ws_m(view), corners[near], map_colour(view.layer));
    }
}

/// Adds the frozen camera's view, up to its farthest receiver.
void add_camera(const ViewInput& input, const ConsumerItem& camera, LineDrawing& lines, Legend& legend) {
    double far_m = camera.near_m;
    for (const glm::dvec3& point : input.frame.sets.receiver_points_ws)
        far_m = std::max(far_m, glm::dot(camera.position_ws_m - point, camera.rotation_ws[2]));
    const bool flat = camera.projection == CameraProjection::orthographic;
    const glm::dvec2 half = half_extent(camera);
    const glm::dvec3 half_right = camera.rotation_ws[0] * half.x, half_up = camera.rotation_ws[1] * half.y;
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double ahead_m = (i & 4) != 0 ? camera.near_m : far_m, wide = flat ? 1.0 : ahead_m;
        corners[i] = camera.position_ws_m - ahead_m * camera.rotation_ws[2] +
                     wide * ((i & 1) != 0 ? half_right : -half_right) + wide * ((i & 2) != 0 ? half_up : -half_up);
    }
    lines.add(corners, kCameraColour);
    legend.add("the camera that shadows are fitted to", kCameraColour);
}

}  // namespace

std::optional<Drawing> draw_frusta(const ViewInput& input) {
    LineDrawing lines(camera_of(input));
    Legend legend(input.area);
    const auto one = requested_light(input);
    if (!one && !input.request.light.empty()) return std::nullopt;
    for (std::uint32_t light = 0; light < input.scene.lights.size(); ++light)
        if (one ? light == *one : input.scene.lights[light].has_shadow) add_light(input, light, lines, legend);
    if (input.fitted) add_camera(input, *input.fitted, lines, legend);
    return Drawing{.lines = lines.take(), .labels = legend.take()};
}

}  // namespace gnomon::debug
