#pragma once
#include "engine/rays/ray_packet.h"
#include "systems/visibility/caster_trees.h"

namespace gnomon::visibility {

/// Returns the rays that a caster of these layers blocks: the walk through both levels. `trees` must belong to the
/// scene. `hint`: instance to test first, set to the last one with a hit; it affects only time.
rays::Lanes blocked_rays(const SceneSnapshot& scene, const CasterTrees& trees, ShadowLayers layers,
                         const rays::RayPacket& rays, std::uint32_t& hint);

}  // namespace gnomon::visibility
