#pragma once
#include "engine/gl/device.h"
#include "systems/embed/scene_store.h"
#include "systems/embed/view_group.h"

namespace gnomon::embed {

/// Begins the maps that show drawables: clears them, and has the engine draw into them. The list submitted next draws
/// all other casters. `list`: storage. Returns a failure if maps could not be begun: they are not valid then.
gl::Failure draw_drawables(gl::Device& device, const SceneStore& store, const ViewGroup& group, gl::CommandList& list);

}  // namespace gnomon::embed
