#include "bench/drawings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "bench/stability.h"
#include "bench/stability_scene.h"
#include "bench/svg.h"
#include "engine/math/convex_polygon.h"
#include "sample_game/picture_files.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/kinds/slice_sphere.h"
#include "systems/shadow/light_kinds.h"

namespace gnomon::bench {
namespace {

using Points = std::vector<glm::dvec2>;

constexpr int kSettlingFrames = 3;
constexpr double kMargin = 24.0, kSide = 460.0, kHead = 52.0;  // of a panel, in pixels of the drawing
constexpr double kCentimetres = 100.0;
constexpr double kLeastGrid_px = 7.0;  // between two lines of the texel grid
constexpr std::array<const char*, 8> kColours = {"#c0392b", "#1f6fb2", "#2e8b57", "#8e44ad",
                                                 "#b8860b", "#16a2a2", "#7f5539", "#555555"};

/// A square part of a plane, drawn as a square; y up.
class Panel {
public:
    Panel(Svg& svg, const glm::dvec2& corner, const Points& shown, const std::string& title)
        : svg_(svg), corner_(corner) {
        glm::dvec2 low(INFINITY), high(-INFINITY);
        for (const glm::dvec2& p : shown) low = glm::min(low, p), high = glm::max(high, p);
        constexpr double kAir = 1.08;
        middle_ = 0.5 * (low + high);
        scale_ = kSide / (kAir * std::max({high.x - low.x, high.y - low.y, 1e-300}));
        svg_.text({corner_.x, corner_.y - 8.0}, title, "font-weight='bold'");
        svg_.open_clip(corner_, corner_ + kSide);
    }
    ~Panel() {
        svg_.close_clip();
        svg_.rectangle(corner_, corner_ + kSide, "fill='none' stroke='#999'");
    }
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    glm::dvec2 at(const glm::dvec2& p) const {
        const glm::dvec2 q = (p - middle_) * scale_;
        return corner_ + glm::dvec2(0.5 * kSide + q.x, 0.5 * kSide - q.y);
    }
    double length(double plane_length) const { return plane_length * scale_; }
    void polygon(const Points& corners, const std::string& style) {
        Points moved;
        for (const glm::dvec2& p : corners) moved.push_back(at(p));
        svg_.polygon(moved, style);
    }
    void hull(Points points, const std::string& style) {
        Points corners;
        math::convex_hull(points, corners);
        polygon(corners, style);
    }
    void line(const glm::dvec2& a, const glm::dvec2& b, const std::string& style) { svg_.line(at(a), at(b), style); }
    void circle(const glm::dvec2& centre, double radius, const std::string& style) {
        svg_.circle(at(centre), length(radius), style);
    }
    void dot(const glm::dvec2& p, const std::string& style) { svg_.circle(at(p), 4.0, style); }
    void text(const glm::dvec2& p, const std::string& words, const std::string& style) {
        svg_.text(at(p) + glm::dvec2(6.0, -6.0), words, style);
    }

private:
    Svg& svg_;
    glm::dvec2 corner_, middle_{0.0};
    double scale_ = 1.0;
};

/// Four corners and two sides, in some plane.
struct Parallelogram {
    glm::dvec2 corner, u, v;
    Points corners() const { return {corner, corner + u, corner + u + v, corner + v}; }
};

/// Lines every so many texels that they can be told apart; says how many.
int draw_grid(Panel& panel, const Parallelogram& map, const glm::dvec2& texels, const std::string& colour) {
    int step = 1;
    while (panel.length(glm::length(map.u)) / texels.x * step < kLeastGrid_px) step *= 2;
    const std::string style = "stroke='" + colour + "' stroke-width='0.4' stroke-opacity='0.6'";
    for (double i = 0.0; i <= texels.x; i += step) {
        const glm::dvec2 a = map.corner + map.u * (i / texels.x);
        panel.line(a, a + map.v, style);
    }
    for (double i = 0.0; i <= texels.y; i += step) {
        const glm::dvec2 a = map.corner + map.v * (i / texels.y);
        panel.line(a, a + map.u, style);
    }
    return step;
}

std::vector<std::uint32_t> views_of(const shadow::ShadowFrame& frame, std::uint32_t light) {
    std::vector<std::uint32_t> views;
    for (std::uint32_t v = 0; v < frame.views.size(); ++v)
        if (frame.demands[frame.views[v].demand].light == light) views.push_back(v);
    return views;
}

/// A sun's fit, seen along the light.
class SunDrawing {
public:
    SunDrawing(const ShadowFrames& frames, std::uint32_t light)
        : scene_(frames.snapshot()),
          frame_(frames.frame()),
          camera_(scene_.consumers.front()),
          basis_(math::basis_from_back(scene_.lights[light].rotation_ws[2])),
          views_(views_of(frame_, light)) {}

