#pragma once
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

/// Layers that continue to show earlier casters.
namespace gnomon::shadow {

/// Returns whether a light's maps may be kept within LightShadow::refresh_error_px. A manual bias is excluded: its
/// offset does not cover a moved caster, which would darken itself.
bool may_be_held(const LightItem& light);

/// Returns the staleness of view `v` if its layer were kept. `cached`: the map cache's entry of its light. Infinite if
/// the movement of casters since the layer was drawn is unknown, or if the view itself moved.
Staleness staleness_if_held(const SceneSnapshot& scene, const UpdateInputs& inputs, std::size_t v,
                            const CachedMap& cached, std::uint64_t shown_content);

/// Keeps layers that are not up to date, where the light's error limit or a turn allows it.
void keep_stale_maps(const SceneSnapshot& scene, const UpdateInputs& inputs, std::uint64_t frame,
                     std::vector<UpdatePlan>& plans);

/// Gives all faces of a cube the greatest movement of any face. Runs once it is known which layers are kept.
void share_offsets(const UpdateInputs& inputs, std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
