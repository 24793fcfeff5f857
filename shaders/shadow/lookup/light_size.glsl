// A source with a size, for filters that soften shadows by it. light.radiance.w: its radius in metres, of a sun the tangent
// of its angular radius; 0: no filter asks for it. It is a disk that faces every receiver.
// What hides some of it from a receiver lies within a cone between the two. In the map that is a circle around the receiver
// whose radius grows with the difference of their reversed depths: along parallel rays by the height between them, and from
// a lamp by radius * (1 / z_blocker - 1 / z_receiver), where depth is alpha + beta / z. These are texels per unit of depth.
vec2 sun_source_texel(ViewRecord view) { return light.radiance.w * view.axis_back.w / vec2(view.axis_u.w, view.axis_v.w); }

vec2 lamp_source_texel(ViewRecord view) { return light.radiance.w / (view.axis_back.w * vec2(view.axis_u.w, view.axis_v.w)); }

// Away from a perspective view's axis the circle becomes an ellipse, longer by 1 / cos along `tangent`, the receiver's
// direction in the view.
float source_stretch(vec2 tangent) { return sqrt(1.0 + dot(tangent, tangent)); }

// How far from a receiver at `depth` texels may matter: as far as the cone reaches on the near plane, but no farther than
// the map leaves room for.
float source_reach_texel(vec2 source_texel, vec2 tangent, float depth) {
    float widest = max(source_texel.x, source_texel.y) * source_stretch(tangent) * (1.0 - clamp(depth, 0.0, 1.0));
    return min(widest, light.spread.w);
}
