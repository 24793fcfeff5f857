#include "tests/stability/hard_cases_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "systems/shadow/culling/lamp_offsets.h"
#include "tests/oracle/traced_world.h"

namespace gnomon::hard {
namespace {

using Number = long double;
using Vec = glm::vec<3, Number, glm::defaultp>;

constexpr int kRays = 500;
constexpr std::size_t kMostPoints = 400;  // per light and kind: every point is compared with every triangle
constexpr Number kSlack = 1e-12L;         // relative rounding of long double that a decision must exceed

struct Triangle {
    Vec a, b, c;
    std::uint32_t instance;
};
struct Ray {
    Vec from, way;
};
struct Point {
    Vec at;
    std::size_t triangle;
};

std::vector<Triangle> triangles_of(const SceneSnapshot& scene, const assets::MeshLibrary& library) {
    std::vector<Triangle> all;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        const assets::Mesh& mesh = library.meshes[item.mesh];
        const auto corner = [&](std::size_t index) {
            const glm::vec3 p = mesh.vertices[mesh.indices[index]].position_ms;
            Vec sum(item.translation_ws_m);
            for (int axis = 0; axis < 3; ++axis) sum += Vec(item.basis[axis]) * static_cast<Number>(p[axis]);
            return sum;
        };
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            const Triangle t{corner(k), corner(k + 1), corner(k + 2), i};
            if (glm::length(glm::cross(t.b - t.a, t.c - t.a)) > 0.0L) all.push_back(t);
        }
    }
    return all;
}

/// Returns the ray parameter of the crossing, or NaN. Tests the plane first, then three signed areas in that plane.
/// `clear` false: so near an edge, or so much along the plane, that the last digits decide.
Number crossing(const Ray& ray, const Triangle& t, bool& clear) {
    const Vec normal = glm::cross(t.b - t.a, t.c - t.a);
    const Number toward = glm::dot(normal, ray.way), size = glm::length(normal);
    clear = std::abs(toward) > kSlack * size * glm::length(ray.way);
    if (toward == 0.0L) return std::numeric_limits<Number>::quiet_NaN();
    const Number at = glm::dot(normal, t.a - ray.from) / toward;
    const Vec p = ray.from + ray.way * at;
    bool inside = true;
    const Vec corners[] = {t.a, t.b, t.c};
    for (int i = 0; i < 3; ++i) {
        const Vec &u = corners[i], &v = corners[(i + 1) % 3];
        const Number area = glm::dot(glm::cross(v - u, p - u), normal) / size;
        const Number limit = kSlack * std::max(size, glm::length(v - u) * glm::length(p - u));
        inside = inside && area >= 0.0L;
        clear = clear && std::abs(area) > limit;
    }
    return inside ? at : std::numeric_limits<Number>::quiet_NaN();
}

Ray picture_ray(const ConsumerItem& c, Number x, Number y) {
    const bool flat = c.projection == CameraProjection::orthographic;
    const Number half_y = flat ? Number(c.half_height_m) : std::tan(Number(c.fov_y_rad) / 2);
    const Number half_x = half_y * Number(c.viewport_px.x) / Number(c.viewport_px.y);
    const Vec lateral = Vec(c.rotation_ws[0]) * (x * half_x) + Vec(c.rotation_ws[1]) * (y * half_y);
    const Vec at(c.position_ws_m), back(c.rotation_ws[2]);
    return flat ? Ray{at + lateral, -back} : Ray{at, lateral - back};
}

bool sees(const ConsumerItem& c, const Vec& p) {
    constexpr Number kClear = 1e-6L;  // relative distance from the frustum's border
    const Vec to = p - Vec(c.position_ws_m);
    const Number z = -glm::dot(to, Vec(c.rotation_ws[2]));
    const bool flat = c.projection == CameraProjection::orthographic;
    const Number half_y = (flat ? Number(c.half_height_m) : z * std::tan(Number(c.fov_y_rad) / 2)) * (1 - kClear);
    const Number half_x = half_y * Number(c.viewport_px.x) / Number(c.viewport_px.y);
    return z > Number(c.near_m) * (1 + kClear) && z < Number(c.far_m) * (1 - kClear) &&
           std::abs(glm::dot(to, Vec(c.rotation_ws[0]))) < half_x &&
           std::abs(glm::dot(to, Vec(c.rotation_ws[1]))) < half_y;
}

