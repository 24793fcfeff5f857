#include "tests/oracle/fit_oracle.h"

#include <algorithm>
#include <array>

#include "systems/shadow/projection/spot_cube_transition.h"

namespace gnomon::oracle {
namespace {

Vector in_axes(const Vector& p, const glm::dmat3& axes) {
    return {dot(p, exact(axes[0])), dot(p, exact(axes[1])), dot(p, exact(axes[2]))};
}

}  // namespace

bool sees(const ConsumerItem& consumer, const Vector& p, Real inset) {
    const Vector at = in_axes(p - exact(consumer.position_ws_m), consumer.rotation_ws);
    const Real depth = -at.z, keep = 1 - inset;
    const Real aspect = static_cast<Real>(consumer.viewport_px.x) / static_cast<Real>(consumer.viewport_px.y);
    const bool perspective = consumer.projection == CameraProjection::perspective;
    const Real half = perspective ? depth * std::tan(static_cast<Real>(consumer.fov_y_rad) / 2)
                                  : static_cast<Real>(consumer.half_height_m);
    const Real nearest = static_cast<Real>(consumer.near_m), farthest = static_cast<Real>(consumer.far_m);
    const Real slack = inset * std::max(std::abs(nearest), std::abs(depth));
    return depth > nearest + slack && depth < farthest - slack && std::abs(at.y) < half * keep &&
           std::abs(at.x) < half * aspect * keep;
}

bool reaches(const LightItem& light, const Vector& p, Real inset) {
    if (light.kind == LightKind::directional) return true;
    const Vector to = p - exact(light.position_ws_m);
    const Real distance = length(to);
    if (light.range_m > 0.0 && !(distance < static_cast<Real>(light.range_m) * (1 - inset))) return false;
    if (light.kind == LightKind::point) return distance > 0;
    const Real along = -dot(to, exact(light.rotation_ws[2]));
    const Real aside = length(to + along * exact(light.rotation_ws[2]));
    return along > 0 && std::atan2(aside, along) < static_cast<Real>(light.outer_cone_rad) * (1 - inset);
}

bool darkens(const LightItem& light, const math::Aabb& box, const Vector& p, Real least) {
    // Slabs (Kay & Kajiya 1986) of the ray p + t * toward; the light at t = 1, or at infinity.
    const bool sun = light.kind == LightKind::directional;
    const Vector toward = sun ? exact(light.rotation_ws[2]) : exact(light.position_ws_m) - p;
    const Vector low = exact(box.min) - p, high = exact(box.max) - p;
    Real from = 0, to = sun ? HUGE_VALL : 1.0L;
    for (int i = 0; i < 3; ++i) {
        if (toward[i] == 0) {
            if (low[i] >= 0 || high[i] <= 0) return false;
            continue;
        }
        from = std::max(from, std::min(low[i] / toward[i], high[i] / toward[i]));
        to = std::min(to, std::max(low[i] / toward[i], high[i] / toward[i]));
    }
    const Real size = length(high - low);
    return (to - from) * length(toward) > least * size && from >= 0;
}

InMap in_map(const shadow::ShadowView& view, const Vector& p) {
    const Vector from_anchor = p - exact(view.pose.anchor_ws_m);
    std::array<Real, 4> sum{}, size{};
    for (std::size_t row = 0; row < 4; ++row) {
        const auto entry = [&](int column) {
            return static_cast<Real>(view.map_from_anchor[column][static_cast<int>(row)]);
        };
        sum[row] = entry(3);
        size[row] = std::abs(sum[row]);
        for (int column = 0; column < 3; ++column) {
            const Real term = entry(column) * from_anchor[column];
            sum[row] += term;
            size[row] += std::abs(term);
        }
    }
    constexpr Real kRounding = 0x1p-22L;
    const Real w = sum[3];
    const auto rounding = [&](std::size_t row) {
        return kRounding * (size[row] + std::abs(sum[row] / w) * size[3]) / std::abs(w);
    };
    return {{sum[0] / w, sum[1] / w, sum[2] / w}, {rounding(0), rounding(1), rounding(2)}, w};
}

bool holds(const shadow::ShadowView& view, const Vector& p, Real size_px, Real reach_texel) {
    const InMap q = in_map(view, p);
    if (!(q.w > 0)) return false;
    const Real margin = reach_texel / size_px;
    const bool clamped = view.projection != shadow::ViewProjection::orthographic;
    const auto within = [](Real value, Real inset) { return value >= inset && value <= 1 - inset; };
    return within(q.at.x, margin - q.rounding.x) && within(q.at.y, margin - q.rounding.y) &&
           (clamped ? q.at.z >= -q.rounding.z : within(q.at.z, -q.rounding.z));
}

Deciding deciding_views(std::span<const shadow::ShadowView> views, const shadow::ShadowRequest& demand,
                        const ConsumerItem& consumer, const Vector& p, Real reach_texel) {
    using shadow::ViewProjection;
    Deciding deciding;
    Real deepest = 0;
    const Real distance = -dot(p - exact(consumer.position_ws_m), exact(consumer.rotation_ws[2]));
    for (const shadow::ShadowView& view : views) {
        const bool spot = view.projection == ViewProjection::perspective;
        if (spot && (!shadow::has_faces(demand.projection.cube_blend_eighths) || view.layer == shadow::kSingleView)) {
            deciding.wants_single = true;
            deciding.single = &view;
            continue;
        }
        deciding.wants_view = true;
        if (view.projection == ViewProjection::orthographic) {
            const bool nearer_one = view.cascade.seen_to_m > 0.0 && distance > static_cast<Real>(view.cascade.seen_to_m);
            if (nearer_one && &view != &views.back()) continue;
            if (!deciding.view && holds(view, p, demand.map.resolution_px, reach_texel)) deciding.view = &view;
            continue;
        }
        const Vector at = in_axes(p - exact(apex_ws_m(view)), {view.pose.axis_u, view.pose.axis_v, view.pose.axis_back});
        if (-at.z > deepest && std::abs(at.x) <= -at.z && std::abs(at.y) <= -at.z) {
            deepest = -at.z;
            deciding.view = &view;
        }
    }
    return deciding;
}

}  // namespace gnomon::oracle
