#include "systems/shadow/fitting/fit_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/light_facts.h"
#include "systems/shadow/culling/lamp_offsets.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/culling/view_casters.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Edge of the smallest texel in metres across the light.
double finest_texel_m(const ShadowView& view) {
    const double texel = std::min(view.plane.texel_u, view.plane.texel_v);
    return view.projection == ViewProjection::orthographic ? texel : texel * view.depth.near_m;
}

/// What the view's texels mean on the screen of the consumer that sees them largest. A warped map serves its own slice
/// alone: its fit has said it.
void state_errors(const SceneSnapshot& scene, std::span<const glm::dvec3> points_ws, double reach_texel,
                  ShadowView& view) {
    for (std::uint32_t c = 0; c < scene.consumers.size(); ++c)
        if (view.plane.warp == glm::dvec2(0.0)) state_error(scene.consumers[c], points_ws, reach_texel, view);
}

/// Whose receivers lie in it: of a sun's cascades those of all, since each may reach into another's slice.
void state_receivers(const LightItem& light, std::span<const Beam> beams, ShadowView& view) {
    const bool sun = light_facts(light.kind).parallel;
    const Beam& beam = beams[sun ? 0 : view.layer];
    view.consumer_mask = beam.consumers;
    if (view.receivers == 0) view.receivers = beam.receivers;
}

/// What floats tell apart along a lamp's rays, and doubles of its place: a share of the distance, or of the depth range
/// of a view that is anchored in it. It is more than a texel only where a lamp is immensely far away.
double floats_tell_m(const ShadowView& view) {
    constexpr double kFloat = 0x1p-22, kDouble = math::kClippedRounding;
    const double anchored_m = (view.depth.far_m - view.depth.near_m) * view.depth.far_m / view.depth.near_m;
    const double from_m = view.pose.apex_m > 0.0 ? std::min(view.depth.far_m, anchored_m) : view.depth.far_m;
    return std::max(kFloat * from_m, kDouble * view.depth.far_m);
}

/// Depths that differ by less are one, at the farthest receiver: 0 of a sun's floats.
double depth_step_m(const ShadowView& view, DepthFormat format) {
    const double step = depth_format_row(format).step;
    if (view.projection == ViewProjection::orthographic) return step * (view.depth.far_m - view.depth.near_m);
    return std::max(step * view.depth.far_m * view.depth.far_m / std::abs(view.depth.beta),  // d(alpha + beta / z)
                    floats_tell_m(view));
}

double predicted_px(std::span<const ShadowView> views) {
    double worst_px = 0.0;
    for (const ShadowView& view : views) worst_px = std::max(worst_px, view.error.edge_px);
    return worst_px;
}

/// Sizes that were fitted: a prediction says of another one only what its texels alone would make of it.
struct FittedSizes {
    std::uint32_t too_small_px = 0;                                       // the largest that did not keep the word
    std::uint32_t enough_px = std::numeric_limits<std::uint32_t>::max();  // the smallest that did

    void note(std::uint32_t size_px, bool keeps) {
        if (keeps) enough_px = std::min(enough_px, size_px);
        if (!keeps) too_small_px = std::max(too_small_px, size_px);
    }
    std::uint32_t between(std::uint32_t size_px) const {
        if (size_px <= too_small_px) size_px = too_small_px + kLeastMap_px;
        return std::min(size_px, enough_px);
    }
};

/// Makes the light's maps the size that keeps its word; smaller than the last frame's not at once. True if that is
/// another one than they were fitted for.
bool settle_size(const LightItem& light, std::span<const ShadowView> views, const HeldLight& held, FittedSizes& fitted,
                 std::uint32_t& spare_frames, ShadowRequest& request) {
    if (views.empty() || !follows_contract(light, request)) return false;
    const bool is_held = request.map.resolution_px == held.map_px;
    const double wished_px = wished_error_px(light.shadow), error_px = predicted_px(views);
    fitted.note(request.map.resolution_px, keeps_contract(error_px, wished_px));
    const std::uint32_t wish_px =
        contract_size_px(request.map.resolution_px, is_held, error_px, wished_px, request.limits.max_px);
    const std::uint32_t size_px = std::min(fitted.between(wish_px), request.limits.max_px);
    const bool spare = is_held && size_px < request.map.resolution_px;
    // Beyond kSpareFrames it was tried, and found too little: a filter's border is a larger share of a smaller map.
    if (is_held) spare_frames = spare ? std::min(held.spare_frames + 1, kSpareFrames + 1) : 0;
    if (size_px == request.map.resolution_px || (spare && spare_frames != kSpareFrames)) return false;
    set_resolution(light, size_px, request);
    return true;
}

