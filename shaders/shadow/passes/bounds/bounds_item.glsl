// Items that passes over sheets pull: a triangle or an edge, as it is projected, and how far rounding may have taken
// it. C++ twin: BoundsItem in systems/shadow/exact/bounds_items.h.
#include "common/bindings.glsl"
#include "common/position_error.glsl"
#include "shadow/passes/depth/depth_view_block.glsl"
#include "shadow/filters/exact/error_margins.glsl"
struct BoundsItem {
    uint instance, a, b, c;   // vertices of the common buffer
};
layout(binding = kBoundsItemUnit) uniform usamplerBuffer sheet_items;
layout(binding = kBoundsVertexUnit) uniform usamplerBuffer scene_vertices;   // two texels each, position first

BoundsItem bounds_item(int place) {
    uvec4 item = texelFetch(sheet_items, place);
    return BoundsItem(item.x, item.y, item.z, item.w);
}

struct Corner {
    vec4 place;   // in clip space, as depth.vert has it
    vec4 error;   // bound on each coordinate's rounding
};

Corner corner_of(InstanceRecord instance, uint vertex) {
    vec3 position_ms = uintBitsToFloat(texelFetch(scene_vertices, 2 * int(vertex)).xyz);
    vec3 position_as = position_from_anchor(instance, position_ms, depth_view.anchor_high.xyz, depth_view.anchor_low.xyz);
    precise vec4 place = depth_view.clip_from_anchor * vec4(position_as, 1.0);
    vec3 error_m = placed_error_m(instance, position_ms, depth_view.anchor_high.xyz, depth_view.anchor_low.xyz);
    vec4 summed = vec4(error_m + kProjectedUnits * kUnitRoundoff * abs(position_as), kProjectedUnits * kUnitRoundoff);
    return Corner(place, kRoundings * (absolute(depth_view.clip_from_anchor) * summed));
}

float map_size() { return depth_view.anchor_high.w; }

// Returns a place's texels from the corner of the map; for w > 0 alone.
vec2 in_texels(vec4 place) { return (place.xy / place.w * 0.5 + 0.5) * map_size(); }

// Returns how far from there the place may be, texels.
float moved_texel(vec4 place, vec4 error) {
    vec2 ndc = abs(place.xy / place.w);
    return (max(error.x, error.y) + max(ndc.x, ndc.y) * error.w) / place.w * 0.5 * map_size();
}

// Returns whether a corner lies before the light, by more than its own rounding.
bool is_before_light(Corner c) { return c.place.w > 16.0 * c.error.w && c.place.w > 0.0; }

// AS_POINTS: a point over each item, instead of a quad.
#ifdef AS_POINTS
const bool kAsPoints = true;
#else
const bool kAsPoints = false;
#endif
const int kVertices = kAsPoints ? 1 : 6;

// Returns a corner of a quad's two triangles: (-1, -1) to (1, 1).
vec2 quad_corner(int vertex) {
    int corner = vertex % 6;
    return vec2(corner == 1 || corner == 3 || corner == 4 ? 1.0 : -1.0, corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0);
}

vec4 at_texel(vec2 texel) { return vec4(texel / map_size() * 2.0 - 1.0, 0.5, 1.0); }

// Returns a quad's corner; or the middle of the point that covers all between two corners of the map, and sets its
// size.
vec4 box_at(vec2 from, vec2 to, vec2 corner) {
    if (!kAsPoints) return at_texel(mix(from, to, corner * 0.5 + 0.5));
    const float kSnapped_texel = 0.02;   // the middle is snapped, to 2^-8 and to a float of the map's size, and so may
                                         // the sides be
    from = clamp(from, 0.0, map_size());
    to = clamp(to, 0.0, map_size());
    gl_PointSize = max(to.x - from.x, to.y - from.y) + kSnapped_texel;
    return at_texel(0.5 * (from + to));
}
vec4 nowhere() { return vec4(2.0, 2.0, 0.5, 1.0); }
