#pragma once
#include <string_view>

/// Parts of the text of lookup_glsl() that are not the shaders' own. $name$ stands for a value.
namespace gnomon::lookup {

/// The record of one light, read as texels for the reason in common/instance_buffer.glsl. gnomon_view() reads only what
/// its caller uses.
inline constexpr std::string_view kRecords = R"(
struct gnomon_Light {
$light$    ivec4 row;     // x: kind of lookup; y: number of the filter; z: 1: a sun; 2: a spot; 4: reads depths
    ivec4 place;   // x: unit; y: first layer of its depths; z: of its triangles; w: bits of their numbers
    vec4 sizes;    // x: reach of the filter, texels; y: edge of the map, texels
};
struct gnomon_Camera {
$camera$};
const int gnomon_kHeadTexels = $head_texels$, gnomon_kLightTexels = $light_texels$, gnomon_kViewTexels = 9;
layout(binding = $records$) uniform usamplerBuffer gnomon_records;
layout(binding = $instances$) uniform usamplerBuffer gnomon_instance_texels;
layout(binding = $triangles$) uniform usamplerBuffer gnomon_caster_triangles;
layout(std430, binding = $masks$) restrict readonly buffer gnomon_Masks { uint gnomon_ray_masks[]; };
vec2 gnomon_pixel = vec2(0.5);
gnomon_Light gnomon_light;   // the light that is looked up
gnomon_Camera gnomon_camera;
int gnomon_first_view = 0;   // texel of its first view
bool gnomon_is_sun = false, gnomon_is_spot = false, gnomon_reads_depths = false;
float gnomon_reach_texel = 0.0, gnomon_map_edge_px = 1.0;

vec4 gnomon_floats(int texel) { return uintBitsToFloat(texelFetch(gnomon_records, texel)); }

ivec4 gnomon_ints(int texel) { return ivec4(texelFetch(gnomon_records, texel)); }

mat4 gnomon_matrix(int texel) {
    return mat4(gnomon_floats(texel), gnomon_floats(texel + 1), gnomon_floats(texel + 2), gnomon_floats(texel + 3));
}

$view$ gnomon_view(int i) {
    int texel = gnomon_first_view + gnomon_kViewTexels * i;
    return $view$(gnomon_matrix(texel), gnomon_floats(texel + 4), gnomon_floats(texel + 5), gnomon_floats(texel + 6),
                  gnomon_floats(texel + 7), gnomon_floats(texel + 8));
}

void gnomon_take(int light) {
    int texel = gnomon_kHeadTexels + gnomon_kLightTexels * light;
    gnomon_first_view = texel + $members$;
    int last = texel + gnomon_kLightTexels - 3;
    gnomon_light = gnomon_Light($load_light$gnomon_ints(last), gnomon_ints(last + 1), gnomon_floats(last + 2));
    gnomon_camera = gnomon_Camera($load_camera$);
    ivec4 row = gnomon_light.row;
    gnomon_is_sun = (row.z & 1) != 0;
    gnomon_is_spot = (row.z & 2) != 0;
    gnomon_reads_depths = (row.z & 4) != 0;
    gnomon_reach_texel = gnomon_light.sizes.x;
    gnomon_map_edge_px = gnomon_light.sizes.y;
}
)";

/// Shared arrays, and the number of the array in use.
inline constexpr std::string_view kArrays = R"(
const int gnomon_kUnits = $units$;
layout(binding = $depths$) uniform sampler2DArray gnomon_depths[gnomon_kUnits];
layout(binding = $ids$) uniform usampler2DArray gnomon_ids[gnomon_kUnits];
int gnomon_unit = 0;

vec3 gnomon_depth_place(vec3 at) { return vec3(at.xy, at.z + float(gnomon_light.place.y)); }

vec3 gnomon_id_place(vec3 at) { return vec3(at.xy, at.z + float(gnomon_light.place.z)); }
)";

/// Functions that read the arrays on software devices. gnomon_unit counts a loop that all of a draw's pixels run in
/// step, because an index into samplers must be the same for all. The four texels around a corner are read one by one,
/// in textureGather's order. Mesa 22.3's llvmpipe aborts on that function beside buffers that are read as texels.
inline constexpr std::string_view kSoftwareReaders = R"(
float gnomon_shared_depth(vec3 at) { return textureLod(gnomon_depths[gnomon_unit], gnomon_depth_place(at), 0.0).x; }

uvec2 gnomon_shared_id(vec3 at) {
    return $unpacked$(textureLod(gnomon_ids[gnomon_unit], gnomon_id_place(at), 0.0).xy, gnomon_light.place.w);
}

vec3 gnomon_beside(vec3 at, float u, float v) { return vec3(at.xy + vec2(u, v) * (0.5 / gnomon_map_edge_px), at.z); }

vec4 gnomon_shared_depths(vec3 at) {
    return vec4(gnomon_shared_depth(gnomon_beside(at, -1.0, 1.0)), gnomon_shared_depth(gnomon_beside(at, 1.0, 1.0)),
                gnomon_shared_depth(gnomon_beside(at, 1.0, -1.0)), gnomon_shared_depth(gnomon_beside(at, -1.0, -1.0)));
}

