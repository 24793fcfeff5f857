#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/ray_limit.h"

namespace gnomon::shadow {

/// Computes the largest edge of a map when LightShadow::resolution_px is 0. It is texels_per_pixel (FilterRow) times
/// the picture's larger side, divided by max_error_px where that is below 1. The result is rounded up to a multiple of
/// kLeastMap_px, within [kLeastMap_px, min(limit_px, 8192)]. max_error_px 0, negative or NaN counts as 1.
std::uint32_t automatic_resolution(glm::uvec2 viewport_px, float texels_per_pixel, float max_error_px,
                                   std::uint32_t limit_px);

/// Sets the size of the light's maps, and the filter settings that fit into that size.
void set_resolution(const LightItem& light, std::uint32_t size_px, ShadowRequest& request);

/// Sets a sun's number of cascades, and the fade between them; one cascade has none.
void set_cascades(const ShadowTuning::Cascades& tuning, std::uint32_t count, ShadowRequest& request);

/// What the device sets for all maps of a light, whatever the light requests.
struct DeviceMaps {
    std::uint32_t edge_px = 0;  // limit on a map's edge
    TriangleReferences references{};
};

/// Decides the request of a light with the given filter. Does not decide whether it is skipped. `previous`: the light's
/// history, null if it has none.
ShadowRequest request_with(const SceneSnapshot& scene, const DeviceMaps& device, const LightFitHistory* previous,
                           std::uint32_t light, ShadowFilter filter);

/// Limits the light's maps to most_px. Sets their size to that limit, or to their last size `previous_px` if that is
/// less and above 0.
void set_most(const LightItem& light, std::uint32_t most_px, std::uint32_t previous_px, ShadowRequest& request);

/// Returns true if any light requests a filter that uses rays, before the limit on rays is applied.
bool wants_rays(const SceneSnapshot& scene, const History& previous, bool shadows);

/// Inputs of the requests of a frame, beside the scene.
struct RequestInputs {
    const gl::DeviceInfo& device;
    const History& previous;  // history after the last frame
    bool shadows = true;  // false: every light counts as disabled
    RayLimit rays = {};
    TriangleReferences references = {};  // format of all maps with triangles
};

/// Decides the request of each light (stage 2), one entry per light of the snapshot, in the same order. A light without
/// a shadow has the reason in ShadowRequest::skip. `fallbacks` is overwritten.
void decide_requests(const SceneSnapshot& scene, const RequestInputs& inputs, RayFallbacks& fallbacks,
                     std::vector<ShadowRequest>& requests);

}  // namespace gnomon::shadow
