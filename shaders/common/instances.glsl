// C++ twin: InstanceRecord in systems/extract/gpu_scene.h.
struct InstanceRecord {
    vec4 basis_x;   // xyz: image of the model's x axis; w: high part of the translation's x
    vec4 basis_y;
    vec4 basis_z;
    vec4 low;       // xyz: low part of the translation.
                    // w: bits of the layers with shadows that fall on it, plus 256 times those of the layers in which
                    // it casts. received_layers() and cast_layers() take them apart.
};
#include "common/instance_buffer.glsl"

// Returns the layers with shadows that fall on an instance: a bit per layer, 0 to 255. cast_layers() returns the layers
// in which it casts.
float received_layers(InstanceRecord instance) { return instance.low.w - 256.0 * floor(instance.low.w / 256.0); }
uint cast_layers(InstanceRecord instance) { return uint(instance.low.w) >> 8; }

// Returns a position relative to an anchor given as two floats. `precise` keeps the compiler from folding the
// differences of the high parts away; they are exact near the anchor (Sterbenz 1974).
vec3 position_from_anchor(InstanceRecord instance, vec3 position_ms, vec3 anchor_high, vec3 anchor_low) {
    vec3 high = vec3(instance.basis_x.w, instance.basis_y.w, instance.basis_z.w);
    precise vec3 offset = (high - anchor_high) + (instance.low.xyz - anchor_low);
    precise vec3 local = instance.basis_x.xyz * position_ms.x + instance.basis_y.xyz * position_ms.y +
                         instance.basis_z.xyz * position_ms.z;
    precise vec3 result = local + offset;
    return result;
}

// Turns a normal of the model into the world, of any length. The cofactor matrix requires no inverse and survives zero
// scales.
vec3 normal_from_model(InstanceRecord instance, vec3 normal_ms) {
    vec3 x = instance.basis_x.xyz, y = instance.basis_y.xyz, z = instance.basis_z.xyz;
    vec3 n = cross(y, z) * normal_ms.x + cross(z, x) * normal_ms.y + cross(x, y) * normal_ms.z;
    return dot(x, cross(y, z)) < 0.0 ? -n : n;   // mirrored: it still points out of the surface
}
