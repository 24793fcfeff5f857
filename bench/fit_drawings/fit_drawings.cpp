#include "bench/fit_drawings/fit_drawings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/fit_drawings/cascade_drawing.h"
#include "bench/flicker/flicker.h"
#include "bench/flicker/map_readback.h"
#include "sample_game/support/files/image_files.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

constexpr int kSettlingFrames = 3;

/// Tangents of a point as a perspective view sees it; none behind it.
std::optional<glm::dvec2> tangents(const glm::dvec3& apex, const glm::dmat3& axes, const glm::dvec3& p_ws) {
    const glm::dvec3 p = (p_ws - apex) * axes;
    if (!(p.z < 0.0)) return std::nullopt;
    return glm::dvec2(p.x, p.y) / -p.z;
}

void draw_footprints(Panel& panel, const SceneSnapshot& scene, const shadow::ShadowFrame& frame,
                     const shadow::LightSets& sets, const glm::dvec3& apex, const glm::dmat3& axes) {
    for (const InstanceItem& item : scene.instances) {
        Points box;
        for (const glm::dvec3& p : math::corners(item.bounds_ws))
            if (const auto q = tangents(apex, axes, p)) box.push_back(*q);
        if (box.size() == 8) panel.hull(box, "fill='#000' fill-opacity='0.05' stroke='#999' stroke-width='0.5'");
    }
    std::vector<glm::dvec3> seen;
    const math::Frustum view = consumer_frustum(scene.consumers.front());
    for (std::uint32_t i = 0; i < sets.receivers.count; ++i) {
        const math::Aabb& box = scene.instances[frame.sets.receiver_items[sets.receivers.first + i]].bounds_ws;
        seen.clear();
        (void)math::clip_box(view, box, seen);
        Points points;
        bool before = !seen.empty();
        for (const glm::dvec3& p : seen) {
            const auto q = tangents(apex, axes, p);
            before = before && q;
            if (q) points.push_back(*q);
        }
        if (before) panel.hull(points, "stroke='none' fill-opacity='0.2' fill='#1f6fb2'");
    }
}

std::string draw_spot(const ShadowFrames& frames, std::uint32_t light) {
    const SceneSnapshot& scene = frames.snapshot();
    const shadow::ShadowFrame& frame = frames.frame();
    const LightItem& item = scene.lights[light];
    const std::uint32_t index = views_of(frame, light).front();
    const shadow::ShadowView& view = frame.fitted.views[index];
    const glm::dmat3 axes(view.pose.axis_u, view.pose.axis_v, view.pose.axis_back);
    Svg svg(kSide + 2.0 * kMargin, kSide + kHead + 2.0 * kMargin, "The view of a spot");
    svg.text({kMargin, 20.0}, "spot: its cone, what is seen within it, and the map", "font-size='15'");
    const double rim = std::tan(std::min(item.outer_cone_rad, shadow::kWidestMap_rad));
    {
        Panel panel(svg, {kMargin, kHead}, {glm::dvec2(-rim), glm::dvec2(rim)}, "tangents, as the light sees them");
        draw_footprints(panel, scene, frame, frame.fitted.lights[view.light].sets, shadow::apex_ws_m(view), axes);
        panel.circle({0.0, 0.0}, rim, "fill='none' stroke='#b8860b' stroke-dasharray='5 3' stroke-width='1.5'");
        const glm::dvec2 size = view.plane.tan_high - view.plane.tan_low;
        const MapOutline map{[&](const glm::dvec2& share) { return view.plane.tan_low + size * share; }};
        const int step = draw_grid(panel, map, glm::dvec2(frame.maps[index].size_px), kColours[0]);
        panel.polygon(map.corners(), "fill='none' stroke-width='2' stroke='" + std::string(kColours[0]) + "'");
        svg.text({kMargin, kHead + kSide + 20.0},
                 "dashed: the cone; blue: receivers within the view; red: the map, a line every " +
                     std::to_string(step) + " texels");
    }
    return svg.str();
}

