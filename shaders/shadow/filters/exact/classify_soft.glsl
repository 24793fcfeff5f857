// Classification of a receiver under a source with a size: certainly lit by all of it, certainly dark to all of it, or
// uncertain. See docs/explanation/exact_proof.md, "A source with a size". Requires shadow/filters/exact/classify.glsl.
#include "common/bindings.glsl"
#include "shadow/filters/exact/occluder_pyramid.glsl"
#include "shadow/filters/exact/light_cone.glsl"
layout(std430, binding = kPyramidBuffer) readonly buffer SheetEndBuffer { vec2 sheet_ends[]; };

const int kOfLit = 0, kOfDark = 1;   // see ends_of_texel()
// Largest distance across the map that the receiver's place, the rasteriser and the texels' own widening take; largest
// share that rounding takes of a quotient.
const float kConeSlack_texel = 0.05, kConeRounding = 1e-5;
const int kMostLevels = 8;           // 4^8 texels
const int kMostSquares = 256;        // limit of one walk: beyond it rays cost no more

// Returns whether the cone stays in what the map holds, or leaves it nearer to the light than any caster that the map
// lacks.
bool is_held(SheetPlace place, SourceCone cone, float reach_texel) {
    if (!kHasMargins) return true;
    float size = float(textureSize(sheet_bounds, 0).x);
    vec2 low = place.at_texel, high = size - place.at_texel;
    float aside = min(min(low.x, low.y), min(high.x, high.y)) - place.off_texel - kConeSlack_texel;
    if (kIsSun) return light.moments.x > 0.0 && reach_texel <= min(aside, light.spread.w);
    float leaves = min(place.depth - place.error + max(aside, 0.0) / cone.texels, 1.0);
    float radius_m = cone.radius_m, z_m = cone.alpha_beta.y / (leaves - cone.alpha_beta.x);
    return aside > 0.0 && (z_m + radius_m) * cone.stretch + radius_m < light.moments.y * (1.0 - kConeRounding);
}

vec2 ends_of_leaf(SheetPlace place, SourceCone cone) {
    vec2 bounds = texelFetch(sheet_bounds, place.texel, 0).xy;
    return ends_of_texel(first_depth(place), bounds, cone.texel_tan, cone.alpha_beta.x, cone.steepest);
}

// Returns whether no square holds anything of that kind (kOfLit, kOfDark) as near to the light as the cone is above it.
// The walk begins with squares that hold all of the cone and ends with squares that decide. It takes them in the order
// in which they lie in each other.
bool is_cone_free(SheetPlace place, SourceCone cone, float reach_texel, int kind) {
    int first[kMostLevels + 1], side[kMostLevels + 1];
    first[0] = 0;
    side[0] = textureSize(sheet_bounds, 0).x;
    int levels = 0, squares = 0;
    while (side[levels] > 1 && levels < kMostLevels) {
        int next = (side[levels] + kEndsAcross - 1) / kEndsAcross;
        first[levels + 1] = squares;
        squares += next * next;
        side[++levels] = next;
    }
    int before = place.texel.z * squares, top = 0;
    float across = 1.0;   // side of a square of that level, texels
    for (; top < levels && across < 2.0 * reach_texel; ++top) across *= float(kEndsAcross);
    ivec2 low = clamp(ivec2(floor((place.at_texel - reach_texel) / across)), ivec2(0), ivec2(side[top] - 1));
    ivec2 high = clamp(ivec2(floor((place.at_texel + reach_texel) / across)), ivec2(0), ivec2(side[top] - 1));
    ivec2 root = low, square = low;
    int level = top;
    float slack = place.off_texel + kRoundings * kConeSlack_texel, per_texel = (1.0 - kConeRounding) / cone.texels;
    float least = place.depth - place.error;
    for (int i = 0; i < kMostSquares; ++i) {
        vec2 corner = vec2(square) * across;
        vec2 aside = max(max(corner - place.at_texel, place.at_texel - corner - across), 0.0);
        float distance_texel = max(length(aside) - slack, 0.0);
        bool passes = distance_texel > reach_texel || any(greaterThanEqual(square, ivec2(side[level])));
        if (!passes) {
            SheetPlace leaf = place;
            leaf.texel.xy = square;
            float nearest = level == 0 ? ends_of_leaf(leaf, cone)[kind]
                                       : sheet_ends[before + first[level] + square.y * side[level] + square.x][kind];
            passes = nearest < least + distance_texel * per_texel;
        }
        if (!passes) {
            if (level == 0) return false;
            --level;
            across /= float(kEndsAcross);
            square *= kEndsAcross;
            continue;
        }
        while (level < top && (square & (kEndsAcross - 1)) == ivec2(kEndsAcross - 1)) {
            ++level;
            across *= float(kEndsAcross);
            square /= kEndsAcross;
        }
        if (level < top) {
            bool ends_row = (square.x & (kEndsAcross - 1)) == kEndsAcross - 1;
            square = ends_row ? ivec2(square.x - kEndsAcross + 1, square.y + 1) : ivec2(square.x + 1, square.y);
        } else {
            root = root.x < high.x ? ivec2(root.x + 1, root.y) : ivec2(low.x, root.y + 1);
            if (root.y > high.y) return true;
            square = root;
        }
    }
    return false;
}

int soft_verdict(SheetPlace place, vec3 position_ca, bool receiver_casts) {
    int found = sheet_verdict(place, receiver_casts);
#ifdef SHEETS_WITHOUT_REACH
    return found;
#endif
    if (found == kUncertain) return kUncertain;
    SourceCone cone = source_cone(place, position_ca);
    if (!place.is_known || !cone.is_known) return kUncertain;
    float reach_texel = cone.texels * (1.0 - place.depth + place.error) + kConeSlack_texel;
    if (!is_held(place, cone, reach_texel)) return kUncertain;
    if (place.is_open) return reach_texel <= light.spread.w ? kCertainlyLit : kUncertain;
    return is_cone_free(place, cone, reach_texel, found == kCertainlyLit ? kOfLit : kOfDark) ? found : kUncertain;
}
