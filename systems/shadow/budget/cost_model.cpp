#include "systems/shadow/budget/cost_model.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/limited_request.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {
namespace {

/// Largest share of a shadow's worth that coarse edges can cost. However coarse, it shows that something stands there.
constexpr double kMostByEdges = 0.5;
/// Edge error that costs half of that share: a twentieth of the height of a screen of 720 lines.
constexpr double kHalfLost_px = 36.0;
/// Speed of a thing that crosses a screen of 1280 columns in five seconds.
constexpr double kMotion_px_per_frame = 1280.0 / 300.0;
/// Factor of the depth range that one texel size serves, per cascade (light_kinds.cpp).
constexpr double kTexelsPerCascade = 2.0;
/// Share of a filter's pixels in which its first fetch does not settle the others, so that all are read.
constexpr double kSeldom = 1.0 / 8.0;

/// Clamps a share to 0..1; NaN counts as 1.
double share_in_bounds(double share) { return share < 1.0 ? std::max(share, 0.0) : 1.0; }

/// Returns the visible radius of a filter's footprint, texels.
double seen_texel(const ShadowRequest& request) {
    return static_cast<double>(request.map.filtering.widest_texel - filter_row(request.map.filter).still_texel);
}

/// Returns the mean edge error as a share of its bound, relative to a filter that counts texels. A fifth for filters
/// that test the casters' own triangles, a half for filters that average texels (docs/results/accuracy.md).
double usual_share(const FilterRow& row) {
    if (row.storage.triangle_ids) return 0.2;
    return row.reading == MapReading::depths ? 0.5 : 1.0;
}

double usual_error_px(const ShadowRequest& request, double extent_px) {
    return usual_share(filter_row(request.map.filter)) * (0.5 + seen_texel(request)) * extent_px;
}

/// Returns how much the mean edge error exceeds that of the request without limits, pixels.
double rise_px(const LightLoad& load, const ShadowRequest& given, const QualityLimits& grant) {
    const ShadowRequest& wanted = load.wanted;
    const double coarser =
        static_cast<double>(wanted.map.resolution_px) / given.map.resolution_px *
        std::pow(kTexelsPerCascade, static_cast<double>(wanted.map.view_count - given.map.view_count));
    const double extent_px = load.extent_px * coarser;
    double rise = std::max(usual_error_px(given, extent_px) - usual_error_px(wanted, load.extent_px), 0.0);
    // A narrower filter may err less, but it looks other than requested.
    rise += std::abs(seen_texel(wanted) - seen_texel(given)) * extent_px;
    return rise + 0.5 * (grant.refresh_frames - 1) * share_in_bounds(load.activity) * kMotion_px_per_frame;
}

double lookup_ns(const LightLoad& load, const ShadowRequest& given, const CostFactors& factors) {
    return load.pixels * mean_fetches(*load.light, given, given.map.filter) * kFetch_ns * factors.lighting;
}

}  // namespace

std::uint32_t refresh_frames(const LightItem& light, const QualityLimits& grant) {
    return light.tuning.reuse.economy ? grant.refresh_frames : 1;
}

double mean_fetches(const LightItem& light, const ShadowRequest& request, ShadowFilter filter) {
    const FilterRow& row = filter_row(filter);
    const bool cube = map_texture(light, request) == gl::TextureKind::cube;
    const double most = row.taps(light.tuning.kernel, cube);
    return row.reading == MapReading::depths ? 1.0 + (most - 1.0) * kSeldom : most;
}

DrawCounts count_draws(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters) {
    DrawCounts counts;
    std::uint32_t last_mesh = ~0u;
    for (const std::uint32_t i : casters) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        counts.triangles += gpu.mesh(mesh).triangles;
        counts.draws += mesh != last_mesh ? 1 : 0;
        last_mesh = mesh;
    }
    return counts;
}

double drawing_ns(const MapSettings& map, std::uint32_t edge_px, double views, double triangles, double draws) {
    const FilterRow& row = filter_row(map.filter);
    const DrawingWork& work = row.storage.work;
    const double texels = static_cast<double>(edge_px) * edge_px;
    double view_ns = work.passes * kPass_ns + texels * kTexel_ns * work.texel_bytes / DrawingWork{}.texel_bytes;
    if (row.moments) view_ns += 2.0 * (kPass_ns + texels * map.filtering.size * kFetch_ns);
    return views * view_ns + triangles * kTriangle_ns + draws * kDraw_ns;
}

double lookup_ns(const LightLoad& load, const QualityLimits& grant, const CostFactors& factors) {
    return grant.none ? 0.0 : lookup_ns(load, granted(*load.light, load.wanted, grant), factors);
}

double edge_error_cost(double rise_px) {
    return std::isfinite(rise_px) ? kMostByEdges * rise_px / (rise_px + kHalfLost_px) : kMostByEdges;
}

Cost cost_of(const LightLoad& load, const QualityLimits& grant, const CostFactors& factors) {
    const double weight = share_in_bounds(load.weight);
    if (grant.none) return {0, 0, weight};
    const ShadowRequest given = granted(*load.light, load.wanted, grant);
    Cost cost;
    cost.bytes = map_bytes(*load.light, given);
    const double share =
        static_cast<double>(given.map.view_count) / static_cast<double>(std::max(load.wanted.map.view_count, 1u));
    const double casters = share * filter_row(given.map.filter).storage.work.casters;
    const double drawing =
        drawing_ns(given.map, given.map.resolution_px, load.views * share,
                   static_cast<double>(load.triangles) * casters, static_cast<double>(load.draws) * casters);
    const double ns = drawing * share_in_bounds(load.activity) / refresh_frames(*load.light, grant) * factors.drawing +
                      lookup_ns(load, given, factors);
    constexpr double kMost_ns = 1.0e15;  // eleven days, so that sums stay in range
    cost.ns = static_cast<std::uint64_t>(ns < kMost_ns ? std::max(ns, 0.0) : kMost_ns);
    if (is_less(*load.light, load.wanted, grant))
        cost.harm = weight * edge_error_cost(std::max(rise_px(load, given, grant), 0.0));
    return cost;
}

}  // namespace gnomon::shadow
