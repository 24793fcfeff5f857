// Returns how far, in depth, what is stored there stands before the receiver. 0: it is not above the receiver's plane.
float stands_before(ShadowPoint point, vec2 place, vec2 offset_texel) {
    vec2 middle = floor(place + offset_texel) + 0.5;
    float stored = shadow_depth(point, middle);
    bool above = stored > point.reference + dot(point.slope, middle - place);
    return above ? max(stored - point.reference, 0.0) : 0.0;
}
