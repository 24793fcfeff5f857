#include "systems/shadow/fitting/choose_proxies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "engine/math/aabb.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

constexpr double kUnlimited_m = std::numeric_limits<double>::infinity();
/// Share of the target of edges that proxies may take.
constexpr double kProxyShare = 1.0;
/// A bound moves an edge once by the proxy and once by the receiver's offset.
constexpr double kTwice = 2.0;
/// Cells of a sun's map, per half of its side, to which cameras are rounded.
constexpr double kCells = 16.0;

/// Bounds the factor by which the linear map lengthens a vector: Gershgorin's bound on its largest singular value,
/// exact for columns at right angles.
double most_stretch(const glm::dmat3& basis) {
    const glm::dmat3 squares = glm::transpose(basis) * basis;
    double most = 0.0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, std::abs(squares[i].x) + std::abs(squares[i].y) + std::abs(squares[i].z));
    return std::sqrt(most);
}

/// Returns the number or a little more: the next power of the square root of two.
double in_steps(double number) { return std::exp2(0.5 * std::ceil(2.0 * std::log2(number))); }

/// Widest bounds of casters in one view, metres.
class Allowed {
public:
    Allowed(const SceneSnapshot& scene, const ShadowView& view)
        : scene_(scene), view_(view), allowed_px_(allowed_proxy_px(scene.lights[view.light].shadow)) {
        const double half_m = std::max(view.plane.half_extent_m.x, view.plane.half_extent_m.y);
        cell_m_ = half_m > 0.0 ? std::exp2(std::floor(std::log2(half_m / kCells))) : 0.0;
        metre_px_ = view.error.metre_px > 0.0 ? in_steps(view.error.metre_px) : kUnlimited_m;
    }

    double bound_m(const InstanceItem& caster) const {
        return is_parallel(view_) ? of_sun(caster.bounds_ws) : of_lamp(caster.bounds_ws);
    }

private:
    /// Computes it for a sun. What cameras see of a shadow lies in the caster's sphere, drawn out along the light.
    double of_sun(const math::Aabb& box) const {
        const glm::dvec3 middle = math::centre(box), ahead = -view_.pose.axis_back;
        const double radius_m = glm::length(math::half_extent(box));
        double least_m = kUnlimited_m;
        for (const ConsumerItem& consumer : scene_.consumers) {
            const double per_metre = proxy_bound_of(consumer, allowed_px_);
            if (consumer.projection != CameraProjection::perspective) {
                least_m = std::min(least_m, per_metre);
                continue;
            }
            const glm::dvec3 camera = glm::round(consumer.position_ws_m / cell_m_) * cell_m_;
            const glm::dvec3 from = camera - middle;
            const double along_m = std::max(glm::dot(from, ahead), 0.0);
            const double rounding_m = 0.5 * std::sqrt(3.0) * cell_m_;
            const double nearest_m = glm::length(from - ahead * along_m) - radius_m - rounding_m;
            least_m = std::min(least_m, per_metre * nearest_m);
        }
        return least_m;
    }
    /// Computes it for a lamp. The view's receivers bound what a metre covers on the screen, and how far away they are.
    double of_lamp(const math::Aabb& box) const {
        const glm::dvec2 side = glm::max(glm::abs(view_.plane.tan_low), glm::abs(view_.plane.tan_high));
        const double far_m = view_.depth.far_m * std::sqrt(1.0 + glm::dot(side, side));
        const double near_m = math::distance(box, apex_ws_m(view_));
        return allowed_px_ / (kTwice * metre_px_) * std::min(near_m / far_m, 1.0);
    }

    const SceneSnapshot& scene_;
    const ShadowView& view_;
    double allowed_px_, cell_m_ = 0.0, metre_px_ = kUnlimited_m;
};

/// Returns whether maps of the filter may show coarser casters. Conservative bounds are those of the casters
/// themselves.
bool takes_proxies(const SceneSnapshot& scene, const MapSettings& map, const ShadowView& view) {
    const FilterStorage& storage = filter_row(map.filter).storage;
    const LightItem& light = scene.lights[view.light];
    return light.tuning.maps.proxies && light.tuning.bias.mode == BiasMode::automatic &&
           !scene.meshes.proxies.empty() && !scene.consumers.empty() && !storage.conservative_bounds &&
           view.plane.warp == glm::dvec2(0.0);
}

/// Coarsest proxy of a caster within a bound, and its own bound in the world; the caster's mesh and 0 without.
struct Choice {
    std::uint32_t mesh = 0;
    double bound_m = 0.0;
};
Choice choose(const SceneSnapshot& scene, const InstanceItem& caster, const Allowed& allowed) {
    Choice choice{caster.mesh, 0.0};
    const std::span<const ProxyItem> proxies = proxies_of(scene.meshes, caster.mesh);
    if (proxies.empty() || caster.drawable.by_depth) return choice;
    const double scale = most_stretch(caster.basis), most_m = allowed.bound_m(caster);
    for (const ProxyItem& proxy : proxies)
        if (proxy.bound_m * scale <= most_m) choice = {proxy.mesh, proxy.bound_m * scale};
    return choice;
}

}  // namespace

double allowed_proxy_px(const LightShadow& shadow) { return kProxyShare * target_error_px(shadow); }

double proxy_bound_of(const ConsumerItem& consumer, double allowed_px) {
    const double metre_px = kTwice * kSteepestReceiver / pixel_footprint(consumer);
    if (consumer.projection != CameraProjection::perspective) return allowed_px / metre_px;
    // At a distance d the view depth is d / k or more, and a metre covers k / depth footprints or fewer.
    return allowed_px / (metre_px * squared_corner_slant(consumer));
}

void choose_proxies(const SceneSnapshot& scene, const MapSettings& map, ShadowView& view,
                    std::vector<DrawnCaster>& scratch, FittedViews& out) {
    if (!takes_proxies(scene, map, view)) return;
    const Allowed allowed(scene, view);
    scratch.clear();
    for (const std::uint32_t i : out.casters_of(view)) {
        const Choice choice = choose(scene, scene.instances[i], allowed);
        view.error.proxy_m = std::max(view.error.proxy_m, choice.bound_m);
        scratch.emplace_back(choice.mesh, i);
    }
    if (!(view.error.proxy_m > 0.0)) return;
    const auto first_moving = scratch.begin() + view.static_casters;
    std::sort(scratch.begin(), first_moving);
    std::sort(first_moving, scratch.end());
    out.caster_meshes.resize(out.casters.size());
    for (std::size_t i = 0; i < scratch.size(); ++i) {
        out.caster_meshes[view.casters.first + i] = scratch[i].first;
        out.casters[view.casters.first + i] = scratch[i].second;
    }
    view.error.edge_px += allowed_proxy_px(scene.lights[view.light].shadow);
}

}  // namespace gnomon::shadow
