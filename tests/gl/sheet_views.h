#pragma once
#include <vector>

#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/sheet_worlds.h"

/// Lights over such worlds, and views of them.
namespace gnomon::test {

/// Returns views of all six faces around a lamp.
inline std::vector<shadow::ShadowView> cube_views(const LightItem& light, const shadow::PerspectiveRange& range,
                                                  std::uint32_t size_px) {
    std::vector<shadow::ShadowView> views;
    const glm::dmat3 turn = glm::mat3_cast(shadow::cube_turn());
    for (std::uint32_t face = 0; face < 6; ++face) {
        const shadow::CubeFace& axes = shadow::cube_face(face);
        const glm::dmat3 turned = turn * glm::dmat3(axes.axis_u, axes.axis_v, axes.axis_back);
        views.push_back(
            shadow::perspective_view(light.position_ws_m, turned, shadow::TangentRectangle{}, range, size_px));
        views.back().projection = shadow::ViewProjection::cube_face;
        views.back().layer = face;
    }
    return views;
}

/// A light and what its maps hold, all of the world or a part of it.
struct View {
    LightItem light;
    std::vector<shadow::ShadowView> views;
    std::uint32_t size_px = 0;
};

inline glm::dvec3 sun_direction(Random& random) {
    if (chance(random, 0.15)) return {0.0, 1.0, 0.0};
    const double turn = between(random, 0.0, 6.3);
    const double up = chance(random, 0.4) ? between(random, 0.005, 0.05) : between(random, 0.05, 3.0);
    return glm::normalize(glm::dvec3(std::cos(turn), up, std::sin(turn)));
}

inline View sun_view(const QueryScene& scene, Random& random, double least_depth_m) {
    View view;
    view.size_px = 64u << random() % 5;
    view.light = scene.sun(sun_direction(random));
    shadow::OrthographicBox box;
    box.axes = view.light.rotation_ws;
    // Where its texels' corners lie on round numbers, so that the edges of boxes run through them.
    box.anchor_ws_m = scene.offset_m + (chance(random, 0.3) ? glm::dvec3(0.0) : point_in(random, 3.0));
    box.half_extent_m = glm::dvec2(chance(random, 0.3) ? 8.0 : between(random, 1.0, 12.0));
    const double depth_m = between(random, least_depth_m, 60.0);
    box.near_m = -depth_m;
    box.far_m = depth_m;
    view.views = {shadow::orthographic_view(box, view.size_px)};
    return view;
}

inline glm::dvec3 lamp_place(Random& random) {
    glm::dvec3 at = point_in(random, 1.2 * kWorld_m);
    at.y = chance(random, 0.2) ? between(random, 0.01, 0.2) : std::abs(at.y);
    return at;
}

inline shadow::PerspectiveRange lamp_range(Random& random) {
    return shadow::perspective_range(std::pow(10.0, between(random, -5.0, -0.5)), between(random, 20.0, 60.0));
}

inline View spot_view(const QueryScene& scene, Random& random) {
    View view;
    view.size_px = 64u << random() % 5;
    const glm::dvec3 at = lamp_place(random);
    const glm::dvec3 toward = 0.5 * point_in(random, kWorld_m) - at;
    view.light = scene.spot(at, -toward, 1.5);
    const double tangent = between(random, 0.2, 1.2);
    const glm::dvec2 middle(between(random, -0.2, 0.2), between(random, -0.2, 0.2));
    view.views = {shadow::perspective_view(view.light.position_ws_m, view.light.rotation_ws,
                                           {middle - tangent, middle + tangent}, lamp_range(random), view.size_px)};
    return view;
}

inline View point_view(const QueryScene& scene, Random& random) {
    View view;
    view.size_px = 64u << random() % 4;
    view.light = scene.lamp(lamp_place(random));
    view.views = cube_views(view.light, lamp_range(random), view.size_px);
    return view;
}

/// Returns a random light of this kind, and its views. `least_depth_m`: depth of a sun's map, to either side, at least.
inline View view_of(LightKind kind, const QueryScene& scene, Random& random, double least_depth_m = 12.0) {
    if (kind == LightKind::directional) return sun_view(scene, random, least_depth_m);
    return kind == LightKind::spot ? spot_view(scene, random) : point_view(scene, random);
}

/// Returns whether any of the maps shows the place.
inline bool is_shown(const std::vector<shadow::ShadowView>& views, const glm::dvec3& at_ws_m) {
    return std::any_of(views.begin(), views.end(), [&](const shadow::ShadowView& view) {
        const glm::dvec4 p = glm::dmat4(view.clip_from_anchor) * glm::dvec4(at_ws_m - view.pose.anchor_ws_m, 1.0);
        return p.w > 0.0 && std::max(std::abs(p.x), std::abs(p.y)) <= p.w && p.z >= 0.0 && p.z <= p.w;
    });
}

}  // namespace gnomon::test
