// Moment shadow map: the distribution with the four stored moments that darkens the receiver least (Peters and Klein
// 2015). It has three places: the receiver's and two others. This finds the two and what they weigh.

#include "common/float_rounding.glsl"

// Powers of s in [-1,1]. In 16 bits, settings.w = 1, they are stored in combinations that fill [0,1] and lose less by
// rounding (the same paper).
const float kRoot3 = 1.7320508;

vec4 packed_moments(vec4 b) {
    return vec4(1.5 * b.x - 2.0 * b.z + 0.5, 4.0 * (b.y - b.w), kRoot3 * (0.5 * b.x - 2.0 / 9.0 * b.z) + 0.5, 0.5 * (b.y + b.w));
}

vec4 unpacked_moments(vec4 p) {
    float first = p.x - 0.5, third = p.z - 0.5;
    return vec4(kRoot3 * third - first / 3.0, p.w + p.y / 8.0, 0.75 * (kRoot3 * third - first), p.w - p.y / 8.0);
}

vec4 moments_of(float share, vec4 settings) {
    float s = 2.0 * share - 1.0;
    vec4 powers = vec4(s, s * s, s * s * s, s * s * s * s);
    return settings.w > 0.0 ? packed_moments(powers) : powers;
}

// Moments of a distribution that is nowhere single (1 / (pi sqrt(1 - s^2))): a share of them makes rounded moments
// possible ones.
const vec4 kSpreadMoments = vec4(0.0, 0.5, 0.0, 0.375);

// Returns the polynomial c.x + c.y s + c.z s^2 with E[p q] = q(place) for every polynomial q of degree 2 (Cholesky, of
// the Hankel matrix).
vec3 kernel_at(float place, vec4 b) {
    float d1 = max(b.y - b.x * b.x, 1e-12);
    float l21 = (b.z - b.x * b.y) / d1;
    float d2 = max(b.w - b.y * b.y - l21 * l21 * d1, 1e-12);
    float y1 = (place - b.x) / d1;
    float y2 = (place * place - b.y - l21 * (place - b.x)) / d2;
    float c1 = y1 - l21 * y2;
    return vec3(1.0 - b.x * c1 - b.y * y2, c1, y2);
}

// The next function returns the two places where the polynomial is 0, the lesser first. kFar stands for infinitely far.
const float kFar = 1e4;
const float kLeastWeight = 1e-6;   // what weighs less lies anywhere
vec2 roots(vec3 c) {
    float q = -0.5 * (c.y + (c.y < 0.0 ? -1.0 : 1.0) * sqrt(max(c.y * c.y - 4.0 * c.x * c.z, 0.0)));
    float least = abs(q) / kFar;
    float one = abs(c.z) > least ? q / c.z : ((c.z < 0.0) == (q < 0.0) ? kFar : -kFar);
    float other = abs(q) > 0.0 ? c.x / q : 0.0;
    return vec2(min(one, other), max(one, other));
}

// Value of the first moment from which nothing was drawn: all is stored at the far end, up to rounding. In 32 bits
// rounding is half a unit of each of 31 weights of the blur and of their sums, twice. In 16 bits it is half a step of
// the first and third number, twice. A caster so near to the far end cannot be distinguished from none.
const float kEmpty = 1.0 - 128.0 * kUnitRoundoff, kEmpty16 = 1.0 - 1.0 / 16384.0;
bool shows_nothing(vec4 b, vec4 settings) { return b.x >= (settings.w > 0.0 ? kEmpty16 : kEmpty); }

// Returns x: least share of what is stored that lies before `share`; y: where it lies on average, or `share` if nothing
// does.
vec2 moments_before(vec4 moments, float share, vec4 settings) {
    vec4 stored = settings.w > 0.0 ? unpacked_moments(moments) : moments;
    if (shows_nothing(stored, settings)) return vec2(0.0, share);
    vec4 b = mix(stored, kSpreadMoments, settings.z);
    float place = 2.0 * share - 1.0;
    vec3 c = kernel_at(place, b);
    float own = clamp(1.0 / (c.x + place * (c.y + place * c.z)), 0.0, 1.0);   // weight of the receiver's place
    vec2 other = roots(c);
    if (place <= other.x) return vec2(0.0, share);
    float others = b.x - own * place;
    if (place >= other.y) return vec2(1.0 - own, 0.5 + 0.5 * others / max(1.0 - own, kLeastWeight));
    float nearer = ((1.0 - own) * other.y - others) / (other.y - other.x);
    return vec2(clamp(nearer, 0.0, 1.0), 0.5 + 0.5 * other.x);
}

float moments_lit(vec4 moments, float share, vec4 settings) { return 1.0 - moments_before(moments, share, settings).x; }
