#include "systems/shadow/budget/apply_budget.h"

#include <algorithm>
#include <cmath>

#include "engine/core/signature.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {
namespace {

/// Activity follows what happens by an eighth of the way per frame: half a second, as long as a thing that stopped
/// counts as moving (CasterMotion).
constexpr float kActivityGain = 1.0f / 8.0f;
/// Below, or so near to 1, it is taken to be there, so that a still scene comes to rest.
constexpr float kActivityRest = 1.0f / 64.0f;

/// Its map is another one at once, and fitted for it in the next frame.
constexpr std::uint32_t kNewFrames = 2;

/// Of the light itself, wherever it stands in a list.
std::uint64_t key_of(const LightItem& light) {
    Signature s;
    s.add(static_cast<std::uint64_t>(light.kind));
    for (int i = 0; i < 3; ++i) s.add(light.position_ws_m[i]);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) s.add(light.rotation_ws[column][row]);
    for (int i = 0; i < 3; ++i) s.add(light.colour[i]);
    s.add(light.intensity);
    s.add(light.range_m);
    s.add(light.outer_cone_rad);
    return s.value();
}

double area_px(const gl::Rect& rect) { return static_cast<double>(rect.width) * rect.height; }

/// Share of the picture within the rectangle around these points; all of it where one is not before the camera.
double seen_share(std::span<const glm::dvec3> points_ws, const ConsumerItem& c) {
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const double half_y = orthographic ? c.half_height_m : std::tan(0.5 * c.fov_y_rad);
    const glm::dvec2 half(half_y * aspect(c), half_y);
    glm::dvec2 low(1.0), high(-1.0);
    for (const glm::dvec3& point : points_ws) {
        const glm::dvec3 p = (point - c.position_ws_m) * c.rotation_ws;  // view axes
        if (!orthographic && !(-p.z > 0.0)) return 1.0;
        const glm::dvec2 at = glm::clamp(glm::dvec2(p) / (half * (orthographic ? 1.0 : -p.z)), -1.0, 1.0);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 size = glm::max(high - low, 0.0);
    return 0.25 * size.x * size.y;
}

/// Half of the way to the farthest receiver, as bright as it is there.
double typical_lux(const LightItem& light, std::span<const Beam> beams) {
    const double emitted = static_cast<double>(light.intensity) *
                           static_cast<double>(std::max({light.colour.r, light.colour.g, light.colour.b}));
    if (light.kind == LightKind::directional) return emitted;
    double reach_m = 0.0;
    for (const Beam& beam : beams)
        if (beam.receivers > 0) reach_m = std::max(reach_m, beam.reach_m);
    const double way_m = 0.5 * (light.range_m > 0.0 ? std::min(reach_m, light.range_m) : reach_m);
    return emitted / (way_m * way_m);
}

/// What drawing all of its views would draw.
void count_draws(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const ShadowView& view,
                 LightLoad& load) {
    std::uint32_t last_mesh = ~0u;
    for (const std::uint32_t i : std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count)) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        load.triangles += gpu.mesh(mesh).triangles;
        load.draws += mesh != last_mesh ? 1 : 0;
        last_mesh = mesh;
    }
}

/// The edge that the light would have if nothing were granted, told by maps that may be smaller.
std::uint32_t needed_px(const LightItem& light, const ShadowDemand& wanted, const ShadowDemand& fitted,
                        double extent_px) {
    const bool as_wanted = fitted.filter == wanted.filter && fitted.view_count == wanted.view_count &&
                           (fitted.resolution_px < fitted.most_px || fitted.most_px == wanted.most_px);
    if (as_wanted) return fitted.resolution_px;
    if (!follows_contract(light, wanted)) return wanted.most_px;
    const double edge_texel = static_cast<double>(wanted.filtering.widest_texel - wanted.filtering.still_texel);
    return contract_size_px(fitted.resolution_px, false, edge_error_px(extent_px, edge_texel),
                            wished_error_px(light.shadow), wanted.most_px);
}

BudgetReport outcome(const LightLoad& load, const Grant& grant, const CostFactors& factors) {
    const ShadowDemand given = granted(*load.light, load.wanted, grant);
    const Cost full = cost_of(load, {}, factors), cost = cost_of(load, grant, factors);
    BudgetReport out;
    out.wanted_px = load.wanted.resolution_px;
    out.px = grant.none ? 0 : given.resolution_px;
    out.wanted_views = load.wanted.view_count;
    out.views = grant.none ? 0 : given.view_count;
    out.refresh_frames = given.refresh_frames;
    out.plain = given.filter != load.wanted.filter;
    out.wanted_bytes = full.bytes;
    out.bytes = cost.bytes;
    out.wanted_us = static_cast<double>(full.ns) * 1.0e-3;
    out.us = static_cast<double>(cost.ns) * 1.0e-3;
    out.harm = cost.harm;
    return out;
}

}  // namespace

