#pragma once
#include <cstdint>

#include "systems/shadow/frame/fit_history.h"

/// Which maps serve a spot. Up to about 120 degrees of full angle one perspective view; above, where a texel at its rim
/// would be stretched more than 1 / cos^2(60°) = 4 times, the faces of a cube whose front looks along the light.
namespace gnomon::shadow {

/// Front and four sides: a cone reaches no farther back than the light's own plane.
inline constexpr std::uint32_t kConeFaces = 5;
/// The single view's place among the layers while both exist, and among the held views always.
inline constexpr std::uint32_t kSingleView = kConeFaces;

/// One frame onward: the faces come at 122.5 degrees and go at 117.5, an eighth per frame. A light that is new, or too
/// wide for the single view at all, does not fade.
ConeFade next_cone_fade(double outer_cone_rad, const ConeFade& held);

inline bool has_single_view(int faces_eighths) { return faces_eighths < 8; }
inline bool has_faces(int faces_eighths) { return faces_eighths > 0; }

inline std::uint32_t cone_layers(int faces_eighths) {
    return (has_faces(faces_eighths) ? kConeFaces : 0) + (has_single_view(faces_eighths) ? 1 : 0);
}

}  // namespace gnomon::shadow
