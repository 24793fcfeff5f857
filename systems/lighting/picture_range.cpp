#include "systems/lighting/picture_range.h"

#include <algorithm>
#include <cmath>

#include "systems/lighting/ambient.h"

namespace gnomon::lighting {
namespace {

/// Returns the power of two that takes `value` to [target / 2, target); 1 if it is not above 0. Its inverse is a normal
/// float, too.
float power_to(double target, double value) {
    constexpr int kMostPower = 120;
    if (!(value > 0.0)) return 1.0f;
    const double ratio = std::min(target / value, 1.0e300);
    return std::ldexp(1.0f, std::clamp(std::ilogb(ratio), -kMostPower, kMostPower));
}

}  // namespace

/// Computes the saturation-based exposure: L_max = 1.2 * 2^EV (ISO 12232; Lagarde & de Rousiers 2014, 4.2).
float exposure_scale(float ev) { return 1.0f / (1.2f * std::exp2(ev)); }

PictureRange picture_range(const SceneLight& light, float most_emissive, std::optional<float> exposure_ev) {
    // White is 8 after the exposure (shaders/lighting/post/tone_curve.glsl). That is far below the limit of 16 bits,
    // and a thousandth of a display's step is far above their minimum.
    constexpr double kExposedIn16Bits = 64.0;
    if (exposure_ev) {
        const float scale = exposure_scale(*exposure_ev);
        const float per_radiance = power_to(kExposedIn16Bits, 1.0 / static_cast<double>(scale));
        return {per_radiance, per_radiance / scale};
    }
    // Surfaces reflect about a third of a sun's light; for lamps the nearest surfaces dominate. Ambient light reaches
    // all surfaces, so that none is darker by more than its colour.
    constexpr double kAboveSun = 64.0, kAboveLamps = 0x1p20;
    const double fallen_lux = light.suns_lux + light.lamps_lux;
    const double brightest = fallen_lux > 0.0 ? std::max(kAboveSun * light.suns_lux, kAboveLamps * light.lamps_lux)
                                              : kAboveSun * static_cast<double>(most_emissive);
    const float per_radiance = power_to(static_cast<double>(kMostInPicture), brightest);
    // Estimate of what an automatic exposure shows as 1 in a picture without unlit surfaces. Middle grey is 0.18 of
    // that, and a surface's radiance a sixth of the incident light.
    const double typical = fallen_lux > 0.0 ? fallen_lux : static_cast<double>(most_emissive);
    const double shown_as_one = typical > 0.0 ? typical : 1.0;
    return {per_radiance, static_cast<float>(static_cast<double>(per_radiance) * shown_as_one)};
}

}  // namespace gnomon::lighting
