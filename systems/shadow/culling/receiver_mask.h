#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/receiver_mask.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Finds the receivers of a light that the only camera may see: in its frustum, and hidden by none of
/// `sets.occluders`. In no particular order. Cost: a walk of the scene's tree; whole branches are hidden at once.
void find_seen_receivers(const SceneSnapshot& scene, const LightItem& light, const ReceiverCasterSets& sets,
                         const InstanceLayers& layers, std::vector<std::uint32_t>& seen);

/// Covers the cells of a cascade's map that `receivers` lie in, as a sun sees them, `reach_m` around included.
/// (Bittner et al. 2011, "Shadow caster culling for efficient shadow mapping", with boxes in place of pixels.)
void build_receiver_mask(const SceneSnapshot& scene, std::span<const std::uint32_t> receivers, const ShadowView& view,
                         const glm::dvec2& reach_m, ReceiverMask& mask);

/// Returns whether the box lies before or behind any covered cell, seen along the light.
bool covers(const ReceiverMask& mask, const math::Aabb& box_ws);

}  // namespace gnomon::shadow
