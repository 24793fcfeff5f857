// An area light as the receiver sees it in a map. Straight lines stay straight there, with depth as their length: a place
// of the source is a direction.
#include "shadow/lookup/source_place.glsl"
const float kNearestPlace = 0.2;   // least share of the receiver's depth that a place of the source is off it

struct MapSource {
    vec3 first_m, second_m;   // half axes, in the map's u, v and toward the light
    float z_m;                // the receiver's distance along the view's axis
};
MapSource map_source = MapSource(vec3(0.0), vec3(0.0), 1.0);   // as the receiver sees it

#ifdef SHADOW_CUBE
// Returns a vector's parts along u, v and the way toward the light, in the point's face.
vec3 in_view(ShadowPoint point, vec3 v) { return turned_back(v) * face_axes(point.position); }

float view_distance_m(ShadowPoint point) { return largest(point.position); }
#else
// Returns a vector's parts along u, v and the way toward the light, in the point's view.
vec3 in_view(ShadowPoint point, vec3 v) {
    ViewRecord view = light.views[point.view];
    return vec3(dot(v, view.axis_u.xyz), dot(v, view.axis_v.xyz), dot(v, view.axis_back.xyz));
}

float view_distance_m(ShadowPoint point) {
    ViewRecord view = light.views[point.view];
    return view.axis_back.w / max(point.reference - view.numeric.z, 1e-30);
}
#endif

// Returns half axes of the source. A round one is taken as what faces the receiver: a disk of a sphere, a strip of a
// tube.
MapSource source_on_map(ShadowPoint point) {
    AreaSource source = source_seen(light.position.xyz + light.low.xyz - point.position_ca);
    vec3 first = source.right, second = source.up;
    if (kShape == kSphereShape) {
        mat3 axes = axes_around(normalize(source.middle_m));
        first = axes[0];
        second = axes[1];
    }
    vec3 beside = cross(source.right, source.middle_m);
    if (kShape == kTubeShape && dot(beside, beside) > 0.0) second = normalize(beside);
    MapSource seen;
    seen.first_m = in_view(point, first * source.half_width_m);
    seen.second_m = in_view(point, second * source.half_height_m);
    seen.z_m = view_distance_m(point);
    return seen;
}

// Returns a place of the disk as texels from the receiver, at depth 1 of the cone. The square's places are those of a
// disk of equal areas.
vec2 on_map(ShadowPoint point, vec2 disk) {
    vec2 at = kSquarePlaces ? disk_to_square(disk) : disk;
    vec3 place_m = map_source.first_m * at.x + map_source.second_m * at.y;
    vec2 across_m = (place_m.xy + point.tangent * place_m.z) / max(1.0 + place_m.z / map_source.z_m, kNearestPlace);
    vec2 texels = across_m * point.source_texel / light.radiance.w;
    // The map has room for a disk around all of the source.
    float most = max(point.source_texel.x, point.source_texel.y) * source_stretch(point.tangent);
    return texels * min(most / max(length(texels), 1e-30), 1.0);
}
