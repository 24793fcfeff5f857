#include "systems/shadow/request/ray_limit.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "systems/extract/light_facts.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

/// Hysteresis: factor on the predicted rays of a light that fell back.
constexpr double kBackAgain = 1.25;

double rays_of(const SceneSnapshot& scene, const LightItem& light, const ShadowRequest& request) {
    const double pixels = lookup_pixels(scene, light) * (request.rays.only ? 1.0 : kUncertainShare);
    return pixels * rays_per_pixel(request.map);
}

/// Returns the importance of a light's shadow to the picture: pixels times illuminance at the nearest camera.
double importance_of(const SceneSnapshot& scene, const LightItem& light) {
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (const ConsumerItem& consumer : scene.consumers) {
        const glm::dvec3 way_m = light.position_ws_m - consumer.position_ws_m;
        nearest_m2 = std::min(nearest_m2, glm::dot(way_m, way_m));
    }
    constexpr double kLeast_m2 = 1.0;  // lights nearer than a metre count as at a metre
    return illuminance_lux(light, std::max(nearest_m2, kLeast_m2)) * lookup_pixels(scene, light);
}

bool uses_rays(const ShadowRequest& request) { return request.skip == Reason::none && request.rays.used; }

}  // namespace

double rays_per_pixel(const MapSettings& map) {
    const RayRow* rays = filter_row(map.filter).rays;
    return rays && rays->per_source ? map.filtering.taps : 1.0;
}

double lookup_pixels(const SceneSnapshot& scene, const LightItem& light) {
    double pixels = 0.0;
    for (const ConsumerItem& consumer : scene.pictures.empty() ? scene.consumers : scene.pictures) {
        const gl::Rect area = screen_rectangle(light, consumer);
        pixels += static_cast<double>(area.width) * area.height;
    }
    return pixels;
}

void choose_fallbacks(const SceneSnapshot& scene, const RayLimit& limit, std::span<const ShadowRequest> requests,
                      RayFallbacks& out) {
    out.reasons.assign(requests.size(), Reason::none);
    if (limit.off || limit.lacks_memory) {
        for (std::size_t i = 0; i < requests.size(); ++i)
            if (uses_rays(requests[i])) out.reasons[i] = limit.off ? Reason::rays_off : Reason::buffer_failed;
        return;
    }
    if (limit.rays == 0) return;
    out.lights.clear();
    for (std::uint32_t i = 0; i < requests.size(); ++i)
        if (uses_rays(requests[i])) out.lights.push_back({importance_of(scene, scene.lights[i]), i});
    // A stable sort would allocate.
    std::sort(out.lights.begin(), out.lights.end(), [](const RayLight& a, const RayLight& b) {
        return a.importance != b.importance ? a.importance > b.importance : a.light < b.light;
    });
    double left = static_cast<double>(limit.rays);
    for (const RayLight& candidate : out.lights) {
        const LightFitHistory* last = out.previous[candidate.light];
        const double rays = rays_of(scene, scene.lights[candidate.light], requests[candidate.light]);
        if (rays * (last && last->rays.fell_back ? kBackAgain : 1.0) <= left)
            left -= rays;
        else
            out.reasons[candidate.light] = Reason::ray_budget;
    }
}

}  // namespace gnomon::shadow
