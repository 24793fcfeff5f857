// An area light as the receiver sees it in a map. Straight lines stay straight there, with depth as their length: a place
// of the source is a direction.
#include "shadow/filters/pcss/area_axes.glsl"
#include "shadow/filters/pcss/in_view.glsl"
const float kNearestPlace = 0.2;   // least share of the receiver's depth that a place of the source is off it

struct MapSource {
    vec3 first_m, second_m;   // half axes, in the map's u, v and toward the light
    float z_m;                // the receiver's distance along the view's axis
};
MapSource map_source = MapSource(vec3(0.0), vec3(0.0), 1.0);   // as the receiver sees it

MapSource source_on_map(ShadowPoint point) {
    SourceAxes axes = area_axes(point.position_ca);
    MapSource seen;
    seen.first_m = in_view(point, axes.right_m);
    seen.second_m = in_view(point, axes.up_m);
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
