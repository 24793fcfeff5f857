#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// The casters of one fitted view: those that can darken what is seen in it, the filter's width included; of a held
/// view all that its map can show. Appends to frame.view_caster_items, by mesh, then by index, and sets view.casters.
void select_view_casters(const SceneSnapshot& scene, ShadowView& view, ShadowFrame& frame);

}  // namespace gnomon::shadow
