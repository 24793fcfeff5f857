#include "systems/shadow/request/limited_request.h"

#include <algorithm>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

bool has_cascades(const LightItem& light, const ShadowRequest& request) {
    return light_facts(light.kind).parallel && request.map.view_count > 1 &&
           light.tuning.cascades.splits != CascadeSplits::manual;  // manual splits name all cascades
}

}  // namespace

ShadowRequest granted(const LightItem& light, const ShadowRequest& wanted, const QualityLimits& grant) {
    ShadowRequest request = wanted;
    if (grant.none) return request;
    if (grant.plain) request.map.filter = kCheapestFilter;
    request.rays.used = request.rays.used && !grant.plain;
    if (has_cascades(light, wanted)) {
        request.map.view_count = std::clamp(grant.most_views, 1u, wanted.map.view_count);
        request.limits.max_views = std::min(wanted.limits.max_views, std::max(grant.most_views, 1u));
        if (request.map.view_count == 1) request.map.cascade_blend = 0.0f;
    }
    request.limits.max_px = std::min(wanted.limits.max_px, grant.most_px);
    const std::uint32_t edge_px = std::min(wanted.map.resolution_px, request.limits.max_px);
    if (edge_px != wanted.map.resolution_px || request.map.filter != wanted.map.filter)
        set_resolution(light, edge_px, request);
    return request;
}

bool is_less(const LightItem& light, const ShadowRequest& wanted, const QualityLimits& grant) {
    return grant.none || (grant.plain && wanted.map.filter != kCheapestFilter) ||
           grant.most_px < wanted.map.resolution_px ||
           (has_cascades(light, wanted) && grant.most_views < wanted.map.view_count) ||
           (grant.refresh_frames > 1 && light.tuning.reuse.economy);
}

void apply_last_limits(const SceneSnapshot& scene, const History& previous, std::span<const ShadowRequest> requests,
                       std::vector<ShadowRequest>& limited) {
    limited.assign(requests.begin(), requests.end());
    std::size_t guess = 0;
    for (std::size_t i = 0; i < limited.size(); ++i) {
        if (limited[i].skip != Reason::none) continue;
        const LightFitHistory* last = find(previous, scene.lights[i].entity, guess++);
        if (last && !last->budget.grant.none) limited[i] = granted(scene.lights[i], limited[i], last->budget.grant);
    }
}

}  // namespace gnomon::shadow
