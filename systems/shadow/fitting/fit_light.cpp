#include "systems/shadow/fitting/fit_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
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

/// How often a light is fitted anew for maps of another size: for what its present ones tell, and once more because a
/// filter's border is a larger share of a smaller map.
constexpr int kMostSizes = 2;

/// Edge of the smallest texel in metres across the light.
double finest_texel_m(const ShadowView& view) {
    const double texel = std::min(view.texel_u, view.texel_v);
    return view.projection == ViewProjection::orthographic ? texel : texel * view.near_m;
}

/// What the view's texels mean on the screen of the consumer that sees them largest. A warped map serves its own slice
/// alone: its fit has said it.
void state_errors(const SceneSnapshot& scene, std::span<const glm::dvec3> points_ws, double reach_texel,
                  ShadowView& view) {
    for (std::uint32_t c = 0; c < scene.consumers.size(); ++c)
        if (view.warp == glm::dvec2(0.0)) state_error(scene.consumers[c], points_ws, reach_texel, view);
}

/// Whose receivers lie in it: of a sun's cascades those of all, since each may reach into another's slice.
void state_receivers(const LightItem& light, const PotentialSets& sets, const ShadowFrame& frame, ShadowView& view) {
    const bool sun = light.kind == LightKind::directional;
    const Beam& beam = frame.beams[sets.beams.first + (sun ? 0 : view.layer)];
    view.consumer_mask = beam.consumers;
    if (view.receivers == 0) view.receivers = beam.receivers;
}

/// What floats tell apart along a lamp's rays, and doubles of its place: a share of the distance, or of the depth range
/// of a view that is anchored in it. It is more than a texel only where a lamp is immensely far away.
double floats_tell_m(const ShadowView& view) {
    constexpr double kFloat = 0x1p-22, kDouble = math::kClippedRounding;
    const double anchored_m = (view.far_m - view.near_m) * view.far_m / view.near_m;
    const double from_m = view.apex_m > 0.0 ? std::min(view.far_m, anchored_m) : view.far_m;
    return std::max(kFloat * from_m, kDouble * view.far_m);
}

/// Depths that differ by less are one, at the farthest receiver: 0 of a sun's floats.
double depth_step_m(const ShadowView& view, DepthFormat format) {
    const double step = depth_format_row(format).step;
    if (view.projection == ViewProjection::orthographic) return step * (view.far_m - view.near_m);
    return std::max(step * view.far_m * view.far_m / std::abs(view.depth_beta),  // d(alpha + beta / z)
                    floats_tell_m(view));
}

/// The light's views, without casters, for maps of its demand's size. False if no finite volume exists.
bool fit_light(const SceneSnapshot& scene, const HeldLight& held, std::uint32_t d, HeldLight& next,
               ShadowFrame& frame) {
    const PotentialSets& sets = frame.sets[d];
    const ShadowDemand& demand = frame.demands[d];
    const LightItem& light = scene.lights[demand.light];
    const auto points =
        std::span(frame.receiver_points_ws).subspan(sets.receiver_points.first, sets.receiver_points.count);
    const FitInput input{light,
                         demand,
                         scene,
                         std::span(frame.receiver_items).subspan(sets.receivers.first, sets.receivers.count),
                         std::span(frame.caster_items).subspan(sets.casters.first, sets.casters.count),
                         points,
                         std::span(frame.beams).subspan(sets.beams.first, sets.beams.count),
                         frame.receiver_points_ws,
                         demand.filtering.border_texel,
                         frame.fit_scratch,
                         held,
                         next};
    const std::size_t first = frame.views.size();
    if (!light_kind_row(light.kind).fit(input, frame.views)) return false;
    for (std::size_t v = first; v < frame.views.size(); ++v) {
        ShadowView& view = frame.views[v];
        view.demand = d;
        state_receivers(light, sets, frame, view);
        state_errors(scene, points, edge_texel_at(demand.filtering, finest_texel_m(view)), view);
    }
    return true;
}

double predicted_px(std::span<const ShadowView> views) {
    double worst_px = 0.0;
    for (const ShadowView& view : views) worst_px = std::max(worst_px, view.predicted_error_px);
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
                 std::uint32_t& spare_frames, ShadowDemand& demand) {
    if (views.empty() || !follows_contract(light, demand)) return false;
    const bool is_held = demand.resolution_px == held.map_px;
    const double wished_px = wished_error_px(light.shadow), error_px = predicted_px(views);
    fitted.note(demand.resolution_px, keeps_contract(error_px, wished_px));
    const std::uint32_t wish_px = contract_size_px(demand.resolution_px, is_held, error_px, wished_px, demand.most_px);
    const std::uint32_t size_px = std::min(fitted.between(wish_px), demand.most_px);
    const bool spare = is_held && size_px < demand.resolution_px;
    // Beyond kSpareFrames it was tried, and found too little: a filter's border is a larger share of a smaller map.
    if (is_held) spare_frames = spare ? std::min(held.spare_frames + 1, kSpareFrames + 1) : 0;
    if (size_px == demand.resolution_px || (spare && spare_frames != kSpareFrames)) return false;
    set_resolution(light, size_px, demand);
    return true;
}

/// One light's views, from `first` on in the frame, in maps of the size that its contract asks for.
class LightFit {
public:
    LightFit(const SceneSnapshot& scene, std::uint32_t d, ShadowFrame& frame)
        : scene_(scene),
          light_(scene.lights[frame.demands[d].light]),
          d_(d),
          frame_(frame),
          first_(frame.views.size()) {}

