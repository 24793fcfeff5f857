// C++ twins: LightRecord and ViewRecord in systems/shadow/frame/lighting_inputs.h.
#include "common/bindings.glsl"
const int kMaxViews = 8;
struct ViewRecord {
    mat4 map_from_anchor;   // view-anchored position to texture coordinates and reversed depth, before division by w
    vec4 axis_u;            // xyz: world direction of the map's u; w: edge of a texel, metres (orthographic) or tangent
    vec4 axis_v;
    vec4 axis_back;         // xyz: toward the light; w: depth range in metres (orthographic) or beta
                            // (bias/automatic.glsl)
    vec4 numeric;           // x: rounding of depth, in depth.
                            // y: how far a caster may have moved since the map was drawn, metres. Negative: minus
                            // the farthest that a coarser mesh in its place is off (kept_off_m()).
                            // z: alpha (bias/automatic.glsl); of a cascade the view distance from which it fades.
                            // w: layer of the map. -1: no map, since nothing can darken what the view serves.
    vec4 anchor_from_camera;   // xyz: camera's anchor minus the view's, metres. Added to a camera-anchored position it
                               // gives a view-anchored one.
                               // w: view distance at which a cascade has faded into the next.
};
layout(std140, binding = kLightBlock) uniform LightBlock {
    vec4 position;             // Spot, point: xyz: position from the camera's anchor; w: range, metres, 0: unlimited.
                               // Sun: xyz: direction of view that its maps are fitted to; w: how far along that
                               // direction the camera stands.
    vec4 to_light;             // xyz: unit vector toward the light (directional), or against its axis (spot); w: its
                               // shadow layers, 0 to 255
    vec4 radiance;             // rgb: lux (directional) or candela; w: size of the source
                               // (shadow/lookup/light_size.glsl)
    vec4 cone;                 // x: cosine of the outer angle; y: 1 / (cos inner - cos outer); z: share of a spot's
                               // cube faces; of a point light the quaternion cube_turn()
    ivec4 options;             // x: number of views; y: BiasMode, 0: automatic.
                               // z: 1 if cascades are chosen by view distance; w: a bit per layer that has a view.
    vec4 bias;                 // manual bias: x: metres, z: texels; y: share of a cascade that fades.
                               // w: how far a coarser mesh may be off, per metre from camera to receiver
    ivec4 filtering;           // x: texels along a grid's edge; y: number of taps; z: 1: bails early; w: 1: seeds come
                               // from the world
    vec4 spread;               // see shadow/lookup/tap_radius.glsl
    ivec4 seed_cell;           // see shadow/filters/disk/noise_seed.glsl; w: round of noise. -1: nothing is random
    vec4 seed_place;
    vec4 moments;              // Prefiltered map (its filter's file): x, y: exponents; z: least variance; w: 1 if
                               // stored in 16 bits.
                               // Source with a size (shadow/filters/exact/classify_soft.glsl): x: 1 if its maps contain
                               // all casters at their true distance. y: distance of the nearest caster that they do
                               // not contain whole, metres.
    vec4 moment_sampling;      // x: share of light that counts as dark; y: most texels of a pixel's footprint; z: most
                               // taps along it.
                               // w: bits of a triangle's number in a texel (shadow/filters/triangles/gathered_ids.glsl)
    vec4 low;                  // Sun: xyz: low part of `to_light`. Lamp: xyz: offset from `position` to the place from
                               // which shadows are computed. That is the lamp in double, or just clear of a caster
                               // that it touches. w: 1: its edges are antialiased (shadow/filters/triangles)
    ViewRecord views[kMaxViews];
} light;

// Returns how far casters may be from what the view shows in their place, metres. A coarser mesh is off by the less, the
// nearer its shadow is to the camera (systems/shadow/fitting/choose_proxies.h).
float kept_off_m(ViewRecord view, vec3 position_ca) {
    return view.numeric.y < 0.0 ? min(-view.numeric.y, light.bias.w * length(position_ca)) : view.numeric.y;
}

// Moves a receiver off what the view shows of coarser meshes, for filters that test triangles. A mesh then does not
// darken itself by its own proxy.
vec3 off_proxies(ViewRecord view, vec3 position_ca, vec3 normal) {
    return view.numeric.y < 0.0 ? position_ca + normal * kept_off_m(view, position_ca) : position_ca;
}
