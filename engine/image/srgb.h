#pragma once
#include <cmath>

/// Curve of sRGB (IEC 61966-2-1), between encoded values and light, both from 0 to 1. T: float or double.
namespace gnomon::image {

template <class T>
T light_of_srgb(T encoded) {
    return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

template <class T>
T srgb_of_light(T light) {
    return light <= T(0.0031308) ? T(12.92) * light : T(1.055) * std::pow(light, T(1.0) / T(2.4)) - T(0.055);
}

}  // namespace gnomon::image
