#pragma once
#include <cstdint>

#include "systems/shadow/frame/fit_history.h"

/// Maps of a spot: one perspective view up to a full angle of about 120 degrees, cube faces above. There a texel at the
/// rim of a single view would be stretched by more than 1 / cos^2(60°) = 4. The cube's front looks along the light.
namespace gnomon::shadow {

/// Number of cube faces: front and four sides. A cone does not extend behind the light's own plane.
inline constexpr std::uint32_t kConeFaces = 5;
/// Layer of the single view while both exist; always its index in the fit history.
inline constexpr std::uint32_t kSingleView = kConeFaces;

/// Computes the transition of this frame from the last one, `previous`. Faces fade in above 122.5 degrees and out below
/// 117.5, by an eighth per frame. A new light, or one too wide for a single view, switches at once.
SpotCubeTransition next_spot_cube_transition(double outer_cone_rad, const SpotCubeTransition& previous);

inline bool has_single_view(int cube_blend_eighths) { return cube_blend_eighths < 8; }
inline bool has_faces(int cube_blend_eighths) { return cube_blend_eighths > 0; }

inline std::uint32_t cone_layers(int cube_blend_eighths) {
    return (has_faces(cube_blend_eighths) ? kConeFaces : 0) + (has_single_view(cube_blend_eighths) ? 1 : 0);
}

}  // namespace gnomon::shadow
