#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// Map edge when LightShadow::resolution_px is 0, from the picture's larger side: a power of two, at least `texels_per_px`
/// times that side (see demand.cpp for the figures), within [256, limit_px].
std::uint32_t automatic_resolution(LightKind kind, glm::uvec2 viewport_px, std::uint32_t limit_px);

/// Stage 2: what each light deserves, one entry per light of the snapshot, same order. What nobody wants ends here.
/// `shadows` false treats every light as disabled.
void decide_demand(const SceneSnapshot& scene, const gl::DeviceInfo& device, bool shadows,
                   std::vector<ShadowDemand>& demands);

}  // namespace gnomon::shadow
