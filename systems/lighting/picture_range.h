#pragma once
#include <optional>

namespace gnomon::lighting {

struct SceneLight;

/// The greatest finite number of 16 bits, in which the picture is summed up. Twin:
/// shaders/lighting/post/picture_sum.glsl.
inline constexpr float kMostInPicture = 65504.0f;

/// By what the picture of a camera at this EV100 is multiplied before the tone curve.
float exposure_scale(float ev);

/// How radiance is held in the picture before its exposure: 16 bits reach from 6e-8 to 65504 only, scenes from candles
/// of 1e-6 cd to arcs of 1e12.
struct PictureRange {
    float per_radiance = 1.0f;  // what the picture holds of a radiance of 1: a power of two, so that nothing is rounded
    float per_unlit = 1.0f;     // and of what is unlit and shown as an exposed radiance of 1
};

/// By the exposure where it is given (EV100); else by what falls on the scene, `most_emissive` where nothing does. An
/// automatic exposure follows lamps as near to a surface as a 500th of the scene's distance from them; what is brighter
/// is cut.
PictureRange picture_range(const SceneLight& light, float most_emissive, std::optional<float> exposure_ev);

}  // namespace gnomon::lighting
