// Shadows as soft as the source is large, out of moments.glsl's map. Its mipmaps serve the search, and the penumbra is
// read from them (after Yang et al. 2010 and Peters et al. 2016). A level yields the share of a region that lies before
// the receiver, and how far before it. Casters with a cone about as wide as the region hide the source.
// Without a size it is moments.glsl. With a size it requires SHADOW_FOOTPRINT.
#include "shadow/filters/prefiltered/moments.glsl"

#ifndef PREFILTER_PASS   // the pass that prefilters maps has no receivers
#define SHADOW_SOFT_MOMENTS 1

float lit_by_footprint(ShadowPoint point) { return moments_lit(shadow_moments(point), shadow_share(point), light.moments); }

// Square of the radius of the disk that varies as much as the blur of the map itself. What the sampler blends of a
// level varies by a quarter of its texel's square, each way. 1/12 comes from within the texel, 1/6 from texel to texel.
// So does a disk with that texel as its radius.
const float kBlur_texel2 = 1.47;
// Texels of its own that a lookup in a level reads to each side.
const float kLevelReach = 1.5;
// Growth of the disk that is read, per share of light that counts as dark: that makes penumbrae narrower.
const float kWiderPerBleeding = 1.25;

float reach_of_level(float level) { return kLevelReach * exp2(ceil(level)) + 1.0; }

// Returns moments_before() of the point. Nothing lies before what its bias takes to the range's near end.
vec2 stored_before(ShadowPoint point, vec4 moments) {
    float share = shadow_share(point);
    return share > 0.0 ? moments_before(moments, share, light.moments) : vec2(0.0);
}

float level_of_disk(float radius_texel) { return 0.5 * log2(max(radius_texel * radius_texel - kBlur_texel2, 1.0)); }

// Returns how far before the receiver its casters stand, in depth. 0: there are none. cone_texel: width of a cone,
// texels per unit of depth. reach_texel: of the widest cone.
float casters_before(ShadowPoint point, float cone_texel, float reach_texel) {
    float weights = 0.0, sum = 0.0;
    int level = 0;
    do {
        ShadowPoint before = before_plane(point, reach_of_level(float(level)));
        vec2 casters = stored_before(before, shadow_moments_at(before, vec2(0.0), float(level)));
        float stand_before = max(depth_at_share(before, casters.y) - point.reference, 0.0);
        float cones = exp2(float(level)) / max(cone_texel * stand_before, 1e-6);
        float weight = casters.x / max(1.0, cones * cones * cones * cones);
        weights += weight;
        sum += weight * stand_before;
        ++level;
    } while (exp2(float(level)) < 2.0 * reach_texel);
    return weights > 0.0 ? sum / weights : 0.0;
}

// Returns the light over an ellipse of these radii along u and v: four lookups, a level finer than one of that width.
// What a single lookup sees would move with its texels' borders.
float lit_by_disk(ShadowPoint point, vec2 radius_texel) {
    float narrow = level_of_disk(min(radius_texel.x, radius_texel.y)), wide = level_of_disk(max(radius_texel.x, radius_texel.y));
    float level = min(narrow, max(wide - 1.0, 0.0));
    vec2 aside = 0.5 * sqrt(max(radius_texel * radius_texel - kBlur_texel2 - exp2(2.0 * level), 0.0));
    float widest = max(aside.x, aside.y);
    point = before_plane(point, radius_texel.x > 0.0 ? widest + reach_of_level(level) : 0.0);
    vec4 moments = vec4(0.0);
    int taps = 0;
    do {
        vec2 corner = vec2((taps & 1) == 0 ? -aside.x : aside.x, (taps & 2) == 0 ? -aside.y : aside.y);
        moments += shadow_moments_at(point, corner, level);
        ++taps;
    } while (widest > 0.0 && taps < 4);
    return 1.0 - stored_before(point, moments / float(taps)).x;
}

float lit_by_moments(ShadowPoint point) {
    if (!kFootprint || light.radiance.w == 0.0) return lit_by_footprint(point);   // mipmaps, if any, serve the pixel's footprint
    point.slope = shadow_slope(point, point.normal);
    vec2 cone_texel = point.source_texel * source_stretch(point.tangent);
    float reach_texel = source_reach_texel(point.source_texel, point.tangent, point.reference);
    float before = casters_before(point, sqrt(cone_texel.x * cone_texel.y), reach_texel);
    vec2 radius_texel = min(before * cone_texel, reach_texel);
    blurred_texel = radius_texel;
    return lit_by_disk(point, radius_texel * (1.0 + kWiderPerBleeding * light.moment_sampling.x));
}
#endif
