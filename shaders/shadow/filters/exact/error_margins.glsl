// Margins of sheets; docs/explanation/exact_proof.md derives them. C++ twins: systems/shadow/exact/error_margins.h.
// SHEETS_WITHOUT_MARGINS: none of them, to show in tests that they are needed.
#include "common/float_rounding.glsl"
#ifdef SHEETS_WITHOUT_MARGINS
const bool kHasMargins = false;
const float kRoundings = 0.0;
const float kTexelHalf = 0.5;
const float kDepartureFactor = 1.0;
#else
const bool kHasMargins = true;
const float kRoundings = 1.0;         // share of all that follows from rounding
const float kTexelHalf = 0.516;       // half of a texel, and how far off a receiver's place may be, texels
const float kDepartureFactor = 1.13;
#endif
const float kProjectedUnits = 4.0;    // rounding of a row of the projection, 2^-24
const float kMostMoved_texel = 0.05;  // most that rounding moves a place across the map
const float kStoredUnits = 8.0;       // rounding of a depth as it is interpolated, stored and compared, 2^-24
const float kFloorTangent = 4.0;      // tangent between normal and light, up to which no facet is drawn (BoundsFloor)
const float kUnknownDeparture = 1e6;

mat4 absolute(mat4 m) { return mat4(abs(m[0]), abs(m[1]), abs(m[2]), abs(m[3])); }
