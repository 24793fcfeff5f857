#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// How many rays lights ask, before any is counted; and what follows from that.
namespace gnomon::shadow {

/// Of the pixels that ask a light, so many its map is taken not to be certain of: more than in all but one of the
/// scenes of docs/exact.md.
inline constexpr double kUncertainShare = 0.2;

/// Pixels that ask the light: of its rectangles in all pictures.
double asking_pixels(const SceneSnapshot& scene, const LightItem& light);

/// Returns the rays for each of those pixels of which the map is not certain.
double rays_per_pixel(const MapSettings& map);

/// What lights may use of rays in one frame.
struct RayLimit {
    std::uint64_t rays = 0;     // predicted rays of all lights; 0: any number
    bool lacks_memory = false;  // the device has no room for what rays walk
};

/// A light that uses rays, and what its shadow means to the picture: pixels times illuminance at the camera.
struct RayLight {
    double importance = 0.0;
    std::uint32_t light = 0;
};

/// Lights whose filter another one stands in for, with the reason; Reason::none: its own filter stays.
struct RayFallbacks {
    std::vector<Reason> reasons;   // one per light
    std::vector<RayLight> lights;  // scratch
};

/// Chooses which lights fall back to RayRow::without_rays until the others use no more rays than the limit: first the
/// lights that mean least to the picture. A light that fell back returns when there is room for a quarter more than it
/// uses.
void choose_fallbacks(const SceneSnapshot& scene, const History& held, const RayLimit& limit,
                      std::span<const ShadowRequest> requests, RayFallbacks& out);

}  // namespace gnomon::shadow
