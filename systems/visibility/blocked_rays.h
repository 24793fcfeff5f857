#pragma once
#include "engine/rays/ray_packet.h"
#include "systems/visibility/caster_trees.h"

namespace gnomon::visibility {

/// Rays that a caster of these layers blocks: the walk through both levels. `trees` must be of this scene. `hint` is an
/// instance that is asked first, the last one that blocked any; it changes only the time that is needed.
rays::Lanes blocked_rays(const SceneSnapshot& scene, const CasterTrees& trees, ShadowLayers layers,
                         const rays::RayPacket& rays, std::uint32_t& hint);

}  // namespace gnomon::visibility
