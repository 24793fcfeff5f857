#include "systems/shadow/fitting/fit_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/math/frustum.h"
#include "systems/extract/light_facts.h"
#include "systems/shadow/culling/lamp_places.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/culling/receiver_mask.h"
#include "systems/shadow/culling/view_casters.h"
#include "systems/shadow/fitting/choose_proxies.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Returns the shorter edge of the smallest texel across the light, metres.
double finest_texel_m(const ShadowView& view) {
    const double texel = std::min(view.plane.texel_u, view.plane.texel_v);
    return is_parallel(view) ? texel : texel * view.depth.near_m;
}

/// States the view's errors for the camera that sees its texels largest. A warped map is left out: it serves its own
/// slice alone, and its fit has stated them.
void state_errors(const SceneSnapshot& scene, std::span<const glm::dvec3> points_ws, double reach_texel,
                  ShadowView& view) {
    for (std::uint32_t c = 0; c < scene.consumers.size(); ++c)
        if (view.plane.warp == glm::dvec2(0.0)) state_error(scene.consumers[c], points_ws, reach_texel, view);
}

/// States which cameras see receivers of the view, and how many receivers. A sun's cascade counts all receivers, since
/// it may reach into other slices.
void state_receivers(const LightItem& light, std::span<const ReceiverHull> hulls, ShadowView& view) {
    const bool sun = light_facts(light.kind).parallel;
    const ReceiverHull& receiver_hull = hulls[sun ? 0 : view.layer];
    view.consumer_mask = receiver_hull.consumers;
    if (view.receivers == 0) view.receivers = receiver_hull.receivers;
}

/// Returns the least distance that floats along a lamp's rays, and doubles of its place, resolve, metres. It is a share
/// of the distance, or of the depth range of a view anchored in it. It exceeds a texel only for a lamp immensely far
/// away.
double floats_tell_m(const ShadowView& view) {
    constexpr double kFloat = 0x1p-22, kDouble = math::kClippedRounding;
    const double anchored_m = (view.depth.far_m - view.depth.near_m) * view.depth.far_m / view.depth.near_m;
    const double from_m = view.pose.apex_m > 0.0 ? std::min(view.depth.far_m, anchored_m) : view.depth.far_m;
    return std::max(kFloat * from_m, kDouble * view.depth.far_m);
}

/// Returns the least difference of depths that the format resolves at the farthest receiver, metres. 0 for floats of a
/// sun.
double depth_step_m(const ShadowView& view, DepthFormat format) {
    const double step = depth_format_row(format).step;
    if (is_parallel(view)) return step * (view.depth.far_m - view.depth.near_m);
    return std::max(step * view.depth.far_m * view.depth.far_m / std::abs(view.depth.beta),  // d(alpha + beta / z)
                    floats_tell_m(view));
}

double predicted_px(std::span<const ShadowView> views) {
    double worst_px = 0.0;
    for (const ShadowView& view : views) worst_px = std::max(worst_px, view.error.texel_edge_px);
    return worst_px;
}

/// Sizes that were fitted in this frame. They bound the search, because a prediction for another size covers only its
/// texels, not its border.
struct FittedSizes {
    std::uint32_t too_small_px = 0;                                       // largest size that missed the target
    std::uint32_t enough_px = std::numeric_limits<std::uint32_t>::max();  // smallest size that met it

    void note(std::uint32_t size_px, bool keeps) {
        if (keeps) enough_px = std::min(enough_px, size_px);
        if (!keeps) too_small_px = std::max(too_small_px, size_px);
    }
    std::uint32_t between(std::uint32_t size_px) const {
        if (size_px <= too_small_px) size_px = too_small_px + kLeastMap_px;
        return std::min(size_px, enough_px);
    }
};

