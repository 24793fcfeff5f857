// Quad over every texel that an edge may cross.
#include "shadow/passes/bounds/bounds_item.glsl"
flat out vec4 ends_texel;
flat out vec2 end_depths;    // no farther than they are
flat out float half_texel;   // half of a texel's side, and what rounding may have moved the edge by

// Finds the shares of the way from a to b between which it runs before the map, or two texels beside it. false:
// nowhere.
bool clipped(vec4 a, vec4 b, inout vec2 part) {
    float beyond = 1.0 + 4.0 / map_size();
    vec4 from = vec4(a.x, -a.x, a.y, -a.y) + beyond * a.w, to = vec4(b.x, -b.x, b.y, -b.y) + beyond * b.w;
    for (int i = 0; i < 4; ++i) {
        if (from[i] < 0.0 && to[i] < 0.0) return false;
        float at = from[i] / (from[i] - to[i]);
        if (from[i] < 0.0) part.x = max(part.x, at);
        if (to[i] < 0.0) part.y = min(part.y, at);
    }
    return part.x <= part.y;
}

// Returns a corner of the smaller box: along the map's axes, or along the edge.
vec4 covering(vec2 p, vec2 q, float half_side, vec2 corner) {
    const float kSlack = 0.02;   // the quad is snapped, too
    float pad = half_side + kSlack, slanted_pad = 1.4142136 * half_side + kSlack;
    vec2 low = min(p, q) - pad, high = max(p, q) + pad;
    if (kAsPoints) return box_at(low, high, corner);
    vec2 side = q - p;
    float length_texel = length(side);
    vec2 straight = high - low;
    vec2 slanted = vec2(length_texel + 2.0 * slanted_pad, 2.0 * slanted_pad);
    if (slanted.x * slanted.y < straight.x * straight.y) {
        vec2 along = side / length_texel, across = vec2(-along.y, along.x);
        return at_texel(0.5 * (p + q) + along * (0.5 * corner.x * slanted.x) + across * (0.5 * corner.y * slanted.y));
    }
    return box_at(low, high, corner);
}

void main() {
    BoundsItem item = bounds_item(gl_VertexID / kVertices);
    InstanceRecord instance = instance_record(item.instance);
    Corner a = corner_of(instance, item.a), b = corner_of(instance, item.b);
    vec4 rounded = kProjectedUnits * kUnitRoundoff * max(abs(a.place), abs(b.place));   // by where it is clipped
    vec4 error = max(a.error, b.error) + kRoundings * rounded;
    vec2 corner = quad_corner(gl_VertexID);
    gl_Position = nowhere();
    if (kAsPoints) gl_PointSize = 1.0;
    ends_texel = vec4(0.0);
    end_depths = vec2(0.0);
    half_texel = 0.0;
    vec2 part = vec2(0.0, 1.0);
    vec2 slack = error.xy + 2.0 * error.w;
    if (!clipped(a.place + vec4(0.0, 0.0, 0.0, max(slack.x, slack.y)), b.place + vec4(0.0, 0.0, 0.0, max(slack.x, slack.y)), part)) return;
    Corner from = Corner(mix(a.place, b.place, part.x), error), to = Corner(mix(a.place, b.place, part.y), error);
    bool known = is_before_light(from) && is_before_light(to);
    float moved = known ? max(moved_texel(from.place, error), moved_texel(to.place, error)) : 2.0;
    if (moved > 1.0) {   // where it runs is not known: anywhere, before everything
        ends_texel = vec4(vec2(0.0), vec2(map_size()));
        half_texel = 2.0 * map_size();
        end_depths = vec2(2.0);
        gl_Position = box_at(vec2(0.0), vec2(map_size()), corner);
        return;
    }
    ends_texel = vec4(in_texels(from.place), in_texels(to.place));
    half_texel = kTexelHalf + moved;
    vec2 depth = vec2(from.place.z / from.place.w, to.place.z / to.place.w);
    end_depths = depth + (error.z + abs(depth) * error.w) / vec2(from.place.w, to.place.w);
    gl_Position = covering(in_texels(from.place), in_texels(to.place), kTexelHalf + moved, corner);
}
