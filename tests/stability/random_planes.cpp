#include "tests/stability/random_planes.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "systems/shadow/fitting/directional/fit_lispsm.h"
#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/projection/perspective_view.h"

namespace gnomon {
namespace {

using shadow::ShadowView;

constexpr double kLessBias = 0.9;
constexpr int kPlanesPerMap = 16;
constexpr int kKeepOff_texel = 12;  // from a flat map's border: no filter with its usual settings reads past it

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    double power(double from, double to) { return std::pow(10.0, between(from, to)); }
    bool chance(double share) { return between(0.0, 1.0) < share; }
    int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(engine_); }
    std::uint64_t bits() { return engine_(); }
    glm::dvec3 direction() {
        glm::dvec3 v;
        do v = {between(-1, 1), between(-1, 1), between(-1, 1)};
        while (!(glm::dot(v, v) <= 1.0 && glm::dot(v, v) > 1e-4));
        return glm::normalize(v);
    }
    glm::dmat3 axes() { return glm::dmat3(glm::angleAxis(between(-3.14, 3.14), direction())); }

private:
    std::mt19937_64 engine_;
};

/// A light's views as a fit could have made them, and a place in one of them.
class Maps {
public:
    Maps(PlaneKind kind, Random& random) : kind_(kind), random_(random) {
        size_px = 1u << random.whole(6, 12);
        scale_m_ = random.power(-3.0, 4.0);
        if (kind == PlaneKind::point) {
            views = cube_views(anchor_ws_m_, range(), size_px);
        } else if (kind == PlaneKind::spot) {
            const glm::dvec2 low(random.between(-2.0, 1.0), random.between(-2.0, 1.0));
            const shadow::TangentRectangle sides{low,
                                                 low + glm::dvec2(random.power(-1.5, 0.5), random.power(-1.5, 0.5))};
            views.push_back(shadow::perspective_view(anchor_ws_m_, random.axes(), sides, range(), size_px));
        } else {
            sun();
        }
        camera_ws_m = anchor_ws_m_ + random.direction() * (scale_m_ * random.power(-2.0, 1.0));
    }

    /// Relative to the anchor: a point that the map shows, and the way from there to the light.
    struct Place {
        glm::dvec3 position_m, to_light;
    };
    Place place() {
        const ShadowView& view = views[kind_ == PlaneKind::point ? static_cast<std::size_t>(random_.whole(0, 5)) : 0];
        const int keep_off = kind_ == PlaneKind::point ? 0 : kKeepOff_texel;
        const int side = static_cast<int>(size_px);
        int column = random_.whole(keep_off, side - 1 - keep_off);
        if (kind_ == PlaneKind::point && random_.chance(1.0 / 3.0))
            column = random_.chance(0.5) ? random_.whole(0, 3) : side - 1 - random_.whole(0, 3);
        const glm::dvec2 at((column + part()) / side, (random_.whole(keep_off, side - 1 - keep_off) + part()) / side);
        if (view.projection == shadow::ViewProjection::orthographic) {
            const glm::dvec2 q = view.plane.centre_ls_m + view.plane.half_extent_m * (2.0 * at - 1.0);
            const double w = 1.0 / (1.0 - glm::dot(view.plane.warp, q));
            const double z_m = w * (view.depth.near_m + random_.between(0.05, 0.95) * (view.depth.far_m - view.depth.near_m));
            const glm::dvec2 p = q * w;
            return {view.pose.axis_u * p.x + view.pose.axis_v * p.y - view.pose.axis_back * z_m, view.pose.axis_back};
        }
        const glm::dvec2 tangent = view.plane.tan_low + (view.plane.tan_high - view.plane.tan_low) * at;
        const double z_m = view.depth.near_m * std::pow(view.depth.far_m / view.depth.near_m, random_.between(0.02, 0.98));
        const glm::dvec3 p = (view.pose.axis_u * tangent.x + view.pose.axis_v * tangent.y - view.pose.axis_back) * z_m;
        return {p, -glm::normalize(p)};
    }

    std::vector<ShadowView> views;
    std::uint32_t size_px = 64;
    glm::dvec3 camera_ws_m{0.0};

private:
    /// Draws a place in a texel, 0 to 1: beside its border, beside its middle, or anywhere.
    double part() {
        constexpr double kBeside = 0.01;
        const double near = random_.power(-6.0, -2.0) + 1e-9;
        const int where = random_.whole(0, 3);
        if (where == 0) return std::min(near, kBeside);
        if (where == 1) return 1.0 - std::min(near, kBeside);
        if (where == 2) return 0.5 + (random_.chance(0.5) ? near : -near);
        return random_.between(0.0, 1.0);
    }
    shadow::PerspectiveRange range() {
        const double near_m = scale_m_ * random_.power(-3.0, 0.0);
        return {near_m, near_m * random_.power(0.05, 3.0)};
    }
    void sun() {
        shadow::OrthographicBox box{anchor_ws_m_, random_.axes(), {}, {}, 0.0, 0.0};
        box.half_extent_m = {scale_m_, scale_m_ * random_.power(-0.7, 0.7)};
        box.centre_m = {scale_m_ * random_.between(-4.0, 4.0), scale_m_ * random_.between(-4.0, 4.0)};
        const double range_m = scale_m_ * random_.power(-2.0, 2.0);
        box.near_m = range_m * random_.between(-2.0, 1.0);
        box.far_m = box.near_m + range_m;
        if (kind_ == PlaneKind::warped_sun) {
            box.centre_m = {scale_m_ * random_.between(-1.0, 1.0), scale_m_ * random_.between(-1.0, 1.0)};
            box.near_m = -range_m;
            box.far_m = 0.0;
        }
        views.push_back(shadow::orthographic_view(box, size_px));
        if (kind_ != PlaneKind::warped_sun) return;
        ShadowView& view = views.back();
        // The map shows the part of its warped plane on this side of the horizon.
        const double farthest_m = glm::length(box.half_extent_m) + glm::length(box.centre_m);
        const double turn = random_.between(0.0, 6.28);
        view.plane.warp = glm::dvec2(std::cos(turn), std::sin(turn)) * (random_.between(0.0, 0.97) / farthest_m);
        shadow::set_warped_matrices(view);
    }