/// Returns all points of receivers on random rays through the picture, hidden or not.
std::vector<Point> seen_points(const SceneSnapshot& scene, const std::vector<Triangle>& triangles) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-0.999999, 0.999999);
    std::vector<Point> points;
    for (const ConsumerItem& c : scene.consumers)
        for (int r = 0; r < kRays; ++r) {
            const double x = place(random);
            const Ray ray = picture_ray(c, x, place(random));
            for (std::size_t t = 0; t < triangles.size(); ++t) {
                const InstanceItem& item = scene.instances[triangles[t].instance];
                bool clear = false;
                const Number at = item.visible && item.receives ? crossing(ray, triangles[t], clear) : 0.0L;
                if (!clear || !(at > Number(c.near_m) * (1 + kSlack) && at < Number(c.far_m) * (1 - kSlack))) continue;
                points.push_back({ray.from + ray.way * at, t});
            }
        }
    std::shuffle(points.begin(), points.end(), random);
    return points;
}

bool reached(const LightItem& light, const Vec& p) {
    constexpr Number kClear = 1e-6L;  // relative distance from the cone's and the range's border
    if (light.kind == LightKind::directional) return true;
    const Vec to = p - Vec(light.position_ws_m);
    const Number distance = glm::length(to);
    if (!(distance > 0.0L)) return false;
    if (light.range_m > 0.0 && distance > Number(light.range_m) * (1 - kClear)) return false;
    if (light.kind == LightKind::point) return true;
    const Number cosine = glm::dot(to, -Vec(light.rotation_ws[2])) / distance;
    return cosine > std::cos(Number(light.outer_cone_rad)) + kClear * std::sin(Number(light.outer_cone_rad));
}

/// Returns whether the lamp stands off the triangle's plane by more than its place is moved aside (lamp_offsets.h). A
/// surface takes no light from a lamp in its plane, and other surfaces in that plane darken nothing there.
bool is_off_plane(const LightItem& light, const Triangle& t) {
    if (light.kind == LightKind::directional) return true;
    const Vec lamp(light.position_ws_m), normal = glm::cross(t.b - t.a, t.c - t.a);
    const Number reach = std::max({glm::length(t.a - lamp), glm::length(t.b - lamp), glm::length(t.c - lamp)});
    return std::abs(glm::dot(normal, lamp - t.a)) > 2 * Number(shadow::kClearOfClipping) * reach * glm::length(normal);
}

/// Returns the ray from the point to the light. Its parameter 1 is at the light itself, or beyond everything for a sun.
Ray to_light(const LightItem& light, const Vec& p, Number scene_size) {
    if (light.kind == LightKind::directional) return {p, Vec(light.rotation_ws[2]) * scene_size * 4.0L};
    return {p, Vec(light.position_ws_m) - p};
}

/// Points of receivers in the shadow of random points of casters, where a camera sees them.
std::vector<Point> shadowed_points(const SceneSnapshot& scene, const std::vector<Triangle>& triangles,
                                   const LightItem& light) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<std::size_t> casters;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (scene.instances[triangles[t].instance].casts) casters.push_back(t);
    std::vector<Point> points;
    for (int r = 0; r < kRays && !casters.empty(); ++r) {
        const Triangle& caster = triangles[casters[random() % casters.size()]];
        const Number a = std::sqrt(Number(unit(random))), b = Number(unit(random));
        const Vec on = caster.a * (1 - a) + caster.b * (a * (1 - b)) + caster.c * (a * b);
        const bool sun = light.kind == LightKind::directional;
        const Vec away = sun ? -Vec(light.rotation_ws[2]) : on - Vec(light.position_ws_m);
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const InstanceItem& item = scene.instances[triangles[t].instance];
            bool clear = false;
            const Number at = item.visible && item.receives ? crossing({on, away}, triangles[t], clear) : 0.0L;
            const Vec p = on + away * at;
            const bool behind = clear && at > 1e-6L;
            for (const ConsumerItem& c : scene.consumers)
                if (behind && sees(c, p)) points.push_back({p, t});
        }
    }
    std::shuffle(points.begin(), points.end(), random);
    return points;
}

