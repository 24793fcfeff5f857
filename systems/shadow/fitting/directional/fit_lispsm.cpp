#include "systems/shadow/fitting/directional/fit_lispsm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

#include "engine/math/convex_polygon.h"
#include "engine/math/frustum.h"
#include "engine/math/projection.h"
#include "systems/shadow/fitting/directional/min_area_rectangle.h"
#include "systems/shadow/projection/lispsm_math.h"

namespace gnomon::shadow {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Steps of the golden-section search for the best share of the warp. They narrow it to 0.618^24, 1e-5.
constexpr int kSearchSteps = 24;
/// Depths at which the mean is sampled, evenly in their logarithm: two per octave of the largest likely ratio, 2^16.
constexpr std::size_t kDepths = 32;
constexpr double kGolden = 0.6180339887498949;
/// Gain in the mean texel below which the warp is reduced in proportion, so that both fade to none together.
constexpr double kFullGain = 0.1;

/// One strength of warp, and the rectangle that then contains the points.
struct Candidate {
    glm::dvec2 gradient{0.0};  // gradient of w along the light's own axes, per metre
    Rectangle rectangle;       // rectangle of the warped points, from the anchor
    glm::dvec2 extent_m{0.0};  // sides of the map: the rectangle and the filter's border
    double worst = 0.0;        // largest texel over the camera's depth there
    double mean = 0.0;         // the same, mean over the depths' logarithm
};

/// Range of places along the view, across the light, of the points at one depth from the camera.
struct Span {
    double depth_m = 0.0, nearest_m = 0.0, farthest_m = 0.0;
};

/// Search for the best warp of one cascade. Points are given along the light's own axes, from a point on the camera's
/// line of sight as the light sees it.
class WarpSearch {
public:
    WarpSearch(const CascadeInput& input, double strength)
        : input_(input),
          scratch_(input.light.scratch),
          camera_(input.light.scene.consumers.front()),
          strength_(strength),
          origin_ws_m_(input.points_ws.front()) {
        const glm::dvec2 toward = glm::dvec2(-camera_.rotation_ws[2] * input.basis);
        sine_ = glm::length(toward);
        if (sine_ > 0.0) along_ = toward / sine_;
        gather();
    }

    Candidate candidate(double share) const {
        Candidate c;
        const double stretch = length_m_ > 0.0 ? std::pow(depth_ratio_, 0.5 * strength_ * share) - 1.0 : 0.0;
        if (stretch > 0.0) c.gradient = along_ * (stretch / length_m_);
        scratch_.points.clear();
        double aside = 0.0;
        for (const glm::dvec2& p : scratch_.outline) {
            const glm::dvec2 q = warped(c.gradient, p);
            aside = std::max(aside, std::abs(along_.x * q.y - along_.y * q.x));
            scratch_.points.push_back(q);
        }
        c.rectangle = smallest_rectangle(scratch_.points, scratch_.hull, slack_m_);
        const glm::dvec2 extent = c.rectangle.max - c.rectangle.min;
        const glm::dvec2 least(std::max({extent.x, extent.y, depth_m_}) * kLeastExtent);
        c.extent_m = glm::max(extent, least);
        for (int i = 0; i < 2; ++i) c.extent_m[i] = with_border(c.extent_m[i], input_.light);
        // A square texel of the same area stands for the real one. The rectangle may turn at any time, but its area
        // changes steadily.
        const double side_m = std::sqrt(c.extent_m.x * c.extent_m.y) / input_.light.request.map.resolution_px;
        const glm::dvec2 steepness(glm::length(c.gradient), 0.0);
        const auto texel_at = [&](double t) {
            return longest_cell(steepness, glm::dvec2(side_m), aside, 1.0 + steepness.x * t);
        };
        for (const glm::dvec2& at : scratch_.profile) c.worst = std::max(c.worst, texel_at(at.x) / at.y);
        for (const Span& span : spans_) c.mean += (texel_at(span.nearest_m) + texel_at(span.farthest_m)) / span.depth_m;
        return c;
    }

    Candidate best() const {
        const Candidate none = candidate(0.0);
        if (!(strength_ > 0.0 && depth_ratio_ > 1.0 && std::isfinite(depth_ratio_))) return none;
        const double share = best_share();
        const Candidate most = candidate(share);
        const double gain = std::min(none.worst / most.worst, none.mean / most.mean) - 1.0;
        if (!(gain > 0.0)) return none;
        const Candidate chosen = candidate(share * std::min(gain / kFullGain, 1.0));
        return chosen.worst <= none.worst ? chosen : none;
    }

