#include "systems/shadow/budget/ray_budget.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/core/signature.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

/// What a ray costs, and in rays what else does: a triangle of a caster, drawn three times and measured; a texel of a
/// map, cleared and written as often; a pixel's verdict. Ratios of one run (docs/exact.md, "What it costs").
constexpr double kTriangle_rays = 2.5, kTexel_rays = 0.1, kVerdict_rays = 0.15;
/// Room that a light needs to come back.
constexpr double kBackAgain = 1.25;

double rays_of(const SceneSnapshot& scene, const ShadowDemand& demand) {
    const double pixels = asking_pixels(scene, scene.lights[demand.light]) * (demand.traced ? 1.0 : kUncertainShare);
    return pixels * rays_per_pixel(demand);
}

/// What a light's shadow means to the picture, to compare lights by: pixels times illuminance at the camera.
double meaning(const SceneSnapshot& scene, const LightItem& light) {
    const double emitted = static_cast<double>(light.intensity) *
                           static_cast<double>(std::max({light.colour.r, light.colour.g, light.colour.b}));
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (const ConsumerItem& consumer : scene.consumers) {
        const glm::dvec3 way_m = light.position_ws_m - consumer.position_ws_m;
        nearest_m2 = std::min(nearest_m2, glm::dot(way_m, way_m));
    }
    constexpr double kLeast_m2 = 1.0;  // nearer than a metre all is as bright as there
    const double lux = light.kind == LightKind::directional ? emitted : emitted / std::max(nearest_m2, kLeast_m2);
    return lux * asking_pixels(scene, light);
}

/// Where the cameras stand.
std::uint64_t pictures_of(const SceneSnapshot& scene) {
    Signature s;
    for (const ConsumerItem& camera : scene.pictures.empty() ? scene.consumers : scene.pictures) {
        for (int i = 0; i < 3; ++i) s.add(camera.position_ws_m[i]);
        for (int i = 0; i < 9; ++i) s.add(camera.rotation_ws[i / 3][i % 3]);
    }
    return s.value();
}

void give_way(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, Reason reason,
              ShadowDemand& demand) {
    demand = demand_of(scene, device, held, demand.light, filtered_row(demand.filter));
    demand.gives_way = true;
    demand.note = reason;
}

}  // namespace

double rays_per_pixel(const ShadowDemand& demand) {
    return filter_row(demand.filter).storage == FilterStorage::soft_sheets ? demand.filtering.taps : 1.0;
}

double asking_pixels(const SceneSnapshot& scene, const LightItem& light) {
    double pixels = 0.0;
    for (const ConsumerItem& consumer : scene.pictures.empty() ? scene.consumers : scene.pictures) {
        const gl::Rect area = screen_rectangle(light, consumer);
        pixels += static_cast<double>(area.width) * area.height;
    }
    return pixels;
}

void limit_rays(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, std::uint64_t most_rays,
                std::vector<ShadowDemand>& demands, std::vector<RayAsker>& asking) {
    if (most_rays == 0) return;
    asking.clear();
    for (const ShadowDemand& demand : demands)
        if (demand.skip == Reason::none && demand.asks_rays)
            asking.push_back({meaning(scene, scene.lights[demand.light]), demand.light});
    // A stable sort would allocate.
    std::sort(asking.begin(), asking.end(), [](const RayAsker& a, const RayAsker& b) {
        return a.meaning != b.meaning ? a.meaning > b.meaning : a.light < b.light;
    });
    double left = static_cast<double>(most_rays);
    for (const RayAsker& asker : asking) {
        const std::uint32_t i = asker.light;
        const HeldLight* last = find(held, scene.lights[i].entity, i);
        const double rays = rays_of(scene, demands[i]);
        if (rays * (last && last->gave_way ? kBackAgain : 1.0) <= left) {
            left -= rays;
            continue;
        }
        give_way(scene, device, held, Reason::ray_budget, demands[i]);
    }
}

void give_rays_up(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held,
                  std::vector<ShadowDemand>& demands) {
    for (ShadowDemand& demand : demands)
        if (demand.skip == Reason::none && demand.asks_rays)
            give_way(scene, device, held, Reason::buffer_failed, demand);
}

void count_quiet_frames(const SceneSnapshot& scene, const History& held, ShadowFrame& frame) {
    History& next = frame.next_history;
    const bool any = std::any_of(frame.demands.begin(), frame.demands.end(),
                                 [](const ShadowDemand& d) { return d.skip == Reason::none && d.asks_rays; });
    next.pictures = any ? pictures_of(scene) : 0;
    if (!any) return;
    const bool moved = held.pictures != next.pictures;
    std::size_t v = 0;
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d) {
        const LightItem& light = scene.lights[frame.demands[d].light];
        Signature casters;
        casters.add(light.shape_version);
        const std::size_t first = v;
        for (; v < frame.views.size() && frame.views[v].demand == d; ++v)
            for (const std::uint32_t i : casters_of(frame, frame.views[v])) {
                casters.add(std::uint64_t{scene.instances[i].gpu_slot});
                casters.add(scene.instances[i].version);
            }
        if (v == first || !frame.demands[d].asks_rays) continue;
        for (HeldLight& entry : next.lights) {
            if (entry.light != light.entity) continue;
            const bool same = entry.casters == casters.value() && light.tuning.reuse.economy && !frame.shared_out;
            entry.casters = casters.value();
            entry.quiet_frames = same ? std::min(entry.quiet_frames + (moved ? 1 : 0), kQuietFrames) : 0;
        }
    }
}

bool are_rays_cheaper(double pixels, double rays_per_pixel, const SheetLoad& load) {
    const double drawn = load.triangles * kTriangle_rays + load.texels * kTexel_rays;
    return pixels * rays_per_pixel < drawn + pixels * (kVerdict_rays + kUncertainShare * rays_per_pixel);
}

}  // namespace gnomon::shadow