void BudgetStage::apply(const SceneSnapshot& scene, const History& held, std::vector<ShadowDemand>& demands) {
    if (!is_active()) return;
    wanted_ = demands;
    std::size_t guess = 0;
    for (ShadowDemand& demand : demands) {
        if (demand.skip != Reason::none) continue;
        const LightItem& light = scene.lights[demand.light];
        const HeldLight* last = find(held, light.entity, guess++);
        if (last && !last->grant.none) demand = granted(light, demand, last->grant);
    }
}

LightLoad BudgetStage::load_of(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame,
                               std::uint32_t d, std::size_t first_view, std::size_t end_view,
                               const HeldLight& next) const {
    const ShadowDemand& fitted = frame.demands[d];
    LightLoad load;
    load.light = &scene.lights[fitted.light];
    load.wanted = wanted_[d];
    // The fit may have found another count of cascades to be enough.
    if (next.grant.most_views >= load.wanted.view_count && fitted.view_count != load.wanted.view_count) {
        load.wanted.view_count = fitted.view_count;
        set_most(*load.light, load.wanted.most_px, 0, load.wanted);
    }
    load.key = key_of(*load.light);
    load.activity = load.light->tuning.reuse.economy ? static_cast<double>(next.activity) : 1.0;
    double extent_px = 0.0;
    for (std::size_t v = first_view; v < end_view; ++v) {
        const ShadowView& view = frame.views[v];
        if (view.casters.count == 0) continue;
        ++load.views;
        extent_px = std::max(extent_px, view.texel_extent_px);
        if (load.activity > 0.0) count_draws(scene, gpu, frame, view, load);
    }
    const auto fewer = static_cast<double>(load.wanted.view_count) - static_cast<double>(fitted.view_count);
    extent_px *= std::exp2(-fewer);  // each cascade about doubles what one texel can serve
    const std::uint32_t needed = needed_px(*load.light, load.wanted, fitted, extent_px);
    load.extent_px = extent_px * fitted.resolution_px / needed;
    if (needed != load.wanted.resolution_px) set_resolution(*load.light, needed, load.wanted);
    const IndexRange& corners = frame.sets[d].receiver_points;
    const auto points = std::span(frame.receiver_points_ws).subspan(corners.first, corners.count);
    for (const ConsumerItem& consumer : scene.consumers) {
        load.pixels += area_px(screen_rectangle(*load.light, consumer));
        load.weight = std::max(load.weight, seen_share(points, consumer));
    }
    return load;
}

/// What is bright matters more, as the eye has it: lightness goes with the cube root of luminance (CIE 1976).
void BudgetStage::weigh(const SceneSnapshot& scene, const ShadowFrame& frame) {
    const auto lux = [&](std::size_t i) {
        const PotentialSets& sets = frame.sets[demands_[i]];
        return typical_lux(scene.lights[frame.demands[demands_[i]].light],
                           std::span(frame.beams).subspan(sets.beams.first, sets.beams.count));
    };
    double brightest = 0.0;
    for (std::size_t i = 0; i < loads_.size(); ++i)
        if (std::isfinite(lux(i))) brightest = std::max(brightest, lux(i));
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        const double share = lux(i) / brightest;
        loads_[i].weight *= share < 1.0 ? std::cbrt(share) : 1.0;
    }
}

/// Returns the bytes of lights that are not asked, since the device has no room for what they want.
std::uint64_t BudgetStage::collect(const SceneSnapshot& scene, const GpuScene& gpu, WaitingBytes waiting_bytes,
                                   ShadowFrame& frame) {
    loads_.clear();
    grants_.clear();
    demands_.clear();
    held_.clear();
    std::size_t held = 0, first = 0, end = 0;
    std::uint64_t fixed_bytes = 0;
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d, first = end) {
        while (end < frame.views.size() && frame.views[end].demand == d) ++end;
        if (frame.demands[d].skip != Reason::none) continue;
        const HeldLight& next = frame.next_history.lights[held++];
        if (frame.sets[d].skip != Reason::none || first == end) continue;
        if (waiting_bytes[frame.demands[d].light]) {
            fixed_bytes += *waiting_bytes[frame.demands[d].light];
            continue;
        }
        loads_.push_back(load_of(scene, gpu, frame, d, first, end, next));
        grants_.push_back(next.grant);
        demands_.push_back(d);
        held_.push_back(held - 1);
    }
    weigh(scene, frame);
    return fixed_bytes;
}

/// What a grant leaves of a demand that was fitted for another one, as far as can be now: the rest in the next frame.
void BudgetStage::grant(const LightLoad& load, const Grant& grant, ShadowDemand& demand, PotentialSets& sets) const {
    if (grant.none) {
        sets.skip = Reason::over_budget;
        return;
    }
    const ShadowDemand given = granted(*load.light, load.wanted, grant);
    demand.over_budget = is_less(*load.light, load.wanted, grant);
    demand.refresh_frames = given.refresh_frames;
    demand.weight = load.weight;
    if (given.filter != demand.filter && given.filter == kPlainFilter) {
        demand.filter = kPlainFilter;
        set_resolution(*load.light, demand.resolution_px, demand);
    }
    const std::uint64_t most_bytes = map_bytes(*load.light, given);
    demand.map_px = std::min(demand.resolution_px, given.resolution_px);
    while (demand.map_px > 1 && map_bytes(*load.light, demand) > most_bytes) demand.map_px /= 2;
}