    ShadowView view(const Candidate& c, const OrthographicBox& tight) const {
        const glm::dmat3& basis = input_.basis;
        const double far_z = -tight.far_m + glm::dot(tight.anchor_ws_m - origin_ws_m_, basis[2]);
        ShadowView view;
        const math::TwoFloat3 anchor = math::split(origin_ws_m_ + basis * glm::dvec3(anchor_m_, far_z));
        view.pose.anchor_ws_m = glm::dvec3(anchor.high) + glm::dvec3(anchor.low);
        const glm::dvec2 u = c.rectangle.axis_u;
        view.pose.axis_u = basis[0] * u.x + basis[1] * u.y;
        view.pose.axis_v = basis[1] * u.x - basis[0] * u.y;
        view.pose.axis_back = basis[2];
        view.plane.warp = in_axes(c.rectangle, c.gradient);
        view.plane.centre_ls_m = 0.5 * (c.rectangle.min + c.rectangle.max);
        view.plane.half_extent_m = 0.5 * c.extent_m;
        const auto size_px = static_cast<double>(input_.light.request.map.resolution_px);
        view.plane.texel_u = c.extent_m.x / size_px;
        view.plane.texel_v = c.extent_m.y / size_px;
        view.depth.near_m = -range(c, far_z, tight.far_m - tight.near_m);
        set_warped_matrices(view);
        return view;
    }

private:
    /// Returns `d` along the rectangle's axes instead of the light's.
    static glm::dvec2 in_axes(const Rectangle& r, const glm::dvec2& d) {
        return {glm::dot(r.axis_u, d), r.axis_u.x * d.y - r.axis_u.y * d.x};
    }

    void gather() {
        const glm::dvec2 aside(-along_.y, along_.x);
        const double camera_aside = glm::dot(aside, glm::dvec2((camera_.position_ws_m - origin_ws_m_) * input_.basis));
        scratch_.points.clear();
        scratch_.outline.clear();
        const double surface_m = nearest_surface();
        double nearest = kInfinity, farthest = -kInfinity, lowest = kInfinity, highest = -kInfinity, size_m = 0.0;
        for (const glm::dvec3& p_ws : input_.points_ws) {
            const glm::dvec3 p = (p_ws - origin_ws_m_) * input_.basis;
            const double t = glm::dot(along_, glm::dvec2(p));
            nearest = std::min(nearest, t);
            farthest = std::max(farthest, t);
            lowest = std::min(lowest, p.z);
            highest = std::max(highest, p.z);
            size_m = std::max({size_m, std::abs(p_ws.x), std::abs(p_ws.y), std::abs(p_ws.z)});
            scratch_.points.emplace_back(p.x, p.y);
            scratch_.outline.emplace_back(t, std::max(depth_seen(p_ws), surface_m));
        }
        slack_m_ = math::kClippedRounding * size_m;
        length_m_ = farthest - nearest;
        depth_m_ = highest - lowest;
        highest_ = highest;
        anchor_m_ = aside * camera_aside + along_ * nearest;
        // Texels grow with the distance along the view, pixels with the depth. Both are linear, so their ratio is
        // largest on the hull.
        math::convex_hull(scratch_.outline, scratch_.profile);
        glm::dvec2 depths(kInfinity, 0.0);
        for (glm::dvec2& at : scratch_.profile) {
            at.x -= nearest;
            depths = {std::min(depths.x, at.y), std::max(depths.y, at.y)};
        }
        for (std::size_t i = 0; i < kDepths; ++i) {
            const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kDepths);
            spans_[i] = span_at(depths.x * std::pow(depths.y / depths.x, share));
        }
        math::convex_hull(scratch_.points, scratch_.outline);
        for (glm::dvec2& p : scratch_.outline) p -= anchor_m_;
        if (camera_.projection == CameraProjection::perspective) depth_ratio_ = 1.0 + length_m_ * sine_ / depths.x;
    }

    /// Returns the least distance from the camera to a surface. A box around the camera bounds only the distance to its
    /// own sides.
    double nearest_surface() const {
        double nearest_m = kInfinity;
        for (const std::uint32_t r : input_.light.receivers) {
            const math::Aabb& box = input_.light.scene.instances[r].bounds_ws;
            const glm::dvec3 inside = glm::min(camera_.position_ws_m - box.min, box.max - camera_.position_ws_m);
            const double to_side_m = std::min({inside.x, inside.y, inside.z});
            const double away_m = math::distance(box, camera_.position_ws_m);
            nearest_m = std::min(nearest_m, to_side_m > 0.0 ? to_side_m : away_m);
        }
        return std::isfinite(nearest_m) ? std::min(nearest_m, input_.to_m) : 0.0;
    }

