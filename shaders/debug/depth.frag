// Depth maps as grey tiles: black at near, white at far, linear in metres. What was never drawn (depth 0) is blue.
#include "common/bindings.glsl"
const int kMaxTiles = 8;
struct Tile {
    vec4 place;   // left, bottom and edge, pixels; w: layer
    vec4 depth;   // near and far, metres; alpha and beta of a perspective map, beta 0: orthographic
    vec4 right;   // axes of a cube's face; 0: a flat map
    vec4 up;
    vec4 forward;
};
// C++ twins: DepthTiles and DepthTile in systems/debug/depth_tiles.h.
layout(std140, binding = kFlatViewBlock) uniform DepthTiles {
    ivec4 options;   // x: number of tiles
    Tile tiles[kMaxTiles];
};
layout(binding = kFlatMapsUnit) uniform sampler2DArray flat_maps;
layout(binding = kCubeMapUnit) uniform samplerCube cube_map;
layout(location = 0) out vec4 colour_out;
const vec3 kBackground = vec3(0.01), kNothing = vec3(0.02, 0.05, 0.25);   // linear

// Returns the share of the range: 0 at near, 1 at far. Depth is reversed: orthographic maps hold 1 at near, perspective
// ones alpha + beta / distance.
float share_of_range(Tile tile, float depth) {
    if (tile.depth.w == 0.0) return 1.0 - depth;
    float distance_m = tile.depth.w / max(depth - tile.depth.z, 1e-30);
    return (distance_m - tile.depth.x) / (tile.depth.y - tile.depth.x);
}

float stored_depth(Tile tile, vec2 at) {
    if (tile.forward.xyz == vec3(0.0)) return textureLod(flat_maps, vec3(at, tile.place.w), 0.0).r;
    vec2 tangent = 2.0 * at - 1.0;
    return textureLod(cube_map, tile.forward.xyz + tangent.x * tile.right.xyz + tangent.y * tile.up.xyz, 0.0).r;
}

// Returns the linear value that the target encodes as `encoded`, sRGB (IEC 61966-2-1): the byte shown is 255 times the
// share.
float linear_from_srgb(float encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

void main() {
    colour_out = vec4(kBackground, 1.0);
    for (int i = 0; i < options.x; ++i) {
        Tile tile = tiles[i];
        vec2 at = (gl_FragCoord.xy - tile.place.xy) / tile.place.z;
        if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) continue;
        float depth = stored_depth(tile, at);
        float grey = linear_from_srgb(clamp(share_of_range(tile, depth), 0.0, 1.0));
        colour_out.rgb = depth > 0.0 ? vec3(grey) : kNothing;
    }
}