    std::string draw(const std::string& fit) {
        Svg svg(2.0 * kSide + 3.0 * kMargin, kSide + kHead + 2.0 * kMargin + 20.0, "Cascades of a sun, fit " + fit);
        Points all, first;
        for (const std::uint32_t v : views_)
            for (const glm::dvec2& p : map_of(frame_.views[v]).corners())
                (v == views_.front() ? first : all).push_back(p);
        all.insert(all.end(), first.begin(), first.end());
        svg.text({kMargin, 20.0}, "fit " + fit + ": what the camera sees, and the maps, looking along the light",
                 "font-size='15'");
        const bool spheres = fit == "stable";
        (void)draw_panel(svg, {kMargin, kHead}, all, "all cascades", false, spheres);
        const std::string grid =
            draw_panel(svg, {2.0 * kMargin + kSide, kHead}, first, "the first cascade that is drawn", true, spheres);
        svg.text({kMargin, kHead + kSide + 20.0},
                 "grey: meshes' boxes; dashed: slices of the view; filled: receivers in them");
        svg.text({kMargin, kHead + kSide + 38.0},
                 spheres ? "circles: spheres around the slices; strong: maps" : "strong: maps");
        svg.text({2.0 * kMargin + kSide, kHead + kSide + 20.0}, grid);
        return svg.str();
    }

private:
    glm::dvec2 flat(const glm::dvec3& p_ws) const {
        const glm::dvec3 p = (p_ws - camera_.position_ws_m) * basis_;
        return {p.x, p.y};
    }
    Points flat(std::span<const glm::dvec3> points_ws) const {
        Points points;
        for (const glm::dvec3& p : points_ws) points.push_back(flat(p));
        return points;
    }
    Parallelogram map_of(const shadow::ShadowView& v) const {
        const glm::dvec3 low = v.anchor_ws_m + v.axis_u * (v.centre_ls_m.x - v.half_extent_m.x) +
                               v.axis_v * (v.centre_ls_m.y - v.half_extent_m.y);
        const glm::dvec2 corner = flat(low);
        return {corner, flat(low + v.axis_u * (2.0 * v.half_extent_m.x)) - corner,
                flat(low + v.axis_v * (2.0 * v.half_extent_m.y)) - corner};
    }

    /// The part of the view that cascade `i` serves.
    ConsumerItem slice(std::size_t i) const {
        ConsumerItem c = camera_;
        double farthest_m = 0.0;
        for (const glm::dvec3& p : frame_.receiver_points_ws)
            farthest_m = std::max(farthest_m, -glm::dot(p - c.position_ws_m, c.rotation_ws[2]));
        c.near_m = std::max(frame_.views[views_[i]].seen_from_m, camera_.near_m);
        const double given_m = frame_.views[views_[i]].seen_to_m;
        const double next_m = i + 1 < views_.size() ? frame_.views[views_[i + 1]].seen_from_m : farthest_m;
        c.far_m = given_m > 0.0 ? given_m : next_m;
        c.far_m = std::max(c.far_m, c.near_m * (1.0 + 1e-9));
        return c;
    }
    static std::vector<glm::dvec3> corners_of(const ConsumerItem& c) {
        std::vector<glm::dvec3> corners;
        const bool flat_view = c.projection == CameraProjection::orthographic;
        for (const double z : {c.near_m, c.far_m})
            for (const glm::dvec2 side : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const double half_y = flat_view ? c.half_height_m : z * std::tan(0.5 * c.fov_y_rad);
                corners.push_back(c.position_ws_m - c.rotation_ws[2] * z +
                                  c.rotation_ws[0] * (side.x * half_y * aspect(c)) +
                                  c.rotation_ws[1] * (side.y * half_y));
            }
        return corners;
    }
    std::vector<glm::dvec3> receivers_in(const ConsumerItem& part) const {
        std::vector<glm::dvec3> points;
        const math::Frustum frustum = consumer_frustum(part);
        for (const std::uint32_t i : frame_.receiver_items)
            (void)math::clip_box(frustum, scene_.instances[i].bounds_ws, points);
        return points;
    }