/// Whether what is seen takes another size: so does then what another number of maps would come to.
bool has_stepped(const HeldLight& held, const HeldLight& next) {
    if (next.splits.near_step != held.splits.near_step || next.splits.far_step != held.splits.far_step) return true;
    return !std::equal(next.views.begin(), next.views.end(), held.views.begin(),
                       [](const HeldView& a, const HeldView& b) { return a.extent_step == b.extent_step; });
}

}  // namespace

HeldLight without_fits(const HeldLight& held) {
    HeldLight fresh = held;
    fresh.views = {};
    fresh.splits = {};
    fresh.sampled_ends = {};
    fresh.map_px = fresh.spare_frames = fresh.large_frames = fresh.tired_frames = 0;
    return fresh;
}

LightFit::LightFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, FitStorage& storage,
                   FittedViews& out)
    : scene_(scene),
      inputs_(inputs),
      light_(scene.lights[light]),
      index_(light),
      storage_(storage),
      out_(out),
      first_view_(out.views.size()),
      first_caster_(out.casters.size()),
      first_resized_(sizes_of(out.resized_sets)) {
    FitChoice& choice = out_.lights[index_];
    choice.request = inputs.requests[light];
    choice.sets = inputs.sets.lights[light];
}

LightFit::ArraySizes LightFit::sizes_of(const ReceiverCasterSets& sets) {
    return {sets.receiver_items.size(), sets.caster_items.size(), sets.receiver_points_ws.size(), sets.beams.size(),
            sets.outlines.size()};
}

std::span<const ShadowView> LightFit::views() const { return std::span(out_.views).subspan(first_view_); }

Reason LightFit::run(const HeldLight& held, bool recount, HeldLight& next) {
    forget_views();
    out_.casters.resize(first_caster_);
    const Reason reason = fit_and_count(held, recount, next) ? select_casters() : Reason::fit_degenerate;
    if (reason != Reason::none) forget_views();
    out_.lights[index_].views = {static_cast<std::uint32_t>(first_view_), static_cast<std::uint32_t>(views().size())};
    return reason;
}

void LightFit::request_anew(const ShadowRequest& request) {
    out_.lights[index_].request = request;
    select_sets_again();
}

void LightFit::forget_views() { out_.views.resize(first_view_); }

bool LightFit::fit_and_count(const HeldLight& held, bool recount, HeldLight& next) {
    if (!fit_size(held, next)) return false;
    if (is_count_due(held, next) || (recount && !views().empty())) return choose_count(held, next);
    return true;
}

/// Fits views without casters for maps of the request's size. False if no finite volume exists.
bool LightFit::fit_once(const HeldLight& held, HeldLight& next) {
    const ShadowRequest& request = out_.lights[index_].request;
    const LightSetsView sets = out_.sets_of(inputs_.sets, index_);
    const auto points = sets.receiver_points_ws();
    const FitInput input{light_,
                         request,
                         scene_,
                         sets.receivers(),
                         sets.casters(),
                         points,
                         sets.beams(),
                         sets.arrays.receiver_points_ws,
                         request.map.filtering.border_texel,
                         storage_.fits,
                         held,
                         next};
    ++out_.lights[index_].fits;
    if (!light_kind_row(light_.kind).fit(input, out_.views)) return false;
    for (std::size_t v = first_view_; v < out_.views.size(); ++v) {
        ShadowView& view = out_.views[v];
        view.light = index_;
        state_receivers(light_, sets.beams(), view);
        state_errors(scene_, points, edge_texel_at(request.map.filtering, finest_texel_m(view)), view);
    }
    return true;
}

/// Fits for the size that the accuracy target asks for.
bool LightFit::fit_size(const HeldLight& held, HeldLight& next) {
    std::uint32_t spare_frames = 0;
    FittedSizes sizes;
    bool fitted = false;
    for (std::uint32_t again = 0;; ++again) {
        forget_views();
        next = held;
        fitted = fit_once(held, next);
        // After kMostSizes one more is fitted, if they were too small: a border is another share of each size.
        if (!fitted || again > kMostSizes || (again == kMostSizes && meets_target())) break;
        if (!settle_size(light_, views(), held, sizes, spare_frames, request())) break;
        select_sets_again();
    }
    next.map_px = follows_contract(light_, request()) ? request().map.resolution_px : 0;
    next.spare_frames = next.map_px == held.map_px ? spare_frames : 0;
    return fitted;
}

