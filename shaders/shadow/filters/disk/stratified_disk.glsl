// Points of the unit disk, a point in each of `count` rings of equal area, in steps of the golden angle. The seed (two
// shares of 1) moves them within their ring, and turns all. The higher i, the farther out.
const float kTurn_rad = 6.283185307;
const float kGolden = 0.6180339887;

vec2 on_circle(float turns) { return vec2(cos(kTurn_rad * turns), sin(kTurn_rad * turns)); }

vec2 stratified_disk(vec2 seed, int i, int count) {
    float in_ring = fract(seed.x + kGolden * float(i * i));
    return sqrt((float(i) + in_ring) / float(count)) * on_circle(fract(seed.y + kGolden * float(i)));
}