void BudgetStage::decide(const SceneSnapshot& scene, const GpuScene& gpu, const History& held,
                         WaitingBytes waiting_bytes, ShadowFrame& frame) {
    History& next = frame.next_history;
    next.calm_frames = is_active() ? held.calm_frames : 0;
    outcomes_.clear();
    if (!is_active()) {
        loads_.clear();
        for (HeldLight& light : next.lights) light.grant = {}, light.activity = 0.0f, light.new_frames = 0;
        return;
    }
    BudgetLimits limits = limits_;
    const std::uint64_t fixed_bytes = collect(scene, gpu, waiting_bytes, frame);
    if (limits.bytes != BudgetLimits::kNone) limits.bytes -= std::min(limits.bytes, fixed_bytes);
    settle_grants(loads_, limits, factors_, next.calm_frames, grants_, scratch_);
    lookups_ns_ = 0.0;
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        HeldLight& light = next.lights[held_[i]];
        lookups_ns_ += lookup_ns(loads_[i], grants_[i], factors_);
        light.new_frames = light.grant == grants_[i] ? light.new_frames - std::min(light.new_frames, 1u) : kNewFrames;
        light.grant = grants_[i];
        grant(loads_[i], grants_[i], frame.demands[demands_[i]], frame.sets[demands_[i]]);
        outcomes_.push_back(outcome(loads_[i], grants_[i], factors_));
    }
    decided_factors_ = factors_;
}

void BudgetStage::spread_draws(const GpuScene& gpu, const SceneSnapshot& scene, ShadowFrame& frame) {
    if (limits_.ns == BudgetLimits::kNone) return;
    due_.clear();
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        const ShadowSlot& slot = frame.slots[v];
        if (!slot.texture || slot.reuse) continue;
        const ShadowDemand& demand = frame.demands[view.demand];
        LightLoad load;
        count_draws(scene, gpu, frame, view, load);
        const double casters = storage_work(filter_row(demand.filter).storage).casters;
        const double ns = drawing_ns(demand, slot.size_px, 1.0, static_cast<double>(load.triangles) * casters,
                                     static_cast<double>(load.draws) * casters);
        const bool may_wait = std::isfinite(slot.if_held.error_px) && slot.waited_frames < kMostWait_frames;
        const double harm = may_wait ? demand.weight * edge_harm(slot.if_held.error_px) : DueView::kMustNotWait;
        due_.push_back({v, ns * factors_.drawing, harm, slot.content});
    }
    const double room_ns = std::max(static_cast<double>(limits_.ns) - lookups_ns_, 0.0);
    const std::size_t waiting = choose_waiting(room_ns, due_);
    for (std::size_t i = 0; i < waiting; ++i) keep_layer(frame.slots[due_[i].view], Hold::by_turn);
}

void BudgetStage::note_changes(const SceneSnapshot& scene, ShadowFrame& frame) const {
    std::size_t first = 0, end = 0;
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        const std::uint32_t d = demands_[i];
        while (first < frame.views.size() && frame.views[first].demand < d) ++first;
        float views = 0.0f, changed = 0.0f;
        for (end = first; end < frame.views.size() && frame.views[end].demand == d; ++end) {
            const ShadowView& view = frame.views[end];
            const bool has_moving = view.still_casters < view.casters.count;
            const bool is_kept = static_cast<bool>(frame.slots[end].texture);
            views += 1.0f;
            changed += (is_kept ? frame.slots[end].changed : has_moving) ? 1.0f : 0.0f;
        }
        if (!scene.lights[frame.demands[d].light].tuning.reuse.economy || views == 0.0f) continue;
        if (frame.next_history.lights[held_[i]].new_frames > 0) continue;
        float& activity = frame.next_history.lights[held_[i]].activity;
        const float now = changed / views;
        activity += (now - activity) * kActivityGain;
        if (std::abs(now - activity) < kActivityRest) activity = now;
    }
}

void BudgetStage::report(FrameReport& report) const {
    for (std::size_t i = 0; i < outcomes_.size(); ++i) report.lights[demands_[i]].budget = outcomes_[i];
}

bool BudgetStage::is_moved_by(const BudgetLimits& limits, const CostFactors& factors) const {
    if (!(limits == limits_)) return true;
    constexpr double kNotice = 0.02;  // a fifth of the room that giving back leaves (kRoomAfter)
    const auto moved = [](double now, double then) { return std::abs(now - then) > kNotice * then; };
    return is_active() &&
           (moved(factors.drawing, decided_factors_.drawing) || moved(factors.lighting, decided_factors_.lighting));
}

}  // namespace gnomon::shadow
