// Rounding facts used by the bias (docs/explanation/bias.md, "Rounding").
const float kUnitRoundoff = 5.9604645e-8;     // 2^-24, half a unit in the last place of a float
const float kRasterSnap_texel = 0.00390625;   // 1/256: vertices are snapped to 8 sub-texel bits
const float kRebuiltRelative = 1.6e-7;        // error of a position rebuilt from depth, per metre of distance
// The same of an orthographic view, per metre of its range: kOrthographicRounding
// (systems/shadow/projection/depth_rounding.cpp), and far - depth * range.
const float kFlatRebuiltRelative = 5.5 * kUnitRoundoff;
// Rounding of the way into a map, metres per metre of coordinate sum: subtraction, axes, a matrix row (8u). It counts
// 1.5 times for what lies sideways and is seen through the slope.
const float kPositionRounding = 12.0 * kUnitRoundoff;
const float kNormalError_rad = 4.3e-5;        // octahedral normals in two signed 16-bit numbers: sqrt(2) * 2^-15,
                                              // either axis
