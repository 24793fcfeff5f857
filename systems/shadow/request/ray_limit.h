#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// Prediction of the rays that lights need, and fallback of lights without room for their rays.
namespace gnomon::shadow {

/// Assumed share of a light's pixels that its map leaves undecided: more than in all but one of the scenes of
/// docs/how-to/budgets.md.
inline constexpr double kUncertainShare = 0.2;

/// Returns the pixels that look the light up: the area of its screen rectangles in all pictures.
double lookup_pixels(const SceneSnapshot& scene, const LightItem& light);

/// Returns the rays per undecided pixel.
double rays_per_pixel(const MapSettings& map);

/// Limits on the rays of all lights in one frame.
struct RayLimit {
    std::uint64_t rays = 0;     // predicted rays of all lights; 0: no limit
    bool off = false;           // no light uses rays
    bool lacks_memory = false;  // the device has no memory for the ray-tracing structures
};

/// Light that uses rays. Its importance is pixels times illuminance at the camera.
struct RayLight {
    double importance = 0.0;
    std::uint32_t light = 0;
};

/// Reasons why lights fell back to another filter. Reason::none: the light has its own filter.
struct RayFallbacks {
    std::vector<Reason> reasons;               // one per light
    std::vector<RayLight> lights;              // scratch
    std::vector<const LightFitHistory*> previous;  // scratch, one per light: its history, or null
};

/// Chooses the lights that fall back to RayRow::without_rays, so that the others use no more rays than the limit. Rays
/// are granted by falling importance. A light that fell back (`out.previous`) returns when there is room for a quarter
/// more than its rays.
void choose_fallbacks(const SceneSnapshot& scene, const RayLimit& limit, std::span<const ShadowRequest> requests,
                      RayFallbacks& out);

}  // namespace gnomon::shadow
