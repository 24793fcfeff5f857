#pragma once
#include <gnomon/assets.h>

#include <cstdint>

/// What all of the stranger's programs draw: a square of 8 m at y = 0, and a box of 1 m around its origin.
inline constexpr std::uint32_t kGroundMesh = 0, kBoxMesh = 1;
gnomon::assets::MeshLibrary ground_and_box();

// The stage. Seen from above the picture is 4 m wide and high, x to the right, -z up. The box floats at 1 m. The sun
// shines along (1, -1, 0). So the box darkens the ground from x = 0 to 2 m, and hides it from -0.5 to 0.5 m.
inline constexpr int kPicture_px = 64;
inline constexpr double kHalfHeight_m = 2.0, kBoxHeight_m = 1.0, kEyeHeight_m = 10.0;
constexpr int column_of(double x_m) { return static_cast<int>((x_m / kHalfHeight_m + 1.0) * 0.5 * kPicture_px); }
inline constexpr int kMiddleRow = kPicture_px / 2;
inline constexpr int kShadowedColumn = column_of(1.25), kLitColumn = column_of(-1.25);

/// Returns whether the sRGB value `shadowed` has about half the light of `lit`, or less: in the shadow the sky's light
/// is left.
constexpr bool is_darker(int shadowed, int lit) { return 4 * shadowed < 3 * lit; }
