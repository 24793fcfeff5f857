#pragma once
#include "gnomon/assets.h"

namespace gnomon::bench {

/// Makes a yard of a few boxes, a masked fence and a board overhead. A sun, a spot, area
/// lights and a point light in its middle cast shadows to all sides. Triangles are few,
/// surfaces flat, and every shadow is some pixels wide in a small picture.
assets::SceneData check_scene();

/// The node that a test takes away to see every row fail.
inline constexpr const char* kCheckBlock = "block";

}  // namespace gnomon::bench