/// Returns the instances that block the ray. `touch`: share of the way, at its end, in which crossings do not count:
/// there the light touches the caster.
std::vector<std::uint32_t> occluders(const SceneSnapshot& scene, const std::vector<Triangle>& triangles,
                                     const Point& point, const Ray& ray, Number touch) {
    std::vector<std::uint32_t> found;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const InstanceItem& item = scene.instances[triangles[t].instance];
        if (!item.casts || t == point.triangle) continue;
        bool clear = false;
        const Number at = crossing(ray, triangles[t], clear);
        const Number smallest = 1e-9L;  // share of the way: coplanar neighbours touch at the point itself
        if (clear && at > smallest && at < 1.0L - std::max(smallest, touch)) found.push_back(triangles[t].instance);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Returns whether the point is in the map and within the depth range as the light's kind reads it. In a sun's map it
/// must keep the filter's margin.
bool holds(const shadow::ShadowView& view, const Vec& p, Number margin) {
    const Vec a = p - Vec(view.pose.anchor_ws_m);
    Number q[4];
    for (int row = 0; row < 4; ++row)
        q[row] = Number(view.map_from_anchor[0][row]) * a.x + Number(view.map_from_anchor[1][row]) * a.y +
                 Number(view.map_from_anchor[2][row]) * a.z + Number(view.map_from_anchor[3][row]);
    if (!(q[3] > 0.0L)) return false;
    const Number u = q[0] / q[3], v = q[1] / q[3], d = q[2] / q[3];
    if (view.projection == shadow::ViewProjection::orthographic)
        return u >= margin && v >= margin && u <= 1 - margin && v <= 1 - margin && d >= 0.0L && d <= 1.0L;
    constexpr Number kSeam = 1e-6L;  // faces of a cube meet: floats decide which of two holds the seam
    const Number border = view.projection == shadow::ViewProjection::cube_face ? kSeam : 0.0L;
    return u >= -border && v >= -border && u <= 1 + border && v <= 1 + border && d >= 0.0L;
}

bool is_finite(const shadow::ShadowView& view) {
    bool all = view.depth.near_m < view.depth.far_m && std::isfinite(view.depth.near_m) && std::isfinite(view.depth.far_m) &&
               view.plane.texel_u > 0.0 && view.plane.texel_v > 0.0 && std::isfinite(view.plane.texel_u) && std::isfinite(view.plane.texel_v) &&
               std::isfinite(view.error.edge_px) && std::isfinite(glm::dot(view.pose.anchor_ws_m, view.pose.anchor_ws_m));
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            all = all && std::isfinite(view.clip_from_anchor[c][r]) && std::isfinite(view.map_from_anchor[c][r]);
    return all;
}

std::string words(const Vec& p) {
    std::string text;
    for (int i = 0; i < 3; ++i) text += (i == 0 ? "(" : ", ") + std::to_string(static_cast<double>(p[i]));
    return text + ")";
}

class Judge {
public:
    explicit Judge(const Stages& stages, const assets::MeshLibrary& library)
        : stages_(stages),
          scene_(stages.snapshot()),
          triangles_(triangles_of(scene_, library)),
          points_(seen_points(scene_, triangles_)),
          traced_(scene_, library, origin()) {
        for (const Triangle& t : triangles_)
            size_ = std::max({size_, glm::length(t.a - Vec(origin())), glm::length(t.b - Vec(origin())),
                              glm::length(t.c - Vec(origin()))});
    }

    Verdict run() {
        for (const shadow::ShadowView& view : stages_.frame().fitted.views)
            if (!is_finite(view)) note(verdict_.not_finite, "a view is not finite");
        for (std::uint32_t l = 0; l < scene_.lights.size(); ++l) judge_light(l);
        return verdict_;
    }

private:
    glm::dvec3 origin() const {
        return scene_.consumers.empty() ? glm::dvec3(0.0) : scene_.consumers.front().position_ws_m;
    }
    void note(std::size_t& count, const std::string& what) {
        ++count;
        if (verdict_.first.empty()) verdict_.first = what;
    }

    void judge_light(std::uint32_t l) {
        const LightItem& light = scene_.lights[l];
        const LightReport& report = stages_.report().lights[l];
        const auto views = stages_.views(l);
        const bool skipped = report.state == LightState::skipped;
        if (skipped != views.empty() || (skipped && report.reason == Reason::none))
            note(verdict_.no_reason,
                 light.name + ": " + std::to_string(views.size()) + " views, reason " + reason_code(report.reason));
        for (const auto& points : {points_, shadowed_points(scene_, triangles_, light)})
            judge_points(l, views, skipped, points);
    }

    void judge_points(std::uint32_t l, const std::vector<const shadow::ShadowView*>& views, bool skipped,
                      const std::vector<Point>& points) {
        const LightItem& light = scene_.lights[l];
        std::size_t judged = 0;
        for (const Point& point : points) {
            if (!reached(light, point.at) || !is_off_plane(light, triangles_[point.triangle])) continue;
            if (++judged > kMostPoints) break;
            ++verdict_.seen;
            const Ray ray = to_light(light, point.at, size_);
            // A lamp is kept off what it touches by this share of the way, on either side (lamp_offsets.h).
            const Number touch = light.kind == LightKind::directional ? 0.0L : 4 * Number(shadow::kClearOfClipping);
            const auto dark = occluders(scene_, triangles_, point, ray, touch);
            verdict_.darkened += !dark.empty();
            if (judged % 8 == 0) audit(ray);
            if (skipped) {
                if (!dark.empty())
                    note(verdict_.wrong_skip, light.name + ": skipped, but " + words(point.at) + " is dark");
            } else {
                judge_point(l, views, point.at, dark);
            }
        }
    }

    void judge_point(std::uint32_t l, const std::vector<const shadow::ShadowView*>& views, const Vec& at,
                     const std::vector<std::uint32_t>& dark) {
        const LightItem& light = scene_.lights[l];
        const shadow::ShadowRequest& demand = stages_.frame().fitted.lights[views.front()->light].request;
        const Number margin = Number(demand.map.filtering.widest_texel) / Number(demand.map.resolution_px);
        const auto previous =
            std::find_if(views.begin(), views.end(), [&](const auto* v) { return holds(*v, at, margin); });
        if (previous == views.end()) {
            // A local light needs no view where nothing casts.
            if (light.kind == LightKind::directional || !dark.empty())
                note(verdict_.outside, light.name + ": " + words(at) + " is in no view");
            return;
        }
        const shadow::IndexRange& range = (*previous)->casters;
        const auto begin = stages_.frame().fitted.casters.begin() + range.first;
        for (const std::uint32_t instance : dark)
            if (std::find(begin, begin + range.count, instance) == begin + range.count)
                note(verdict_.missed, light.name + ": caster " + std::to_string(instance) + " darkens " + words(at));
    }

    /// Checks Embree's candidates: compares the answer with that of all triangles, one by one, by the same watertight
    /// test in double.
    void audit(const Ray& ray) {
        const glm::dvec3 from = glm::dvec3(ray.from) - origin();
        const oracle::ExactRay exact = oracle::make_ray(from, glm::dvec3(ray.way));
        const bool fast = traced_.occluder(exact, 1.0, oracle::kNoTriangle, oracle::kNoTriangle) != oracle::kNoTriangle;
        bool slow = false;
        double t = 0.0;
        for (std::uint32_t i = 0; i < traced_.triangles().size() && !slow; ++i)
            slow = traced_.blocks(exact, 1.0, kAllShadowLayers, oracle::kNoTriangle, i, t);
        if (fast != slow) note(verdict_.audit_wrong, "Embree and all triangles disagree at " + words(ray.from));
    }

    const Stages& stages_;
    const SceneSnapshot& scene_;
    std::vector<Triangle> triangles_;
    std::vector<Point> points_;
    oracle::TracedWorld traced_;
    Number size_ = 0.0L;
    Verdict verdict_;
};

}  // namespace

Verdict judge(const Stages& stages) { return Judge(stages, stages.library()).run(); }

}  // namespace gnomon::hard