/// Sets the size of the light's maps that meets its error target. Shrinks only after kSpareFrames frames. Returns
/// whether the size differs from the fitted one.
bool settle_size(const LightItem& light, std::span<const ShadowView> views, const LightFitHistory& previous,
                 FittedSizes& fitted, std::uint32_t& downsize_frames, ShadowRequest& request) {
    if (views.empty() || !adapts_to_target(light, request)) return false;
    const bool is_held = request.map.resolution_px == previous.size.map_px;
    const double target_px = texel_target_px(light.shadow, request.map.filter), error_px = predicted_px(views);
    fitted.note(request.map.resolution_px, meets_target(error_px, target_px));
    const std::uint32_t wanted_px =
        target_size_px(request.map.resolution_px, is_held, error_px, target_px, request.limits.max_px);
    const std::uint32_t size_px = std::min(fitted.between(wanted_px), request.limits.max_px);
    const bool spare = is_held && size_px < request.map.resolution_px;
    // Counts past kSpareFrames mean that the smaller size missed the target: a border is a larger share of a smaller
    // map.
    if (is_held) downsize_frames = spare ? std::min(previous.size.downsize_frames + 1, kSpareFrames + 1) : 0;
    if (size_px == request.map.resolution_px || (spare && downsize_frames != kSpareFrames)) return false;
    set_resolution(light, size_px, request);
    return true;
}

/// Returns a light's direction for the next fit.
TurnHistory turned(const TurnHistory& previous, const LightItem& light) {
    const glm::dvec3& back_ws = light.rotation_ws[2];
    return {back_ws, previous.back_ws != glm::dvec3(0.0) && previous.back_ws != back_ws};
}

/// Returns whether what is seen needs other sizes. The best number of cascades then may change as well.
bool has_stepped(const LightFitHistory& previous, const LightFitHistory& next) {
    if (next.splits.near_step != previous.splits.near_step || next.splits.far_step != previous.splits.far_step)
        return true;
    return !std::equal(next.views.begin(), next.views.end(), previous.views.begin(),
                       [](const ViewFitHistory& a, const ViewFitHistory& b) { return a.extent_step == b.extent_step; });
}

}  // namespace

LightFitHistory without_fits(const LightFitHistory& previous) {
    LightFitHistory fresh = previous;
    fresh.views = {};
    fresh.splits = {};
    fresh.sampled_splits = {};
    fresh.size.map_px = fresh.size.downsize_frames = fresh.size.oversize_frames = fresh.size.shrink_cooldown = 0;
    return fresh;
}

LightFit::LightFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, StageScratch& scratch,
                   FittedViews& out)
    : scene_(scene),
      inputs_(inputs),
      light_(scene.lights[light]),
      index_(light),
      scratch_(scratch),
      out_(out),
      first_view_(out.views.size()),
      first_caster_(out.casters.size()),
      first_resized_(sizes_of(out.resized_sets)) {}

LightFit::ArraySizes LightFit::sizes_of(const ReceiverCasterSets& sets) {
    return {sets.receiver_items.size(),  sets.caster_items.size(), sets.receiver_points_ws.size(),
            sets.error_points_ws.size(), sets.hulls.size(),        sets.outlines.size()};
}

std::span<const ShadowView> LightFit::views() const { return std::span(out_.views).subspan(first_view_); }

Reason LightFit::run(const LightFitHistory& previous, bool recount, LightFitHistory& next) {
    forget_views();
    out_.casters.resize(first_caster_);
    const TurnHistory turn = turned(previous.turn, light_);
    const bool turns = turn.turned && previous.turn.turned;
    const Reason reason = fit_and_count(previous, recount, next) ? select_casters(turns) : Reason::fit_degenerate;
    next.turn = turn;
    if (reason != Reason::none) forget_views();
    out_.lights[index_].views = {static_cast<std::uint32_t>(first_view_), static_cast<std::uint32_t>(views().size())};
    return reason;
}

void LightFit::request_anew(const ShadowRequest& request) {
    out_.lights[index_].request = request;
    select_sets_again();
}

void LightFit::forget_views() { out_.views.resize(first_view_); }

bool LightFit::fit_and_count(const LightFitHistory& previous, bool recount, LightFitHistory& next) {
    if (!fit_size(previous, next)) return false;
    if (count_moves(previous, next) || (recount && !views().empty())) return choose_count(previous, next);
    return true;
}