/// Draws the cube's faces, unfolded. Faces with a view are filled and have their number of casters.
std::string draw_point(const ShadowFrames& frames, std::uint32_t light) {
    constexpr double kFace = 150.0;
    // Places of +x -x +y -y +z -z in a cross.
    constexpr std::array<glm::dvec2, 6> kPlaces = {glm::dvec2(2, 1), {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
    constexpr std::array<const char*, 6> kNames = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const SceneSnapshot& scene = frames.snapshot();
    const shadow::ShadowFrame& frame = frames.frame();
    Svg svg(4.0 * kFace + 2.0 * kMargin, 3.0 * kFace + kHead + 2.0 * kMargin, "The views of a point light");
    svg.text({kMargin, 20.0}, "point: faces of the cube; filled are those that are drawn", "font-size='15'");
    const auto views = views_of(frame, light);
    for (std::uint32_t face = 0; face < 6; ++face) {
        const glm::dvec2 low = glm::dvec2(kMargin, kHead) + kPlaces[face] * kFace;
        const auto view = std::find_if(views.begin(), views.end(),
                                       [&](std::uint32_t v) { return frame.fitted.views[v].layer == face; });
        const bool drawn = view != views.end();
        svg.rectangle(low, low + kFace,
                      drawn ? "fill='#c0392b' fill-opacity='0.18' stroke='#c0392b' stroke-width='2'"
                            : "fill='none' stroke='#999' stroke-dasharray='4 3'");
        svg.text(low + glm::dvec2(8.0, 18.0), kNames[face], "font-weight='bold'");
        const std::uint32_t casters = drawn ? frame.fitted.views[*view].casters.count : 0;
        svg.text(low + glm::dvec2(8.0, 36.0), drawn ? std::to_string(casters) + " casters" : "no view", "fill='#444'");
    }
    svg.text({kMargin, 3.0 * kFace + kHead + 20.0}, "light '" + scene.lights[light].name + "'");
    return svg.str();
}

std::optional<Error> write(const std::filesystem::path& file, const std::string& text) {
    return game::write_file(file, std::as_bytes(std::span(text)));
}

/// Returns the first light of the kind with views; empty: none.
std::optional<std::uint32_t> first_of(const ShadowFrames& frames, LightKind kind) {
    for (std::uint32_t l = 0; l < frames.snapshot().lights.size(); ++l)
        if (frames.snapshot().lights[l].kind == kind && !views_of(frames.frame(), l).empty()) return l;
    return std::nullopt;
}

}  // namespace

std::optional<Error> write_drawings(Stage& stage, const std::filesystem::path& folder) {
    const std::vector<std::string> fits = known_fits();
    const auto run = [&](const std::vector<std::string>& settings) -> Result<std::unique_ptr<ShadowFrames>> {
        for (const std::string& setting : settings)
            if (auto error = stage.apply_setting(setting)) return *error;
        auto frames = ShadowFrames::create(stage);
        for (int i = 0; frames && i < kSettlingFrames; ++i)
            if (auto error = frames.value()->run()) return *error;
        return frames;
    };
    for (const std::string& fit : fits) {
        const auto frames = run({"fit=" + fit});
        if (!frames) return frames.error();
        if (const auto sun = first_of(*frames.value(), LightKind::directional))
            if (auto error = write(folder / ("sun_" + fit + ".svg"), SunDrawing(*frames.value(), *sun).cascades(fit)))
                return error;
        if (fit != fits.front()) continue;  // the others do not depend on it
        if (const auto spot = first_of(*frames.value(), LightKind::spot))
            if (auto error = write(folder / "spot.svg", draw_spot(*frames.value(), *spot))) return error;
        if (const auto point = first_of(*frames.value(), LightKind::point))
            if (auto error = write(folder / "point.svg", draw_point(*frames.value(), *point))) return error;
    }
    const auto warped = run({"fit=tight", "cascades=1", "warp=1"});
    if (!warped) return warped.error();
    if (const auto sun = first_of(*warped.value(), LightKind::directional))
        return write(folder / "sun_warp.svg", SunDrawing(*warped.value(), *sun).warp());
    return std::nullopt;
}

}  // namespace gnomon::bench