    /// Returns where the profile lies at that depth.
    Span span_at(double depth) const {
        Span span{depth, kInfinity, -kInfinity};
        const std::size_t count = scratch_.profile.size();
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = scratch_.profile[i], b = scratch_.profile[(i + 1) % count];
            if ((a.y < depth) == (b.y < depth) && a.y != depth) continue;
            const double t = a.y == b.y ? a.x : a.x + (b.x - a.x) * ((depth - a.y) / (b.y - a.y));
            span.nearest_m = std::min(span.nearest_m, t);
            span.farthest_m = std::max(span.farthest_m, t);
        }
        return span.nearest_m <= span.farthest_m ? span : Span{depth, 0.0, length_m_};
    }

    double depth_seen(const glm::dvec3& p_ws) const {
        if (camera_.projection != CameraProjection::perspective) return 1.0;
        const double depth = glm::dot(camera_.position_ws_m - p_ws, camera_.rotation_ws[2]);
        return std::max({depth, camera_.near_m, input_.from_m});
    }

    /// Returns the share of the full warp with the smallest mean texel on the screen (golden-section search, Kiefer
    /// 1953).
    double best_share() const {
        double low = 0.0, high = 1.0;
        double left = high - kGolden, right = kGolden;
        double at_left = candidate(left).mean, at_right = candidate(right).mean;
        for (int i = 0; i < kSearchSteps; ++i) {
            if (at_left <= at_right) {
                high = right;
                right = left, at_right = at_left;
                left = high - kGolden * (high - low);
                at_left = candidate(left).mean;
            } else {
                low = left;
                left = right, at_left = at_right;
                right = low + kGolden * (high - low);
                at_right = candidate(right).mean;
            }
        }
        return 0.5 * (low + high);
    }

    /// Returns the depth range at the anchor, metres. In proportion to w it contains every point, with the tight box's
    /// slack.
    double range(const Candidate& c, double far_z, double tight_m) const {
        double range_m = 0.0;
        const double slack_m = tight_m + far_z - highest_;
        for (const glm::dvec3& p_ws : input_.points_ws) {
            const glm::dvec3 p = (p_ws - origin_ws_m_) * input_.basis;
            const double w = warp_w(c.gradient, glm::dvec2(p) - anchor_m_);
            range_m = std::max(range_m, (p.z - far_z + slack_m) / w);
        }
        return range_m;
    }

    const CascadeInput& input_;
    FitScratch& scratch_;
    const ConsumerItem& camera_;
    double strength_;
    glm::dvec3 origin_ws_m_;
    glm::dvec2 along_{1.0, 0.0};  // direction of the view across the light
    glm::dvec2 anchor_m_{0.0};
    double sine_ = 0.0;  // sine of the angle between view and light
    double length_m_ = 0.0, depth_m_ = 0.0,
           highest_ = 0.0;  // extents of the points, along the view across the light and along it; their top
    double depth_ratio_ = 1.0, slack_m_ = 0.0;
    std::array<Span, kDepths> spans_{};
};

}  // namespace

void set_warped_matrices(ShadowView& view) {
    const glm::dvec4 w(view.plane.warp, 0.0, 1.0);
    const glm::dvec4 u = (glm::dvec4(1, 0, 0, 0) - view.plane.centre_ls_m.x * w) / view.plane.half_extent_m.x;
    const glm::dvec4 v = (glm::dvec4(0, 1, 0, 0) - view.plane.centre_ls_m.y * w) / view.plane.half_extent_m.y;
    const glm::dvec4 depth(0.0, 0.0, -1.0 / view.depth.near_m, 0.0);
    const glm::dmat4 clip_from_view = glm::transpose(glm::dmat4(u, v, depth, w));
    const glm::dmat3 axes(view.pose.axis_u, view.pose.axis_v, view.pose.axis_back);
    const glm::dmat4 clip_from_anchor = clip_from_view * glm::dmat4(glm::transpose(axes));
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
}

ShadowView warped_view(const CascadeInput& input, double strength, const OrthographicBox& tight) {
    const WarpSearch search(input, strength);
    const Candidate best = search.best();
    // The corners of a speck may round to one place beside the warp's anchor.
    if (!(std::min(best.extent_m.x, best.extent_m.y) > 0.0))
        return orthographic_view(tight, input.light.request.map.resolution_px);
    return search.view(best, tight);
}

}  // namespace gnomon::shadow
