#pragma once
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

/// Layers that go on showing casters as they were.
namespace gnomon::shadow {

/// Whether a light's maps may be kept within LightShadow::refresh_error_px. An offset that is chosen by hand says
/// nothing of what keeps a moved caster from darkening itself.
bool may_be_held(const LightItem& light);

/// Returns what keeping the layer of view `v` would mean, whose light the store remembers as `history`. Infinite: it
/// is not known how far casters moved since it was drawn, or the view itself moved.
Staleness staleness_if_held(const SceneSnapshot& scene, const UpdateInputs& inputs, std::size_t v,
                            const LightHistory& history, std::uint64_t shown_content);

/// Keeps the layers that may be kept, of those that do not hold what they should.
void keep_stale_maps(const SceneSnapshot& scene, const UpdateInputs& inputs, std::uint64_t frame,
                     std::vector<UpdatePlan>& plans);

/// Gives all faces of a cube the offset of the one whose casters moved farthest, once it is known which are kept.
void share_offsets(const UpdateInputs& inputs, std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
