#pragma once
#include <glm/mat4x4.hpp>
#include <optional>

#include "gnomon/shadows.h"
#include "systems/extract/snapshot.h"
#include "systems/lighting/depth_picture.h"

namespace gnomon::embed {

/// Reads a projection. Empty if it is none that can be read: not finite, mirrored, sheared, or with no range of depths.
std::optional<lighting::PictureLens> lens_of(const glm::dmat4& clip_from_view, ClipDepth clip_depth);

/// How far a picture lies off its view's axis, as shadows are fitted to it. It outlasts a frame, so that fits do not
/// follow a camera's jitter.
struct PictureReach {
    glm::uvec2 size_px{0, 0};
    glm::dvec2 half{0.0}, shift{0.0};  // PictureLens, as last seen
    glm::dvec2 reach{0.0};             // at least |shift|
    bool jitters = false;              // it has a pixel more
};

/// Updates the reach. Without jitter it is |shift|. Jitter is a shift of less than a pixel, or a movement of the shift
/// by at most two pixels while size and angle stay. The reach then has a pixel more, and stays while that suffices.
void update_reach(const lighting::PictureLens& lens, glm::uvec2 size_px, PictureReach& reach);

/// Sets a consumer's place and view: the symmetric view that contains the picture and its reach, with pixels as fine.
/// Returns false if the camera's place is not rigid. `lens` follows where an orthographic view is moved back to its
/// start.
bool put_view(const glm::dmat4& world_from_view, const PictureReach& reach, lighting::PictureLens& lens,
              ConsumerItem& consumer);

}  // namespace gnomon::embed