$four$ gnomon_shared_ids(vec3 at) {
    uvec2 a = gnomon_shared_id(gnomon_beside(at, -1.0, 1.0)), b = gnomon_shared_id(gnomon_beside(at, 1.0, 1.0));
    uvec2 c = gnomon_shared_id(gnomon_beside(at, 1.0, -1.0)), d = gnomon_shared_id(gnomon_beside(at, -1.0, -1.0));
    return $four$(uvec4(a.x, b.x, c.x, d.x), uvec4(a.y, b.y, c.y, d.y));
}
)";

/// Functions that read them on hardware. Each read picks its array by a branch, with an index that is a constant. A
/// loop around the lookup would be unrolled by NVIDIA's compiler, and the text compiled once for each array.
inline constexpr std::string_view kHardwareReaders = R"(
float gnomon_shared_depth(vec3 at) {
    vec3 place = gnomon_depth_place(at);
    float depth = 0.0;
$read_depth$    return depth;
}

uvec2 gnomon_shared_id(vec3 at) {
    vec3 place = gnomon_id_place(at);
    uvec2 id = uvec2(0u);
$read_id$    return $unpacked$(id, gnomon_light.place.w);
}

vec4 gnomon_shared_depths(vec3 at) {
    vec3 place = gnomon_depth_place(at);
    vec4 depths = vec4(0.0);
$gather_depths$    return depths;
}

$four$ gnomon_shared_ids(vec3 at) {
    vec3 place = gnomon_id_place(at);
    uvec4 instances = uvec4(0u), triangles = uvec4(0u);
$gather_ids$    return $all_unpacked$(instances, triangles, gnomon_light.place.w);
}
)";

/// Lookup in flat maps: kinds of lights, then filters. As shadow/lookup/visibility/by_map.glsl, which has one of each.
inline constexpr std::string_view kFlat = R"(
float gnomon_flat_visibility(vec3 position, vec3 normal, float error_m) {
    ivec4 row = gnomon_light.row;
    float reach_texel = gnomon_reads_depths ? 0.0 : gnomon_reach_texel;
    float visible = 1.0, share = 1.0;
    int lookup = 0;
    do {
        $point$ point;
$points$        float found = 1.0;
        bool fades_into = true;
        if ($may_be_dark$(point)) {
            if ($on_plane$()) point = $move$(point, normal);
            if (gnomon_reads_depths) point.slope = $slope$(point, normal);
            point.normal = normal;
            point.error_m = error_m;
$filters$        }
        float next = 0.0;
$fades$        if (lookup > 0 && !fades_into) share = 0.0;
        visible = mix(visible, found, share);
        share = lookup == 0 ? next : 0.0;
        ++lookup;
    } while (share > 0.0);
    return visible;
}
)";

/// The same in cubes, which never fade.
inline constexpr std::string_view kCube = R"(
float gnomon_cube_visibility(vec3 position, vec3 normal, float error_m) {
    ivec4 row = gnomon_light.row;
    float reach_texel = gnomon_reads_depths ? 0.0 : gnomon_reach_texel;
    float found = 1.0;
    $point$ point = $shadow_point$(0, position, normal, error_m, reach_texel);
    if ($may_be_dark$(point)) {
        if ($on_plane$()) point = $move$(point, normal);
        if (gnomon_reads_depths) point.slope = $slope$(point, normal);
        point.normal = normal;
        point.error_m = error_m;
$filters$    }
    return found;
}
)";

/// What engines call beside kLookups.
inline constexpr std::string_view kEntries = R"(
const float gnomon_kFloatRounding = 1.0e-6;   // rounding of a computed position, as a share of its size

int gnomon_light_count() { return gnomon_ints(gnomon_kHeadTexels - 1).x; }

bool gnomon_takes_shadow(int light, int layers) {
    gnomon_take(light);
    return $takes_shadow$(float(layers));
}

float gnomon_visibility_of_taken(vec3 position, vec3 normal, float error_m) {
$cubes$$flats$    return 1.0;
}
)";

/// Functions named $lookup$ that return a light's visibility. $looked_up$ is a statement that sets `visible` for the
/// light that was taken.
inline constexpr std::string_view kLookups = R"(
float $lookup$_if_reached(vec3 position, vec3 normal, float error_m) {
    if ($unreached$(normal, $light_at$(position))) return 0.0;
    float visible = 1.0;
    $looked_up$
    return visible;
}

float $lookup$(int light, vec3 position, vec3 normal, float error_m) {
    gnomon_take(light);
    return $lookup$_if_reached(position, normal, error_m);
}

float $lookup$(int light, vec3 position, vec3 normal) {
    return $lookup$(light, position, normal, gnomon_kFloatRounding * length(position));
}

float $lookup$(int light, vec3 position) {
    gnomon_take(light);
    vec3 to_light = $toward_light$(position);
    return $lookup$_if_reached(position, to_light / max(length(to_light), 1e-30), 0.0);
}
)";

/// Looks up any light on software devices: each round has the same unit for all.
inline constexpr std::string_view kLookUpInRounds =
    "gnomon_unit = 0;\n"
    "    do if (gnomon_light.place.x == gnomon_unit) visible = gnomon_visibility_of_taken(position, normal, error_m);\n"
    "    while (++gnomon_unit < gnomon_kUnits);";
/// Looks up a light that is the same for all; any light where reads pick their array (kHardwareReaders).
inline constexpr std::string_view kLookUpAtOnce =
    "gnomon_unit = gnomon_light.place.x;\n"
    "    if (gnomon_unit >= 0) visible = gnomon_visibility_of_taken(position, normal, error_m);";

}  // namespace gnomon::lookup