    /// What the panel shows besides, in words.
    std::string draw_panel(Svg& svg, const glm::dvec2& corner, const Points& shown, const std::string& title, bool near,
                           bool spheres) {
        std::string words;
        Panel panel(svg, corner, shown, title);
        for (const InstanceItem& item : scene_.instances) {
            const auto box = math::corners(item.bounds_ws);
            panel.hull(flat(box), "fill='#000' fill-opacity='0.05' stroke='#999' stroke-width='0.5'");
        }
        for (std::size_t i = near ? 0 : views_.size() - 1; i < views_.size(); --i) {
            const shadow::ShadowView& view = frame_.views[views_[i]];
            const std::string colour = kColours[view.layer % kColours.size()];
            const ConsumerItem part = slice(i);
            const Parallelogram map = map_of(view);
            panel.hull(flat(receivers_in(part)), "stroke='none' fill-opacity='0.25' fill='" + colour + "'");
            panel.hull(flat(corners_of(part)), "fill='none' stroke-dasharray='5 3' stroke='" + colour + "'");
            if (spheres) {
                const shadow::SliceSphere sphere = shadow::slice_sphere(camera_, part.near_m, part.far_m);
                panel.circle(flat(camera_.position_ws_m - camera_.rotation_ws[2] * sphere.centre_m), sphere.radius_m,
                             "fill='none' stroke='" + colour + "'");
            }
            panel.polygon(map.corners(), "fill='none' stroke-width='2' stroke='" + colour + "'");
            if (near) {
                const double size_px = frame_.slots[views_[i]].size_px;
                const int step = draw_grid(panel, map, glm::dvec2(size_px), colour);
                words = "grid: a line every " + std::to_string(step) + " texels; a texel is " +
                        short_number(kCentimetres * view.texel_u) + " x " + short_number(kCentimetres * view.texel_v) +
                        " cm";
                break;
            }
        }
        panel.dot(flat(camera_.position_ws_m), "fill='#000'");
        panel.text(flat(camera_.position_ws_m), "camera", "");
        return words;
    }

