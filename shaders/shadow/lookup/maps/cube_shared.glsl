// Cubes of any light: six layers of a shared array each, in OpenGL's order of faces. See maps/flat_shared.glsl.
#include "shadow/filters/triangles/gathered_ids.glsl"

vec2 shadow_map_size() { return vec2(map_edge_px); }

float face_size() { return map_edge_px; }

// Returns where the point lies in its face, texels; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return (point.tangent * 0.5 + 0.5) * face_size(); }

vec3 direction_to(ShadowPoint point, vec2 place) {
    vec2 tangent = place / face_size() * 2.0 - 1.0;
    return face_axes(point.position) * vec3(tangent, -1.0);
}

// Returns a direction's place in the array: u, v and the face that it falls on.
vec3 place_of(vec3 direction) {
    vec3 in_face = direction * face_axes(direction);
    return vec3((vec2(in_face.x, in_face.y) / largest(direction)) * 0.5 + 0.5, float(face_of(direction)));
}

// Returns the depth stored at a texel's middle. Beyond the face's edge it is what the neighbour stores in that
// direction, as depth of this face.
float shadow_depth(ShadowPoint point, vec2 middle) {
    vec3 direction = direction_to(point, middle);
    if (!is_drawn(direction)) return 0.0;
    float stored = shared_depth(place_of(direction)), alpha = light.views[0].numeric.z;
    return stored > 0.0 ? alpha + (stored - alpha) * largest(direction) : 0.0;
}

// Returns whether all four texels around a corner are this face's.
bool is_inside(ShadowPoint point, vec2 corner) {
    return min(corner.x, corner.y) >= 1.0 && max(corner.x, corner.y) <= face_size() - 1.0 && is_drawn(point.position);
}

// Returns where one of the four lies from that corner, texels, in textureGather's order.
vec2 toward_gathered(int i) { return vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5); }

// Returns the place of a corner in the array.
vec3 place_in_face(ShadowPoint point, vec2 corner) { return vec3(corner / face_size(), float(face_of(point.position))); }

// Returns the depths of the four texels around a corner between texels, in that order. It is a loop for the reason in
// maps/cube_depths.glsl.
vec4 shadow_depths(ShadowPoint point, vec2 corner) {
    vec4 four = vec4(0.0);
    bool gathers = is_inside(point, corner);
    if (gathers) four = shared_depths(place_in_face(point, corner));
    int i = 0;
    if (!gathers) do four[i] = shadow_depth(point, corner + toward_gathered(i));
    while (++i < 4);
    return four;
}

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    FourTriangles shown;
    shown.instance = shown.triangle = uvec4(0u);
    bool gathers = is_inside(point, corner);
    if (gathers) shown = shared_ids(place_in_face(point, corner));
    int i = 0;
    if (!gathers) do {
        uvec2 one = shared_id(place_of(direction_to(point, corner + toward_gathered(i))));
        shown.instance[i] = one.x;
        shown.triangle[i] = one.y;
    } while (++i < 4);
    return shown;
}

// Returns the instance and the triangle that a texel shows; beyond the face's edge what the neighbour stores there.
uvec2 shadow_triangle_at(ShadowPoint point, vec2 middle) { return shared_id(place_of(direction_to(point, middle))); }

// Returns the sides of a texel, tangents.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[0].axis_u.w, light.views[0].axis_v.w); }

#if SHADOW_LINEAR_TAPS
// Returns the result of comparing with a texel of a direction's face, or with its neighbour's where it lies beyond.
// `axes`: the face's; `reference`: depth along the direction itself.
float compared_beside(mat3 axes, vec2 middle, float reference) {
    const float kBeyond = 1.000001;   // just past the seam: the neighbour's texel beside it
    vec2 tangent = clamp(middle / face_size() * 2.0 - 1.0, vec2(-kBeyond), vec2(kBeyond));
    return reference >= shared_depth(place_of(axes * vec3(tangent, -1.0))) ? 1.0 : 0.0;
}

// Returns four results of comparing, blended as by a seamless sampler.
float compared(vec3 direction, float reference) {
    mat3 axes = face_axes(direction);
    vec3 in_face = direction * axes;
    vec2 place = ((vec2(in_face.x, in_face.y) / largest(direction)) * 0.5 + 0.5) * face_size();
    vec2 corner = floor(place - 0.5) + 1.0, share = place - 0.5 - floor(place - 0.5);
    bool gathers = min(corner.x, corner.y) >= 1.0 && max(corner.x, corner.y) <= face_size() - 1.0;
    vec4 lit = vec4(0.0);
    if (gathers) lit = vec4(greaterThanEqual(vec4(reference), shared_depths(vec3(corner / face_size(), float(face_of(direction))))));
    int i = 0;
    if (!gathers) do lit[i] = compared_beside(axes, corner + toward_gathered(i), reference);
    while (++i < 4);
    return mix(mix(lit.w, lit.z, share.x), mix(lit.x, lit.y, share.x), share.y);
}
#else
float compared(vec3 direction, float reference) { return reference >= shared_depth(place_of(direction)) ? 1.0 : 0.0; }
#endif

// Returns the result of one comparison, `offset_texel` texels beside the receiver. A tap that leaves the face is
// compared by the depth of the face that it lands on.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    vec3 direction = point.position + offset_texel.x * point.step_u + offset_texel.y * point.step_v;
    if (!is_drawn(direction)) return 1.0;
    ViewRecord view = light.views[0];
    float depth = view.numeric.z + view.axis_back.w / largest(direction);
    // Depth where the tap's direction meets the plane.
    if (compares_on_plane()) depth = view.numeric.z + max(dot(point.plane, direction), 0.0) * view.axis_back.w / largest(direction);
    return compared(direction, clamp(depth + point.bias_depth, 0.0, 1.0));
}