/// Fits views without casters for maps of the request's size. Returns false if no finite volume exists.
bool LightFit::fit_once(const LightFitHistory& previous, LightFitHistory& next) {
    const ShadowRequest& request = out_.lights[index_].request;
    const LightSetsView sets = out_.sets_of(inputs_.sets, index_);
    const auto error_points = sets.error_points_ws();
    const FitInput input{light_,
                         request,
                         scene_,
                         sets.receivers(),
                         sets.casters(),
                         sets.receiver_points_ws(),
                         error_points,
                         sets.hulls(),
                         sets.arrays.receiver_points_ws,
                         request.map.filtering.border_texel,
                         inputs_.sampled_depths,
                         scratch_.fits,
                         previous,
                         next};
    ++out_.lights[index_].fits;
    if (!light_kind_row(light_.kind).fit(input, out_.views)) return false;
    for (std::size_t v = first_view_; v < out_.views.size(); ++v) {
        ShadowView& view = out_.views[v];
        view.light = index_;
        state_receivers(light_, sets.hulls(), view);
        state_errors(scene_, error_points, edge_texel_at(request.map.filtering, finest_texel_m(view)), view);
    }
    return true;
}

/// Fits for the size that the accuracy target needs.
bool LightFit::fit_size(const LightFitHistory& previous, LightFitHistory& next) {
    std::uint32_t downsize_frames = 0;
    FittedSizes sizes;
    bool fitted = false;
    for (std::uint32_t again = 0;; ++again) {
        forget_views();
        next = previous;
        fitted = fit_once(previous, next);
        // After kMostSizes one more is fitted if they were too small: a border is another share of each size.
        if (!fitted || again > kMostSizes || (again == kMostSizes && has_met_target())) break;
        if (!settle_size(light_, views(), previous, sizes, downsize_frames, request())) break;
        select_sets_again();
    }
    next.size.map_px = adapts_to_target(light_, request()) ? request().map.resolution_px : 0;
    next.size.downsize_frames = next.size.map_px == previous.size.map_px ? downsize_frames : 0;
    return fitted;
}

bool LightFit::has_met_target() const { return meets_target(predicted_px(views()), target_px()); }

double LightFit::target_px() const { return texel_target_px(light_.shadow, out_.lights[index_].request.map.filter); }

/// Counts the moves of the views since their number was last chosen. Returns true if a search for another number of
/// cascades is due.
bool LightFit::count_moves(const LightFitHistory& previous, LightFitHistory& next) const {
    const ShadowRequest& request = out_.lights[index_].request;
    const std::uint32_t most = request.limits.max_views,
                        usual = previous.count.cascades > 0 ? previous.count.cascades : most;
    if (most == 0) next.count.cascades = next.count.moves = 0;
    if (most == 0 || views().empty() || request.map.view_count != std::min(usual, most)) return false;
    if (previous.count.cascades == 0) return true;
    if (next.views != previous.views) ++next.count.moves;
    return next.size.map_px > previous.size.map_px || has_stepped(previous, next) || next.count.moves >= kMovesToCount;
}

/// Fits increasing numbers of cascades, doubled each time, and chooses one of them. Each fit starts without history,
/// since that of other slices does not apply.
bool LightFit::choose_count(const LightFitHistory& previous, LightFitHistory& next) {
    const LightFitHistory fresh = without_fits(previous);
    const ShadowRequest usual = request();
    const std::uint32_t most = usual.limits.max_views;
    std::array<CascadeTrial, kMaxCascades> trials;
    std::size_t tried = 0;
    // Fewer cascades are for a scene that has calmed down. The camera's present motion may end in a frame.
    const std::uint32_t least = next.count.moves >= kMovesToCount ? 1 : std::max(previous.count.cascades, 1u);
    for (std::uint32_t count = std::min(least, most);; count = std::min(2 * count, most)) {
        if (!fit_count(count, usual, fresh, next)) return false;
        const std::uint64_t edge_px = request().map.resolution_px;
        trials[tried++] = {count, predicted_px(views()), count * edge_px * edge_px};
        if (count == most) break;
    }
    const std::uint32_t chosen = choose_cascades(std::span(trials).first(tried), previous.count.cascades, target_px());
    const bool stays = chosen == previous.count.cascades;
    const bool fitted = fit_count(chosen, usual, stays ? previous : fresh, next);
    next.count.cascades = chosen;
    next.count.moves = 0;
    return fitted;
}

