#include "systems/truth/error_colours.h"

#include <algorithm>
#include <cmath>

namespace gnomon::truth {
namespace {

constexpr Colour kBlack{0, 0, 0, 255}, kGrey{70, 70, 70, 255}, kGreen{60, 170, 80, 255}, kDark{25, 45, 30, 255},
    kRed{255, 40, 40, 255}, kBlue{60, 120, 255, 255}, kYellow{255, 220, 0, 255}, kWhite{255, 255, 255, 255},
    kNoSurface{60, 0, 80, 255};
constexpr float kHalf = 0.5f;
constexpr float kByteMax = 255.0f;

std::uint8_t to_byte(float share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0f, 1.0f) * kByteMax + kHalf);
}

Colour mix(const Colour& a, const Colour& b, float share) {
    Colour mixed = a;
    for (std::size_t i = 0; i < mixed.size(); ++i)
        mixed[i] = to_byte(std::lerp(static_cast<float>(a[i]), static_cast<float>(b[i]), share) / kByteMax);
    return mixed;
}

}  // namespace

Colour visibility_colour(float visibility) {
    if (!(visibility >= 0.0f)) return kNoSurface;
    const std::uint8_t level = to_byte(visibility);
    return {level, level, level, 255};
}

Colour error_colour(const ComparedPixel& pixel) {
    if (!pixel.scored) return pixel.truth < 0.0f ? kBlack : kGrey;
    if (pixel.ambiguous) return kWhite;
    if (!(pixel.measured >= 0.0f)) return kYellow;
    if (pixel.truth >= kHalf) return pixel.measured >= kHalf ? kGreen : kRed;
    return pixel.measured >= kHalf ? kBlue : kDark;
}

Colour soft_error_colour(const ComparedPixel& pixel) {
    if (!pixel.scored) return pixel.truth < 0.0f ? kBlack : kGrey;
    if (!(pixel.measured >= 0.0f)) return kYellow;
    const float more = pixel.measured - pixel.truth;
    return mix(mix(kDark, kGreen, pixel.truth), more < 0.0f ? kRed : kBlue, std::min(std::abs(more), 1.0f));
}

}  // namespace gnomon::truth
