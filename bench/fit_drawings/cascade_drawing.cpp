#include "bench/fit_drawings/cascade_drawing.h"

#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/fitting/directional/slice_sphere.h"
#include "systems/shadow/projection/lispsm_math.h"

namespace gnomon::bench {
namespace {

constexpr double kCentimetres = 100.0;
constexpr double kLine = 18.0;  // from one line of words to the next
constexpr double kHeight = kSide + kHead + 2.0 * kMargin + 20.0, kWidth = 2.0 * kSide + 3.0 * kMargin;
const glm::dvec2 kLeft{kMargin, kHead}, kRight{2.0 * kMargin + kSide, kHead};

const char* colour_of(const shadow::ShadowView& view) { return kColours[view.layer % kColours.size()]; }
std::string strong(const shadow::ShadowView& view) {
    return "fill='none' stroke-width='2' stroke='" + std::string(colour_of(view)) + "'";
}

glm::dvec2 below(const glm::dvec2& panel, int lines) { return panel + glm::dvec2(0.0, kSide + 20.0 + kLine * lines); }

std::string grid_words(int step) { return "grid: a line every " + std::to_string(step) + " texels; "; }

Points projected(std::span<const glm::dvec3> points_ws,
                 const std::function<glm::dvec2(const glm::dvec3&)>& projection) {
    Points points;
    for (const glm::dvec3& p : points_ws) points.push_back(projection(p));
    return points;
}

std::vector<glm::dvec3> corners_of(const ConsumerItem& c) {
    std::vector<glm::dvec3> corners;
    const bool flat_view = c.projection == CameraProjection::orthographic;
    for (const double z : {c.near_m, c.far_m})
        for (const glm::dvec2 side : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            const double half_y = half_extent(c).y * (flat_view ? 1.0 : z);
            corners.push_back(c.position_ws_m - c.rotation_ws[2] * z +
                              c.rotation_ws[0] * (side.x * half_y * aspect(c)) + c.rotation_ws[1] * (side.y * half_y));
        }
    return corners;
}

/// Returns a place of the map's warped plane, given as shares of the map.
glm::dvec2 at_share(const shadow::ShadowView& v, const glm::dvec2& share) {
    return v.plane.centre_ls_m + v.plane.half_extent_m * (2.0 * share - 1.0);
}

/// Returns the shortest and longest diagonal of a texel at a corner of the map, metres across the light.
glm::dvec2 diagonals_m(const shadow::ShadowView& v) {
    glm::dvec2 range(INFINITY, 0.0);
    for (const glm::dvec2 share : {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        const glm::dvec2 p = shadow::unwarped(v.plane.warp, at_share(v, share));
        const double length = glm::length(shadow::unwarped_step(v.plane.warp, p, {v.plane.texel_u, v.plane.texel_v}));
        range = {std::min(range.x, length), std::max(range.y, length)};
    }
    return range;
}

}  // namespace

std::vector<std::uint32_t> views_of(const shadow::ShadowFrame& frame, std::uint32_t light) {
    std::vector<std::uint32_t> views;
    for (std::uint32_t v = 0; v < frame.fitted.views.size(); ++v)
        if (frame.fitted.views[v].light == light) views.push_back(v);
    return views;
}

SunDrawing::SunDrawing(const ShadowFrames& frames, std::uint32_t light)
    : scene_(frames.snapshot()),
      frame_(frames.frame()),
      camera_(scene_.consumers.front()),
      basis_(math::basis_from_back(scene_.lights[light].rotation_ws[2])),
      views_(views_of(frame_, light)) {}

std::string SunDrawing::cascades(const std::string& fit) const {
    Svg svg(kWidth, kHeight, "Cascades of a sun, fit " + fit);
    Points all, first = outline(frame_.fitted.views[views_.front()]).corners();
    for (const std::uint32_t v : views_)
        for (const glm::dvec2& p : outline(frame_.fitted.views[v]).corners()) all.push_back(p);
    svg.text({kMargin, 20.0}, "fit " + fit + ": what the camera sees, and the maps, looking along the light",
             "font-size='15'");
    const bool spheres = fit == "stable";
    (void)draw_cascades(svg, kLeft, all, false, spheres);
    const std::string grid = draw_cascades(svg, kRight, first, true, spheres);
    svg.text(below(kLeft, 0), "grey: meshes' boxes; dashed: slices of the view; filled: receivers in them");
    svg.text(below(kLeft, 1), spheres ? "circles: spheres around the slices; strong: maps" : "strong: maps");
    svg.text(below(kRight, 0), grid);
    return svg.str();
}

std::string SunDrawing::warp() const {
    const std::size_t last = views_.size() - 1;
    const shadow::ShadowView& view = frame_.fitted.views[views_[last]];
    const glm::dvec2 size_px(frame_.maps[views_[last]].size_px);
    const Projection across = [this](const glm::dvec3& p) { return flat(p); };
    const Projection in_map = [&view](const glm::dvec3& p) {
        const glm::dvec3 from_anchor = p - view.pose.anchor_ws_m;
        const glm::dvec2 q(glm::dot(from_anchor, view.pose.axis_u), glm::dot(from_anchor, view.pose.axis_v));
        return shadow::warped(view.plane.warp, q);
    };
    const MapOutline map{[&view](const glm::dvec2& share) { return at_share(view, share); }};
    Svg svg(kWidth, kHeight, "A warped map of a sun");
    svg.text({kMargin, 20.0}, "warp: the same across the light and in the map, looking along the light",
             "font-size='15'");
    int step = 0;
    {
        Points shown = outline(view).corners();
        shown.push_back(flat(camera_.position_ws_m));
        Panel panel(svg, kLeft, shown, "across the light");
        draw_boxes(panel);
        draw_slice(panel, last, across);
        step = draw_grid(panel, outline(view), size_px, colour_of(view));
        panel.polygon(outline(view).corners(), strong(view));
        draw_camera(panel);
    }
    {
        Panel panel(svg, kRight, map.corners(), "in the map");
        draw_slice(panel, last, in_map);
        (void)draw_grid(panel, map, size_px, colour_of(view));
        panel.polygon(map.corners(), strong(view));
    }
    const glm::dvec2 diagonal_m = diagonals_m(view);
    svg.text(below(kLeft, 0), "grey: meshes' boxes; dashed: the view; filled: hull of the receivers in it");
    svg.text(below(kLeft, 1), "strong: the map");
    svg.text(below(kRight, 0), grid_words(step) + "a texel's diagonal is " + short_number(kCentimetres * diagonal_m.x) +
                                   " to " + short_number(kCentimetres * diagonal_m.y) + " cm");
    return svg.str();
}

/// Projects a point along the light, metres from the camera.
glm::dvec2 SunDrawing::flat(const glm::dvec3& p_ws) const {
    const glm::dvec3 p = (p_ws - camera_.position_ws_m) * basis_;
    return {p.x, p.y};
}

MapOutline SunDrawing::outline(const shadow::ShadowView& v) const {
    return {[this, &v](const glm::dvec2& share) {
        const glm::dvec2 p = shadow::unwarped(v.plane.warp, at_share(v, share));
        return flat(v.pose.anchor_ws_m + v.pose.axis_u * p.x + v.pose.axis_v * p.y);
    }};
}

/// Returns the part of the camera's view that the cascade serves.
ConsumerItem SunDrawing::slice(std::size_t i) const {
    ConsumerItem c = camera_;
    double farthest_m = 0.0;
    for (const glm::dvec3& p : frame_.sets.receiver_points_ws)
        farthest_m = std::max(farthest_m, -glm::dot(p - c.position_ws_m, c.rotation_ws[2]));
    c.near_m = std::max(frame_.fitted.views[views_[i]].cascade.seen_from_m, camera_.near_m);
    const double given_m = frame_.fitted.views[views_[i]].cascade.seen_to_m;
    const double next_m = i + 1 < views_.size() ? frame_.fitted.views[views_[i + 1]].cascade.seen_from_m : farthest_m;
    c.far_m = given_m > 0.0 ? given_m : next_m;
    c.far_m = std::max(c.far_m, c.near_m * (1.0 + 1e-9));
    return c;
}

std::vector<glm::dvec3> SunDrawing::receivers_in(const ConsumerItem& part) const {
    std::vector<glm::dvec3> points;
    const math::Frustum frustum = consumer_frustum(part);
    for (const std::uint32_t i : frame_.sets.receiver_items)
        (void)math::clip_box(frustum, scene_.instances[i].bounds_ws, points);
    return points;
}

void SunDrawing::draw_boxes(Panel& panel) const {
    for (const InstanceItem& item : scene_.instances) {
        const auto box = math::corners(item.bounds_ws);
        panel.hull(projected(box, [this](const glm::dvec3& p) { return flat(p); }),
                   "fill='#000' fill-opacity='0.05' stroke='#999' stroke-width='0.5'");
    }
}

void SunDrawing::draw_camera(Panel& panel) const {
    panel.dot(flat(camera_.position_ws_m), "fill='#000'");
    panel.text(flat(camera_.position_ws_m), "camera");
}

/// Draws the end of a cascade's slice, and the receivers there.
void SunDrawing::draw_slice(Panel& panel, std::size_t cascade, const Projection& projection) const {
    const std::string colour = colour_of(frame_.fitted.views[views_[cascade]]);
    const ConsumerItem part = slice(cascade);
    panel.hull(projected(receivers_in(part), projection), "stroke='none' fill-opacity='0.25' fill='" + colour + "'");
    panel.hull(projected(corners_of(part), projection), "fill='none' stroke-dasharray='5 3' stroke='" + colour + "'");
}

/// Draws all cascades, or with `near` the first alone with its texels. Returns a sentence with their number.
std::string SunDrawing::draw_cascades(Svg& svg, const glm::dvec2& corner, const Points& shown, bool near,
                                      bool spheres) const {
    Panel panel(svg, corner, shown, near ? "the first cascade that is drawn" : "all cascades");
    draw_boxes(panel);
    std::string words;
    for (std::size_t i = near ? 1 : views_.size(); i-- > 0;) {
        const shadow::ShadowView& view = frame_.fitted.views[views_[i]];
        draw_slice(panel, i, [this](const glm::dvec3& p) { return flat(p); });
        if (spheres) {
            const ConsumerItem part = slice(i);
            const shadow::SliceSphere sphere = shadow::slice_sphere(camera_, part.near_m, part.far_m);
            panel.circle(flat(camera_.position_ws_m - camera_.rotation_ws[2] * sphere.centre_m), sphere.radius_m,
                         "fill='none' stroke='" + std::string(colour_of(view)) + "'");
        }
        panel.polygon(outline(view).corners(), strong(view));
        if (!near) continue;
        const glm::dvec2 size_px(frame_.maps[views_[i]].size_px);
        words = grid_words(draw_grid(panel, outline(view), size_px, colour_of(view))) + "a texel is " +
                short_number(kCentimetres * view.plane.texel_u) + " x " +
                short_number(kCentimetres * view.plane.texel_v) + " cm";
    }
    draw_camera(panel);
    return words;
}

}  // namespace gnomon::bench
