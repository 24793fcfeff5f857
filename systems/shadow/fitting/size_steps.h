#pragma once
#include <array>
#include <cmath>

/// Geometric steps of 2^(1/4). A fit rounded to them stays while the camera moves a little. Scaling a scene by a power
/// of two shifts every step by a whole number, so that sizes scale exactly.
namespace gnomon::shadow {

inline constexpr int kStepsPerOctave = 4;

/// Returns 2^(step / 4), exact to the last bit at every fourth step.
inline double step_size(int step) {
    constexpr std::array<double, kStepsPerOctave> kQuarters = {1.0, 1.189207115002721, 1.4142135623730951,
                                                               1.681792830507429};
    const int octave = step >> 2;  // rounds down, below zero too
    return std::ldexp(kQuarters[static_cast<std::size_t>(step - octave * kStepsPerOctave)], octave);
}

/// Returns the smallest step with a size of at least `size`; the function after it the largest with at most `size`.
/// `size` must be positive and finite.
inline int step_at_or_above(double size) {
    int octave = 0;
    std::frexp(size, &octave);  // size in [2^(octave - 1), 2^octave)
    int step = (octave - 1) * kStepsPerOctave;
    while (step_size(step) < size) ++step;
    return step;
}
inline int step_at_or_below(double size) {
    const int above = step_at_or_above(size);
    return step_size(above) > size ? above - 1 : above;
}

/// Returns the last step while it bounds `size` from above (below) by at most `slack` steps beyond the closest one.
/// Else returns the closest. Growth is followed at once, shrinking only when it is worth a redrawn map.
inline int hold_above(double size, bool used, int previous_step, int slack) {
    const int closest = step_at_or_above(size);
    return used && previous_step >= closest && previous_step <= closest + slack ? previous_step : closest;
}
inline int hold_below(double size, bool used, int previous_step, int slack) {
    const int closest = step_at_or_below(size);
    return used && previous_step <= closest && previous_step >= closest - slack ? previous_step : closest;
}

}  // namespace gnomon::shadow
