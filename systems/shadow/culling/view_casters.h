#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// The casters of one fitted view: those that can darken what is seen in it, the filter's width included; of a held
/// view all that its map can show. Appends to frame.view_caster_items, those that move last, by mesh, then by index,
/// and sets view.casters and view.still_casters. This is the one place that decides in which order they are drawn.
void select_view_casters(const SceneSnapshot& scene, ShadowView& view, ShadowFrame& frame);

}  // namespace gnomon::shadow
