#pragma once
#include <cstdint>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

/// The accuracy contract: as many texels as LightShadow::max_error_px asks for, and no more.
///
/// An edge is off by (1/2 + E) m pixels, and one more that comes from pixels alone (error_bound.h); m shrinks as a
/// map's edge grows. So the views of a fit, with maps of any size, tell which size keeps the light's word: coverage
/// and distance decide, through what a texel is on the screen. Sizes are held: more texels are given at once, fewer
/// only after half of them has done for a second, so that a walking camera seldom makes new maps. So is the number of a
/// sun's cascades: more are chosen where maps have to grow or what is seen takes another step of size, fewer only in
/// every kMovesToCount-th frame in which maps move, and are drawn, anyway.
namespace gnomon::shadow {

/// How far off an edge may be where texels are `extent_px` long on screen (error_bound.h); `reach_texel` is E.
double edge_error_px(double extent_px, double reach_texel);

/// What a view states holds for receivers that face the light within 60 degrees: there a texel is at most
/// 1 / cos 60° = 2 times as long on them as across the light. Steeper ones show longer edges, in dimmer light; no
/// single number bounds them, since any curved surface has places that the light only grazes.
inline constexpr double kSteepestReceiver = 2.0;

/// How many times longer a texel is on a receiver whose normal has this cosine with the way to the light than on the
/// steepest that is stated for; at least 1, infinite where the light grazes.
double steeper_than_stated(double cosine);

/// Map edges are multiples of it, and at least this: as many texels as a quantised grid needs, few enough that a window
/// that grows by some pixels seldom makes new maps.
inline constexpr std::uint32_t kLeastMap_px = 256;

/// max_error_px, or 1 where it is not above 0.
double wished_error_px(const LightShadow& shadow);

/// Whether the light's maps may be smaller than its request's most_px. Not where the size is given, where it must not
/// depend on what is seen (ShadowFit::stable), or where a filter's width hangs on it (FilterWidth::source).
bool follows_contract(const LightItem& light, const ShadowRequest& request);

/// What maps of `size_px` that err by `predicted_px` should become: the least multiple of kLeastMap_px that errs by no
/// more than `wished_px` beside the pixel of the picture's own, at most `most_px`; if they are `held`, size_px itself
/// unless that is less or twice as much. `predicted_px` 0: nothing is seen. Infinite or NaN: most_px.
std::uint32_t contract_size_px(std::uint32_t size_px, bool held, double predicted_px, double wished_px,
                               std::uint32_t most_px);

/// How many frames in a row half of a held map's edge has to do before it becomes smaller: a second at 60 Hz, longer
/// than a glance aside.
inline constexpr std::uint32_t kSpareFrames = 60;

/// Choosing another number costs as many fits as there are numbers, and a change all maps: a second of steady moving,
/// as for sizes.
inline constexpr std::uint32_t kMovesToCount = kSpareFrames;

/// What a sun's cascades of one count come to.
struct CascadeTrial {
    std::uint32_t count = 0;
    double predicted_px = 0.0;
    std::uint64_t texels = 0;  // of all their maps
};

/// How many cascades a sun gets; trials are of rising counts. The fewest that keep its word with no more texels than
/// the most of them take; the `held` number stays, unless fewer do, while it keeps the word with less than twice those
/// texels (0: none is held).
///
/// Where none does, all have the largest maps, and the one is chosen whose count times error is least if they shared
/// the same texels, whose edges err by the root of the count more: twice as many maps must halve the predicted error
/// beyond what more texels do of themselves. That bound is of the worst place, near the camera; everywhere else
/// cascades have no smaller texels, and what is thinner than these is lost. Measured, with the same texels in all:
/// courtyard and Sponza, where four maps divide the bound by 1.5 to 2.5, are best with one; a valley of kilometres,
/// where they divide it by 6 to 50, with two or four (docs/cost.md). The held number stays while the least is no less
/// than 1 / sqrt(2) of its product, as much as rounding of two sides to steps makes of it.
std::uint32_t contract_cascades(std::span<const CascadeTrial> trials, std::uint32_t held, double wished_px);

/// Whether maps that err by `predicted_px` keep the light's word.
bool keeps_contract(double predicted_px, double wished_px);

/// How far off an edge may be under a light that keeps its word, on a receiver whose normal has this cosine with the
/// way to the light: `wished_px` up to 60 degrees, on steeper ones as much more as texels are longer there
/// (steeper_than_stated), and the pixel of the picture's own.
double allowed_error_px(double wished_px, double cosine);

}  // namespace gnomon::shadow
