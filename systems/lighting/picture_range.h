#pragma once
#include <optional>

namespace gnomon::lighting {

struct SceneLight;

/// Largest finite number of 16 bits, the precision of the picture's sum. Twin: shaders/lighting/post/picture_sum.glsl.
inline constexpr float kMostInPicture = 65504.0f;

/// Returns the picture's factor before the tone curve for a camera at this EV100.
float exposure_scale(float ev);

/// Scale of radiance in the picture before its exposure. 16 bits cover only 6e-8 to 65504; scenes range from candles of
/// 1e-6 cd to arcs of 1e12.
struct PictureRange {
    float per_radiance = 1.0f;  // picture value of radiance 1: a power of two, so that nothing is rounded
    float per_unlit = 1.0f;     // picture value of an unlit surface with exposed radiance 1
};

/// Chooses the scale by the exposure, if given (EV100). Otherwise by the incident light, or `most_emissive` without
/// any. An automatic exposure covers surfaces as close to a lamp as 1/500 of the scene's distance; brighter values are
/// clamped.
PictureRange picture_range(const SceneLight& light, float most_emissive, std::optional<float> exposure_ev);

}  // namespace gnomon::lighting
