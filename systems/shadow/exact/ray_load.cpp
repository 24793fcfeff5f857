#include "systems/shadow/exact/ray_load.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "systems/shadow/demand.h"
#include "systems/shadow/publish.h"

namespace gnomon::shadow {
namespace {

/// What a ray costs, and in rays what else does: a triangle of a caster, drawn three times and measured; a texel of a
/// map, cleared and written as often; a pixel's verdict. Ratios of one run (docs/exact.md, "What it costs").
constexpr double kTriangle_rays = 1.5, kTexel_rays = 0.1, kVerdict_rays = 0.15;
/// Room that a light needs to come back.
constexpr double kBackAgain = 1.25;

double rays_of(const SceneSnapshot& scene, const ShadowDemand& demand) {
    return asking_pixels(scene, scene.lights[demand.light]) * (demand.traced ? 1.0 : kUncertainShare);
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

}  // namespace

double asking_pixels(const SceneSnapshot& scene, const LightItem& light) {
    double pixels = 0.0;
    for (const ConsumerItem& consumer : scene.pictures.empty() ? scene.consumers : scene.pictures) {
        const gl::Rect area = screen_rectangle(light, consumer);
        pixels += static_cast<double>(area.width) * area.height;
    }
    return pixels;
}

void limit_rays(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, std::uint64_t most_rays,
                std::vector<ShadowDemand>& demands, std::vector<std::uint32_t>& asking) {
    if (most_rays == 0) return;
    asking.clear();
    for (const ShadowDemand& demand : demands)
        if (demand.skip == Reason::none && demand.asks_rays) asking.push_back(demand.light);
    // A stable sort would allocate.
    std::sort(asking.begin(), asking.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double first = meaning(scene, scene.lights[a]), second = meaning(scene, scene.lights[b]);
        return first != second ? first > second : a < b;
    });
    double left = static_cast<double>(most_rays);
    for (const std::uint32_t i : asking) {
        const HeldLight* last = find(held, scene.lights[i].entity, i);
        const double rays = rays_of(scene, demands[i]);
        if (rays * (last && last->gave_way ? kBackAgain : 1.0) <= left) {
            left -= rays;
            continue;
        }
        demands[i] = demand_of(scene, device, held, i, kFilteredRow);
        demands[i].gives_way = true;
        demands[i].note = Reason::ray_budget;
    }
}

bool are_rays_cheaper(double pixels, const SheetLoad& load) {
    const double drawn = load.triangles * kTriangle_rays + load.texels * kTexel_rays;
    return pixels < drawn + pixels * (kVerdict_rays + kUncertainShare);
}

}  // namespace gnomon::shadow
