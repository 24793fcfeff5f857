// Half axes of an area light as a receiver sees it, in the world.
#include "shadow/lookup/source_place.glsl"

struct SourceAxes { vec3 middle_m, right_m, up_m; };

// Returns half axes of the source. A round one is taken as what faces the receiver: a disk of a sphere, a strip of a
// tube.
SourceAxes area_axes(vec3 position_ca) {
    AreaSource source = source_seen(light.position.xyz + light.low.xyz - position_ca);
    vec3 first = source.right, second = source.up;
    if (kShape == kSphereShape) {
        mat3 axes = axes_around(normalize(source.middle_m));
        first = axes[0];
        second = axes[1];
    }
    vec3 beside = cross(source.right, source.middle_m);
    if (kShape == kTubeShape && dot(beside, beside) > 0.0) second = normalize(beside);
    return SourceAxes(source.middle_m, first * source.half_width_m, second * source.half_height_m);
}