bool LightFit::meets_target() const { return keeps_contract(predicted_px(views()), wished_error_px(light_.shadow)); }

/// Whether it is time to look for another number of cascades.
bool LightFit::is_count_due(const HeldLight& held, HeldLight& next) const {
    const ShadowRequest& request = out_.lights[index_].request;
    const std::uint32_t most = request.limits.max_views, usual = held.cascades > 0 ? held.cascades : most;
    if (most == 0) next.cascades = next.moves = 0;
    if (most == 0 || views().empty() || request.map.view_count != std::min(usual, most)) return false;
    if (held.cascades == 0) return true;
    if (next.views != held.views) ++next.moves;
    return next.map_px > held.map_px || has_stepped(held, next) || next.moves >= kMovesToCount;
}

/// Tries twice as many cascades again and again, each as if it were the first fit of this light: what is held is of
/// other slices.
bool LightFit::choose_count(const HeldLight& held, HeldLight& next) {
    const HeldLight fresh = without_fits(held);
    const ShadowRequest usual = request();
    const std::uint32_t most = usual.limits.max_views;
    std::array<CascadeTrial, kMaxCascades> trials;
    std::size_t tried = 0;
    // Fewer are for a scene that has calmed down: what makes the camera ask for more now may be gone in a frame.
    const std::uint32_t least = next.moves >= kMovesToCount ? 1 : std::max(held.cascades, 1u);
    for (std::uint32_t count = std::min(least, most);; count = std::min(2 * count, most)) {
        if (!fit_count(count, usual, fresh, next)) return false;
        const std::uint64_t edge_px = request().map.resolution_px;
        trials[tried++] = {count, predicted_px(views()), count * edge_px * edge_px};
        if (count == most) break;
    }
    const std::uint32_t chosen =
        contract_cascades(std::span(trials).first(tried), held.cascades, wished_error_px(light_.shadow));
    const bool stays = chosen == held.cascades;
    const bool fitted = fit_count(chosen, usual, stays ? held : fresh, next);
    next.cascades = chosen;
    next.moves = 0;
    return fitted;
}

bool LightFit::fit_count(std::uint32_t count, const ShadowRequest& usual, const HeldLight& held, HeldLight& next) {
    request() = usual;
    set_cascades(light_.tuning.cascades, count, request());
    set_most(light_, usual.limits.max_px, held.map_px, request());
    return fit_size(held, next);
}

/// A cube face's share of its neighbours is a share of its map: its sets follow from the size. Others' do not.
void LightFit::select_sets_again() {
    if (light_kind_row(light_.kind).texture != gl::TextureKind::cube) return;
    ReceiverCasterSets& sets = out_.resized_sets;
    sets.receiver_items.resize(first_resized_.receivers);
    sets.caster_items.resize(first_resized_.casters);
    sets.receiver_points_ws.resize(first_resized_.points);
    sets.beams.resize(first_resized_.beams);
    sets.outlines.resize(first_resized_.outlines);
    FitChoice& choice = out_.lights[index_];
    choice.sets = select_light_sets(scene_, index_, choice.request, lamp_ws_m(inputs_.lamps_ws_m, scene_, index_),
                                    storage_.sets, sets);
    choice.resized = true;
}

/// Selects the casters of each view. A face of a cube is drawn without casters, too, where the fit wants it: a filter
/// that reads across seams has to find there that it is empty.
Reason LightFit::select_casters() {
    ShadowRequest& request = out_.lights[index_].request;
    bool any = false;
    for (std::size_t v = first_view_; v < out_.views.size(); ++v) {
        ShadowView& view = out_.views[v];
        if (!request.rays.used && depth_step_m(view, request.map.depth_format) > view.error.texel_m &&
            view.error.texel_m > 0.0 && request.note == Reason::none)
            request.note = Reason::depth_coarse;
        const CasterInputs inputs{out_.sets_of(inputs_.sets, index_), request.map.filtering, inputs_.moving};
        select_view_casters(scene_, inputs, view, storage_.sets, out_.casters);
        view.lit = view.casters.count == 0 && view.projection != ViewProjection::cube_face;
        any = any || view.casters.count > 0;
    }
    return any ? Reason::none : Reason::no_caster;  // none where its shadow would be seen
}

}  // namespace gnomon::shadow
