// Texels with the receiver's own surface, and others, which may darken it. Requires
// shadow/filters/pcf/texel_vote.glsl.

// Distance from the receiver's plane, in slopes per texel, up to which a texel shows the receiver's own surface: a
// curved mesh bends. What lies farther below the plane, but above the receiver, is another surface. Within part of a
// texel it lies behind a plane that the light grazes. The value is measured (docs/explanation/filters.md). A tenth
// doubles the errors of Sponza. With less than 0.05, its cloth takes as much time again as walks over folds do.
const float kOwnSurface_texel = 0.05;

// Returns which of the four may show what darkens the receiver.
bvec4 may_darken(ShadowPoint point, FourTexels four) {
    vec4 below = four.plane - four.stored;
    float own = kOwnSurface_texel * (abs(point.slope.x) + abs(point.slope.y));
    bvec4 other;
    for (int i = 0; i < 4; ++i) other[i] = below[i] < -own || (below[i] > own && four.stored[i] > point.reference);
    return other;
}