    const SceneSnapshot& scene_;
    const shadow::ShadowFrame& frame_;
    const ConsumerItem& camera_;
    glm::dmat3 basis_;
    std::vector<std::uint32_t> views_;
};

/// Tangents of a point as a perspective view sees it; none behind it.
std::optional<glm::dvec2> tangents(const glm::dvec3& apex, const glm::dmat3& axes, const glm::dvec3& p_ws) {
    const glm::dvec3 p = (p_ws - apex) * axes;
    if (!(p.z < 0.0)) return std::nullopt;
    return glm::dvec2(p.x, p.y) / -p.z;
}

void draw_footprints(Panel& panel, const SceneSnapshot& scene, const shadow::ShadowFrame& frame,
                     const shadow::PotentialSets& sets, const glm::dvec3& apex, const glm::dmat3& axes) {
    for (const InstanceItem& item : scene.instances) {
        Points box;
        for (const glm::dvec3& p : math::corners(item.bounds_ws))
            if (const auto q = tangents(apex, axes, p)) box.push_back(*q);
        if (box.size() == 8) panel.hull(box, "fill='#000' fill-opacity='0.05' stroke='#999' stroke-width='0.5'");
    }
    std::vector<glm::dvec3> seen;
    const math::Frustum view = consumer_frustum(scene.consumers.front());
    for (std::uint32_t i = 0; i < sets.receivers.count; ++i) {
        const math::Aabb& box = scene.instances[frame.receiver_items[sets.receivers.first + i]].bounds_ws;
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
    const shadow::ShadowView& view = frame.views[index];
    const glm::dmat3 axes(view.axis_u, view.axis_v, view.axis_back);
    Svg svg(kSide + 2.0 * kMargin, kSide + kHead + 2.0 * kMargin, "The view of a spot");
    svg.text({kMargin, 20.0}, "spot: its cone, what is seen within it, and the map", "font-size='15'");
    const double rim = std::tan(std::min(item.outer_cone_rad, shadow::kWidestMap_rad));
    {
        Panel panel(svg, {kMargin, kHead}, {glm::dvec2(-rim), glm::dvec2(rim)}, "tangents, as the light sees them");
        draw_footprints(panel, scene, frame, frame.sets[view.demand], view.anchor_ws_m, axes);
        panel.circle({0.0, 0.0}, rim, "fill='none' stroke='#b8860b' stroke-dasharray='5 3' stroke-width='1.5'");
        const glm::dvec2 size = view.tan_high - view.tan_low;
        const Parallelogram map{view.tan_low, {size.x, 0.0}, {0.0, size.y}};
        const int step = draw_grid(panel, map, glm::dvec2(frame.slots[index].size_px), kColours[0]);
        panel.polygon(map.corners(), "fill='none' stroke-width='2' stroke='" + std::string(kColours[0]) + "'");
        svg.text({kMargin, kHead + kSide + 20.0},
                 "dashed: the cone; blue: receivers within the view; red: the map, a line every " +
                     std::to_string(step) + " texels");
    }
    return svg.str();
}

/// The cube's faces, unfolded: which of them are drawn, and what is seen through them.
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
        const auto view =
            std::find_if(views.begin(), views.end(), [&](std::uint32_t v) { return frame.views[v].layer == face; });
        const bool drawn = view != views.end();
        svg.rectangle(low, low + kFace,
                      drawn ? "fill='#c0392b' fill-opacity='0.18' stroke='#c0392b' stroke-width='2'"
                            : "fill='none' stroke='#999' stroke-dasharray='4 3'");
        svg.text(low + glm::dvec2(8.0, 18.0), kNames[face], "font-weight='bold'");
        const std::uint32_t casters = drawn ? frame.views[*view].casters.count : 0;
        svg.text(low + glm::dvec2(8.0, 36.0), drawn ? std::to_string(casters) + " casters" : "no view", "fill='#444'");
    }
    svg.text({kMargin, 3.0 * kFace + kHead + 20.0}, "light '" + scene.lights[light].name + "'");
    return svg.str();
}

std::optional<Error> write(const std::filesystem::path& file, const std::string& text) {
    return game::write_file(file, std::as_bytes(std::span(text)));
}

/// First light of the kind that has views; empty: none.
std::optional<std::uint32_t> first_of(const ShadowFrames& frames, LightKind kind) {
    for (std::uint32_t l = 0; l < frames.snapshot().lights.size(); ++l)
        if (frames.snapshot().lights[l].kind == kind && !views_of(frames.frame(), l).empty()) return l;
    return std::nullopt;
}

}  // namespace

std::optional<Error> write_drawings(Stage& stage, const std::filesystem::path& folder) {
    std::vector<std::string> fits = known_fits();
    const bool no_choice = fits.empty();
    if (no_choice) fits = {"tight"};
    for (const std::string& fit : fits) {
        if (!no_choice)
            if (auto error = stage.apply_setting("fit=" + fit)) return error;
        auto frames = ShadowFrames::create(stage);
        if (!frames) return frames.error();
        for (int i = 0; i < kSettlingFrames; ++i)
            if (auto error = frames.value()->run()) return error;
        if (const auto sun = first_of(*frames.value(), LightKind::directional))
            if (auto error = write(folder / ("sun_" + fit + ".svg"), SunDrawing(*frames.value(), *sun).draw(fit)))
                return error;
        if (fit != fits.front()) continue;  // the others do not depend on it
        if (const auto spot = first_of(*frames.value(), LightKind::spot))
            if (auto error = write(folder / "spot.svg", draw_spot(*frames.value(), *spot))) return error;
        if (const auto point = first_of(*frames.value(), LightKind::point))
            if (auto error = write(folder / "point.svg", draw_point(*frames.value(), *point))) return error;
    }
    return std::nullopt;
}

}  // namespace gnomon::bench
