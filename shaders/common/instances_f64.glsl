// Instances in double, where floats leave open what decides.
#include "common/instances.glsl"

// Returns the instance's own origin from an anchor, metres.
dvec3 exact_origin(InstanceRecord instance, vec3 anchor_high, vec3 anchor_low) {
    vec3 high = vec3(instance.basis_x.w, instance.basis_y.w, instance.basis_z.w);
    return (dvec3(high) - dvec3(anchor_high)) + (dvec3(instance.low.xyz) - dvec3(anchor_low));
}

dvec3 exact_image(InstanceRecord instance, vec3 along_ms) {
    return dvec3(instance.basis_x.xyz) * double(along_ms.x) + dvec3(instance.basis_y.xyz) * double(along_ms.y) +
           dvec3(instance.basis_z.xyz) * double(along_ms.z);
}

// Turns a normal of the model into the world: not toward any side, of any length.
dvec3 exact_normal(InstanceRecord instance, dvec3 normal_ms) {
    dvec3 x = dvec3(instance.basis_x.xyz), y = dvec3(instance.basis_y.xyz), z = dvec3(instance.basis_z.xyz);
    return cross(y, z) * normal_ms.x + cross(z, x) * normal_ms.y + cross(x, y) * normal_ms.z;
}
