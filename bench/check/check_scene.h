#pragma once
#include "engine/assets/scene_data.h"

namespace gnomon::bench {

/// A yard of a few boxes, a masked fence and a board overhead, with a sun, a
/// spot and a point light in its middle that cast shadows to all sides; few
/// triangles, flat surfaces, every shadow some pixels wide in a small picture.
assets::SceneData check_scene();

/// The node that a test takes away to see every row fail.
inline constexpr const char* kCheckBlock = "block";

}  // namespace gnomon::bench