bool LightFit::fit_count(std::uint32_t count, const ShadowRequest& usual, const LightFitHistory& previous,
                         LightFitHistory& next) {
    request() = usual;
    set_cascades(light_.tuning.cascades, count, request());
    set_most(light_, usual.limits.max_px, previous.size.map_px, request());
    return fit_size(previous, next);
}

/// Selects the sets again for maps of another size. Only cubes need it: a face's share of its neighbours is a share of
/// its map.
void LightFit::select_sets_again() {
    if (light_kind_row(light_.kind).texture != gl::TextureKind::cube) return;
    ReceiverCasterSets& sets = out_.resized_sets;
    sets.receiver_items.resize(first_resized_.receivers);
    sets.caster_items.resize(first_resized_.casters);
    sets.receiver_points_ws.resize(first_resized_.points);
    sets.error_points_ws.resize(first_resized_.error_points);
    sets.hulls.resize(first_resized_.hulls);
    sets.outlines.resize(first_resized_.outlines);
    FitChoice& choice = out_.lights[index_];
    choice.sets = select_light_sets(scene_, index_, choice.request, lamp_ws_m(inputs_.lamps_ws_m, scene_, index_),
                                    scratch_.sets, sets);
    choice.resized = true;
}

/// Returns whether the filter treats any caster of the view by depth, because its triangles are unknown.
bool LightFit::has_casters_by_depth(const ShadowView& view) const {
    const auto casters = out_.casters_of(view);
    return scene_.drawables.any_by_depth && std::any_of(casters.begin(), casters.end(), [&](std::uint32_t i) {
               return scene_.instances[i].drawable.by_depth;
           });
}

/// Selects the casters of each view. A cube's face may be drawn without casters: a filter that reads across seams must
/// find it empty. `turns`: a sun's maps are drawn again whatever they hold, so that they hold no more than is seen.
Reason LightFit::select_casters(bool turns) {
    ShadowRequest& request = out_.lights[index_].request;
    const bool samples = light_facts(light_.kind).parallel && light_.tuning.cascades.splits == CascadeSplits::sampled;
    if (samples && inputs_.sampled_depths.failed && request.note == Reason::none) request.note = Reason::depths_unread;
    // A source with a size, and a pixel's area, may be looked up farther from a receiver than a view's casters reach.
    const bool reads_near = !needs_distances(request.map.filtering) && !light_.shadow.antialias;
    std::optional<std::span<const std::uint32_t>> seen;
    if (turns && reads_near && !inputs_.sets.occluders.empty()) {
        find_seen_receivers(scene_, light_, inputs_.sets, *scratch_.sets.layers, scratch_.sets.seen);
        seen = scratch_.sets.seen;
    }
    bool any = false;
    for (std::size_t v = first_view_; v < out_.views.size(); ++v) {
        ShadowView& view = out_.views[v];
        if (!request.rays.used && depth_step_m(view, request.map.depth_format) > view.error.texel_m &&
            view.error.texel_m > 0.0 && request.note == Reason::none)
            request.note = Reason::depth_coarse;
        if (seen && is_parallel(view)) view.stays = false;
        const CasterInputs inputs{out_.sets_of(inputs_.sets, index_), request.map.filtering, inputs_.moving, seen};
        select_view_casters(scene_, inputs, view, scratch_.sets, out_.casters);
        view.lit = view.casters.count == 0 && view.projection != ViewProjection::cube_face;
        state_edges(filter_row(request.map.filter).storage.triangle_ids && !has_casters_by_depth(view), view);
        choose_proxies(scene_, request.map, view, scratch_.drawn, out_);
        any = any || view.casters.count > 0;
    }
    return any ? Reason::none : Reason::no_caster;  // no caster where its shadow would be seen
}

}  // namespace gnomon::shadow
