#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/ray_limit.h"

namespace gnomon::shadow {

/// Most texels along a map's edge when LightShadow::resolution_px is 0: the multiple of kLeastMap_px at or above
/// texels_per_pixel (FilterRow) times the picture's larger side, divided by max_error_px where that is below 1; within
/// [kLeastMap_px, min(limit_px, 8192)]. max_error_px not above 0, or NaN, counts as 1.
std::uint32_t automatic_resolution(glm::uvec2 viewport_px, float texels_per_pixel, float max_error_px,
                                   std::uint32_t limit_px);

/// Sets the size of the light's maps, and what of its filter's settings they bear.
void set_resolution(const LightItem& light, std::uint32_t size_px, ShadowRequest& request);

/// Sets how many cascades a sun has, and whether they fade into each other.
void set_cascades(const ShadowTuning::Cascades& tuning, std::uint32_t count, ShadowRequest& request);

/// What the light of that index deserves with that filter, if it deserves anything.
ShadowRequest request_of(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held,
                         std::uint32_t light, ShadowFilter filter);

/// The same within the device's limit on a map's edge; `held`: what the light's last fit left, null if there is none.
ShadowRequest request_with(const SceneSnapshot& scene, std::uint32_t limit_px, const HeldLight* held,
                           std::uint32_t light, ShadowFilter filter);

/// Sets the size of the light's maps to the most they may have, or to `held_px`, their last one, if that is less and
/// above 0.
void set_most(const LightItem& light, std::uint32_t most_px, std::uint32_t held_px, ShadowRequest& request);

/// Says whether any light asks for a filter that uses rays, before their limit is known.
bool wants_rays(const SceneSnapshot& scene, const History& held, bool shadows);

/// What the requests of a frame follow from, beside the scene.
struct RequestInputs {
    const gl::DeviceInfo& device;
    const History& held;  // what the fits left last frame
    bool shadows = true;  // false: every light counts as disabled
    RayLimit rays = {};
};

/// Stage 2: decides what each light asks for, one entry per light of the snapshot, same order. A light that asks for
/// nothing says why in ShadowRequest::skip. `fallbacks` is overwritten.
void decide_requests(const SceneSnapshot& scene, const RequestInputs& inputs, RayFallbacks& fallbacks,
                     std::vector<ShadowRequest>& requests);

}  // namespace gnomon::shadow