    /// False if no finite volume exists.
    bool run(const HeldLight& held, bool recount, HeldLight& next) {
        if (!fit(held, next)) return false;
        if (is_count_due(held, next) || (recount && !views().empty())) return choose_count(held, next);
        return true;
    }

private:
    ShadowDemand& demand() { return frame_.demands[d_]; }
    std::span<const ShadowView> views() const { return std::span(frame_.views).subspan(first_); }

    bool fit(const HeldLight& held, HeldLight& next) {
        std::uint32_t spare_frames = 0;
        FittedSizes sizes;
        bool fitted = false;
        for (int again = 0;; ++again) {
            frame_.views.resize(first_);
            next = held;
            fitted = fit_light(scene_, held, d_, next, frame_);
            // After kMostSizes one more is fitted, if they were too small: a border is another share of each size.
            if (!fitted || again > kMostSizes || (again == kMostSizes && keeps_wish())) break;
            if (!settle_size(light_, views(), held, sizes, spare_frames, demand())) break;
            select_sets_again(scene_, d_, frame_);
        }
        next.map_px = follows_contract(light_, demand()) ? demand().resolution_px : 0;
        next.spare_frames = next.map_px == held.map_px ? spare_frames : 0;
        return fitted;
    }

    bool keeps_wish() const { return keeps_contract(predicted_px(views()), wished_error_px(light_.shadow)); }

    /// Whether it is time to look for another number of cascades.
    bool is_count_due(const HeldLight& held, HeldLight& next) {
        const std::uint32_t most = demand().most_views, usual = held.cascades > 0 ? held.cascades : most;
        if (most == 0) next.cascades = next.moves = 0;
        if (most == 0 || views().empty() || demand().view_count != std::min(usual, most)) return false;
        if (held.cascades == 0) return true;
        if (next.views != held.views) ++next.moves;
        return next.map_px > held.map_px || has_stepped(held, next) || next.moves >= kMovesToCount;
    }

    /// Whether what is seen takes another size: so does then what another number of maps would come to.
    static bool has_stepped(const HeldLight& held, const HeldLight& next) {
        if (next.splits.near_step != held.splits.near_step || next.splits.far_step != held.splits.far_step) return true;
        return !std::equal(next.views.begin(), next.views.end(), held.views.begin(),
                           [](const HeldView& a, const HeldView& b) { return a.extent_step == b.extent_step; });
    }

    /// Tries twice as many again and again, each as if it were the first fit of this light: what is held is of other
    /// slices.
    bool choose_count(const HeldLight& held, HeldLight& next) {
        const HeldLight fresh = without_fits(held);
        const ShadowDemand usual = demand();
        std::array<CascadeTrial, kMaxCascades> trials;
        std::size_t tried = 0;
        // Fewer are for a scene that has calmed down: what makes the camera ask for more now may be gone in a frame.
        const std::uint32_t least = next.moves >= kMovesToCount ? 1 : std::max(held.cascades, 1u);
        for (std::uint32_t count = std::min(least, usual.most_views);; count = std::min(2 * count, usual.most_views)) {
            if (!fit_count(count, usual, fresh, next)) return false;
            const std::uint64_t edge_px = demand().resolution_px;
            trials[tried++] = {count, predicted_px(views()), count * edge_px * edge_px};
            if (count == usual.most_views) break;
        }
        const std::uint32_t chosen =
            contract_cascades(std::span(trials).first(tried), held.cascades, wished_error_px(light_.shadow));
        const bool stays = chosen == held.cascades;
        const bool fitted = fit_count(chosen, usual, stays ? held : fresh, next);
        next.cascades = chosen;
        next.moves = 0;
        return fitted;
    }

    bool fit_count(std::uint32_t count, const ShadowDemand& usual, const HeldLight& held, HeldLight& next) {
        demand() = usual;
        set_cascades(light_.tuning.cascades, count, demand());
        set_most(light_, usual.most_px, held.map_px, demand());
        return fit(held, next);
    }

    const SceneSnapshot& scene_;
    const LightItem& light_;
    std::uint32_t d_;
    ShadowFrame& frame_;
    std::size_t first_;
};

/// The lists of the views from `first` on. False if all are empty. A face of a cube is drawn without casters, too,
/// where the fit wants it: a filter that reads across seams has to find there that it is empty.
bool select_casters(const SceneSnapshot& scene, std::size_t first, ShadowFrame& frame) {
    bool any = false;
    for (std::size_t v = first; v < frame.views.size(); ++v) {
        ShadowView& view = frame.views[v];
        select_view_casters(scene, view, frame);
        view.lit = view.casters.count == 0 && view.projection != ViewProjection::cube_face;
        any = any || view.casters.count > 0;
    }
    return any;
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

void fit_light_views(const SceneSnapshot& scene, std::uint32_t d, const HeldLight& held, bool recount, HeldLight& next,
                     ShadowFrame& frame) {
    PotentialSets& sets = frame.sets[d];
    ShadowDemand& demand = frame.demands[d];
    const std::size_t first = frame.views.size();
    if (!LightFit(scene, d, frame).run(held, recount, next)) {
        frame.views.resize(first);
        sets.skip = Reason::fit_degenerate;
        return;
    }
    if (frame.views.size() == first) sets.skip = Reason::no_caster;  // none where its shadow would be seen
    for (std::size_t v = first; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        if (!demand.asks_rays && depth_step_m(view, demand.depth_format) > view.texel_m && view.texel_m > 0.0 &&
            demand.note == Reason::none)
            demand.note = Reason::depth_coarse;
    }
    if (!select_casters(scene, first, frame)) {
        frame.views.resize(first);
        sets.skip = Reason::no_caster;
    }
}

}  // namespace gnomon::shadow
