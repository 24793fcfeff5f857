// Bound on the rounding of position_from_anchor(). C++ twins of the constants: systems/shadow/exact/error_margins.h.
#include "common/instances.glsl"
#include "common/float_rounding.glsl"
const float kPlacedUnits = 6.0;            // rounding of basis, products, translation and anchor, 2^-24 of the sum
const float kSplitUnits = 3.5527137e-15;   // 2^-48: rounding of a position given as two floats, as a share of it

// Returns how far off position_from_anchor() may be along each axis, metres.
vec3 placed_error_m(InstanceRecord instance, vec3 position_ms, vec3 anchor_high, vec3 anchor_low) {
    vec3 high = vec3(instance.basis_x.w, instance.basis_y.w, instance.basis_z.w), size_ms = abs(position_ms);
    vec3 local = abs(instance.basis_x.xyz) * size_ms.x + abs(instance.basis_y.xyz) * size_ms.y + abs(instance.basis_z.xyz) * size_ms.z;
    vec3 offset = abs((high - anchor_high) + (instance.low.xyz - anchor_low));
    return kPlacedUnits * kUnitRoundoff * (local + offset) + kSplitUnits * (abs(high) + abs(anchor_high));
}
