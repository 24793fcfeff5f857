#pragma once
#include <glm/mat4x4.hpp>
#include <optional>

#include "gnomon/shadows.h"
#include "systems/extract/snapshot.h"
#include "systems/lighting/depth_picture.h"

namespace gnomon::embed {

/// Reads a projection. Empty if it is none that can be read: not finite, mirrored, sheared, or with no range of depths.
std::optional<lighting::PictureLens> lens_of(const glm::dmat4& clip_from_view, ClipDepth clip_depth);

/// Sets a consumer's place and view: the symmetric view that contains the picture, with pixels as fine. Returns false
/// if the camera's place is not rigid. `lens` follows where an orthographic view is moved back to its start.
bool put_view(const glm::dmat4& world_from_view, glm::uvec2 size_px, lighting::PictureLens& lens,
              ConsumerItem& consumer);

}  // namespace gnomon::embed