    PlaneKind kind_;
    Random& random_;
    double scale_m_ = 1.0;
    glm::dvec3 anchor_ws_m_{1234.5, -67.8, 910.1};
};

/// Draws a unit normal. The tangent of its angle to `to_light` is any power of ten from 0.001 to 1000.
glm::dvec3 sloped_normal(Random& random, const glm::dvec3& to_light, double& tangent) {
    tangent = random.power(-3.0, 3.0);
    const glm::dvec3 aside = glm::normalize(glm::cross(to_light, random.direction()));
    return glm::normalize(to_light + aside * tangent);
}

/// Sets the quad of the plane around the receiver, as far off it as the plane is. Rounding on the way to the map does
/// not matter between the receiver and the casters' corners.
void show_quad(LonePlane& plane, const glm::dvec3& place_m, const glm::dvec3& to_light, double texel_m) {
    // A generator of its own, so that the plane's other numbers do not depend on it. A small one: it is made per plane.
    std::minstd_rand random(static_cast<std::uint32_t>(plane.salt >> 32));
    std::uniform_real_distribution<double> share(-0.5, 0.5);
    const glm::dvec3 off_m = plane.at_m - place_m;
    const double cosine = glm::dot(plane.normal, to_light);
    const double half_m = (texel_m + glm::length(off_m)) / cosine * std::exp2(2.0 + 4.0 * share(random));
    const glm::dvec3 along = glm::normalize(to_light - plane.normal * cosine), aside = glm::cross(plane.normal, along);
    const double turn = 6.28 * share(random);
    plane.half_u_m = half_m * (std::cos(turn) * along + std::sin(turn) * aside);
    plane.half_v_m = half_m * (std::cos(turn) * aside - std::sin(turn) * along);
    plane.quad_at_m = plane.receiver_m + off_m + share(random) * plane.half_u_m + share(random) * plane.half_v_m;
}

/// Draws a plane of this normal, drawn and seen as docs/explanation/bias.md describes ("What is tested").
LonePlane random_plane(Random& random, const Maps& maps, const Maps::Place& place, const glm::dvec3& normal) {
    const PlaneBounds bounds = plane_bounds();
    LonePlane plane;
    plane.normal = normal;
    plane.worst = random.chance(0.5);
    plane.salt = random.bits();
    const auto share = [&] { return plane.worst ? 1.0 : random.between(-1.0, 1.0); };
    plane.aside_texel = glm::dvec2(share(), share()) * bounds.snap_texel;

    const ShadowView& view = maps.views[0];
    plane.error_m = bounds.rebuilt_relative * glm::length(place.position_m + view.pose.anchor_ws_m - maps.camera_ws_m);
    // As the shaders count it: a sun's along the axes, a lamp's from the light.
    const glm::dvec3 far_m = glm::abs(place.position_m);
    const bool orthographic = view.projection == shadow::ViewProjection::orthographic;
    const double counted_m = orthographic ? far_m.x + far_m.y + far_m.z : glm::length(far_m);
    const double half_rounding = 6.0 * bounds.unit_roundoff;  // half of kPositionRounding in float_rounding.glsl
    plane.receiver_m = place.position_m + random.direction() * (half_rounding * counted_m);
    // The receiver stays where its texel is worst: it is the plane that lies off it, on this side of the light.
    const double off_m = share() * plane.error_m, light_m = -glm::dot(normal, place.position_m);
    plane.at_m = place.position_m + normal * (orthographic ? off_m : std::min(off_m, 0.5 * light_m));
    const glm::dvec3 off = random.direction() * bounds.normal_error_rad;
    plane.receiver_normal = glm::normalize(normal + off - normal * glm::dot(normal, off));
    const double texel = std::max(view.plane.texel_u, view.plane.texel_v);
    if (plane.salt % 2 == 0)
        show_quad(plane, place.position_m, place.to_light,
                  orthographic ? texel : texel * glm::length(place.position_m));
    return plane;
}

}  // namespace

PlaneTally judge_planes(PlaneKind kind, ShadowFilter filter, DepthFormat format, std::uint64_t count,
                        std::uint64_t seed) {
    Random random(seed);
    LonePlaneLookup lookup(kind, filter, format);
    PlaneTally tally;
    while (tally.planes < count) {
        Maps maps(kind, random);
        lookup.set_maps(maps.views, maps.size_px, maps.camera_ws_m);
        for (int i = 0; i < kPlanesPerMap && tally.planes < count; ++i, ++tally.planes) {
            const Maps::Place place = maps.place();
            double tangent = 0.0;
            const glm::dvec3 normal = sloped_normal(random, place.to_light, tangent);
            const LonePlane plane = random_plane(random, maps, place, normal);
            const LonePlaneLookup::Answer answer = lookup.look_up(plane, 1.0);
            tally.dark += !answer.lit;
            tally.looked_up += answer.looked_up;
            tally.dark_with_less += !lookup.look_up(plane, kLessBias).lit;
            tally.steep += tangent > plane_bounds().steep_tangent;
        }
    }
    return tally;
}

}  // namespace gnomon
