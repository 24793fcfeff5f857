// Size of a source, for filters that soften shadows by it. light.radiance.w: its radius, metres; of a sun the tangent
// of its angular radius. 0: no filter reads it. The source is a disk that faces every receiver.
// What hides some of it from a receiver lies in the cone between the two. In the map that cone is a circle around the
// receiver. Its radius grows with the difference of their reversed depths. Along parallel rays it grows by the height
// between them; from a lamp by radius * (1 / z_blocker - 1 / z_receiver), where depth is alpha + beta / z.

// Returns the radius of that circle in a sun's map, texels per unit of depth. lamp_source_texel() returns it in a
// lamp's.
vec2 sun_source_texel(ViewRecord view) { return light.radiance.w * view.axis_back.w / vec2(view.axis_u.w, view.axis_v.w); }

vec2 lamp_source_texel(ViewRecord view) { return light.radiance.w / (view.axis_back.w * vec2(view.axis_u.w, view.axis_v.w)); }

// Returns how much longer the circle is along `tangent`, the receiver's direction in a perspective view: 1 / cos. Away
// from the axis it is an ellipse.
float source_stretch(vec2 tangent) { return sqrt(1.0 + dot(tangent, tangent)); }

// Returns how far from a receiver at `depth` texels may matter. That is as far as the cone reaches on the near plane,
// but at most as far as the map has room.
float source_reach_texel(vec2 source_texel, vec2 tangent, float depth) {
    float widest = max(source_texel.x, source_texel.y) * source_stretch(tangent) * (1.0 - clamp(depth, 0.0, 1.0));
    return min(widest, light.spread.w);
}
