#include "systems/shadow/budget/apply_budget.h"

#include <algorithm>
#include <cmath>

#include "engine/core/signature.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/budget/automatic_limit.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/limited_request.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {
namespace {

/// Share of the remaining difference by which activity follows changes per frame. It takes half a second, as long as a
/// stopped object counts as moving (DynamicCasters).
constexpr float kActivityGain = 1.0f / 8.0f;
/// Difference below which activity takes its final value, so that a static scene settles.
constexpr float kActivityRest = 1.0f / 64.0f;

/// Frames in which activity is not measured after limits changed. The map changes at once, and is fitted for the new
/// limits in the next frame.
constexpr std::uint32_t kNewFrames = 2;

/// Returns a hash of the light itself, independent of its place in a list.
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

/// Returns the share of the screen within the rectangle around these points, 0 to 1. 1 if a point is not in front of
/// the camera.
double seen_share(std::span<const glm::dvec3> points_ws, const ConsumerItem& c) {
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const glm::dvec2 half = half_extent(c);
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

/// Returns the light's illuminance halfway to its farthest receiver, lux.
double typical_lux(const LightItem& light, std::span<const ReceiverHull> hulls) {
    double reach_m = 0.0;
    for (const ReceiverHull& receiver_hull : hulls)
        if (receiver_hull.receivers > 0) reach_m = std::max(reach_m, receiver_hull.reach_m);
    const double way_m = 0.5 * (light.range_m > 0.0 ? std::min(reach_m, light.range_m) : reach_m);
    return illuminance_lux(light, way_m * way_m);
}

/// Returns the map edge that the light needs without quality limits, texels. Derives it from the fitted maps, which may
/// be smaller.
std::uint32_t needed_px(const LightItem& light, const ShadowRequest& wanted, const ShadowRequest& fitted,
                        double extent_px) {
    const bool as_wanted =
        fitted.map.filter == wanted.map.filter && fitted.map.view_count == wanted.map.view_count &&
        (fitted.map.resolution_px < fitted.limits.max_px || fitted.limits.max_px == wanted.limits.max_px);
    if (as_wanted) return fitted.map.resolution_px;
    if (!adapts_to_target(light, wanted)) return wanted.limits.max_px;
    const double edge_texel = static_cast<double>(wanted.map.filtering.widest_texel - wanted.map.filtering.still_texel);
    return target_size_px(fitted.map.resolution_px, false, edge_error_px(extent_px, edge_texel),
                          texel_target_px(light.shadow, wanted.map.filter), wanted.limits.max_px);
}

BudgetReport outcome(const LightLoad& load, const QualityLimits& grant, const CostFactors& factors) {
    const ShadowRequest given = granted(*load.light, load.wanted, grant);
    const Cost full = cost_of(load, {}, factors), cost = cost_of(load, grant, factors);
    BudgetReport out;
    out.wanted_px = load.wanted.map.resolution_px;
    out.px = grant.none ? 0 : given.map.resolution_px;
    out.wanted_views = load.wanted.map.view_count;
    out.views = grant.none ? 0 : given.map.view_count;
    out.refresh_frames = refresh_frames(*load.light, grant);
    out.plain = given.map.filter != load.wanted.map.filter;
    out.wanted_bytes = full.bytes;
    out.bytes = cost.bytes;
    out.wanted_us = static_cast<double>(full.ns) * 1.0e-3;
    out.us = static_cast<double>(cost.ns) * 1.0e-3;
    out.harm = cost.harm;
    return out;
}

/// Applies the limits to a fitted request, as far as possible after the fit. The rest follows in the next frame.
void cut(const LightLoad& load, const QualityLimits& grant, BudgetDecision& decision) {
    const LightItem& light = *load.light;
    ShadowRequest& request = decision.request;
    const ShadowRequest given = granted(light, load.wanted, grant);
    decision.over_budget = is_less(light, load.wanted, grant);
    decision.refresh_frames = refresh_frames(light, grant);
    decision.weight = load.weight;
    if (given.map.filter != request.map.filter && given.map.filter == kCheapestFilter) {
        request.map.filter = kCheapestFilter;
        set_resolution(light, request.map.resolution_px, request);
    }
    const std::uint64_t most_bytes = map_bytes(light, given);
    request.map.reduced_px = std::min(request.map.resolution_px, given.map.resolution_px);
    while (request.map.reduced_px > 1 && map_bytes(light, request) > most_bytes) request.map.reduced_px /= 2;
}

}  // namespace

LightLoad BudgetStage::load_of(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs,
                               std::uint32_t light, const LightFitHistory& next) const {
    const ShadowRequest& fitted = inputs.fitted.lights[light].request;
    LightLoad load;
    load.light = &scene.lights[light];
    load.wanted = inputs.requests[light];
    // The fit may have found another number of cascades to be enough.
    if (next.budget.grant.most_views >= load.wanted.map.view_count &&
        fitted.map.view_count != load.wanted.map.view_count) {
        load.wanted.map.view_count = fitted.map.view_count;
        set_most(*load.light, load.wanted.limits.max_px, 0, load.wanted);
    }
    load.key = key_of(*load.light);
    load.sizes_first = is_automatic();
    load.activity = load.light->tuning.reuse.economy ? static_cast<double>(next.budget.activity) : 1.0;
    double extent_px = 0.0;
    for (const ShadowView& view : inputs.fitted.views_of(light)) {
        if (view.casters.count == 0) continue;
        ++load.views;
        extent_px = std::max(extent_px, view.error.extent_px);
        if (!(load.activity > 0.0)) continue;
        const DrawCounts counts = count_draws(scene, gpu, inputs.fitted.casters_of(view));
        load.triangles += counts.triangles;
        load.draws += counts.draws;
    }
    const auto fewer = static_cast<double>(load.wanted.map.view_count) - static_cast<double>(fitted.map.view_count);
    extent_px *= std::exp2(-fewer);  // each cascade about doubles the depth range that one texel size serves
    const std::uint32_t needed = needed_px(*load.light, load.wanted, fitted, extent_px);
    const double seen_px = is_automatic() ? usual_extent_px(scene, inputs, light) * std::exp2(-fewer) : extent_px;
    load.extent_px = seen_px * fitted.map.resolution_px / needed;
    if (needed != load.wanted.map.resolution_px) set_resolution(*load.light, needed, load.wanted);
    const auto points = inputs.fitted.sets_of(inputs.sets, light).receiver_points_ws();
    for (std::size_t i = light; i < inputs.sets.lit_areas.size(); i += scene.lights.size())
        load.pixels += area_px(inputs.sets.lit_areas[i].screen);
    for (const ConsumerItem& consumer : scene.consumers)
        load.weight = std::max(load.weight, seen_share(points, consumer));
    return load;
}

/// Returns the usual extent of a texel on screen over what is seen of the light's receivers, pixels. All views count
/// alike: a sun's cascades share the picture, however many points lie far away.
double BudgetStage::usual_extent_px(const SceneSnapshot& scene, const BudgetInputs& inputs, std::uint32_t light) {
    double log2_px = 0.0, views = 0.0;
    const auto points = inputs.fitted.sets_of(inputs.sets, light).error_points_ws();
    for (const ShadowView& view : inputs.fitted.views_of(light)) {
        if (view.casters.count == 0) continue;
        ExtentSum sum;
        for (const ConsumerItem& consumer : scene.consumers) add_extents(consumer, points, view, sum);
        if (sum.points == 0) continue;
        log2_px += sum.log2_px / static_cast<double>(sum.points);
        views += 1.0;
    }
    return views > 0.0 ? std::exp2(log2_px / views) : 0.0;
}

/// Weighs each light's shadow by brightness. Lightness grows with the cube root of luminance (CIE 1976).
void BudgetStage::weigh(const SceneSnapshot& scene, const BudgetInputs& inputs) {
    const auto lux = [&](std::size_t i) {
        return typical_lux(scene.lights[lights_[i]], inputs.fitted.sets_of(inputs.sets, lights_[i]).hulls());
    };
    double brightest = 0.0;
    for (std::size_t i = 0; i < loads_.size(); ++i)
        if (const double value = lux(i); std::isfinite(value)) brightest = std::max(brightest, value);
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        const double share = lux(i) / brightest;
        loads_[i].weight *= share < 1.0 ? std::cbrt(share) : 1.0;
    }
}

/// Collects the lights that take part. Returns the bytes of the other maps: the device has no room for maps as their
/// lights need them.
std::uint64_t BudgetStage::collect(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs,
                                   const History& next, std::span<const LightStatus> statuses) {
    loads_.clear();
    grants_.clear();
    lights_.clear();
    histories_.clear();
    std::size_t history = 0;
    std::uint64_t fixed_bytes = 0;
    for (std::uint32_t i = 0; i < inputs.fitted.lights.size(); ++i) {
        const FitChoice& choice = inputs.fitted.lights[i];
        if (choice.request.skip != Reason::none) continue;
        const LightFitHistory& entry = next.lights[history++];
        if (statuses[i].is_skipped() || choice.views.count == 0) continue;
        if (is_automatic() && !leaves_size(scene.lights[i])) continue;
        if (inputs.waiting_bytes[i]) {
            fixed_bytes += *inputs.waiting_bytes[i];
            continue;
        }
        grants_.push_back(entry.budget.grant);
        lights_.push_back(i);
        histories_.push_back(history - 1);
    }
    loads_.resize(lights_.size());
    for_each_light(inputs.jobs, loads_.size(), [&](std::size_t i, std::size_t) {
        loads_[i] = load_of(scene, gpu, inputs, lights_[i], next.lights[histories_[i]]);
    });
    weigh(scene, inputs);
    return fixed_bytes;
}

void BudgetStage::apply_automatic(const SceneSnapshot& scene, const FittedViews& fitted, const History& previous,
                                  std::span<const LightStatus> statuses) {
    given_bytes_ = 0;
    if (automatic_bytes_ == BudgetLimits::kNone) return;
    const WantedBytes wanted = wanted_bytes(scene, fitted, statuses);
    if (previous.short_of_bytes || wanted.limited > automatic_bytes_)
        limits_.bytes = std::min(limits_.bytes, automatic_bytes_);
    // A lower limit is what the device has: nothing comes on top of that.
    if (limits_.bytes >= automatic_bytes_) given_bytes_ = wanted.given;
}

void BudgetStage::decide(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs, History& next,
                         std::vector<BudgetDecision>& decisions, const LightAccounts& accounts) {
    decisions.clear();
    for (const FitChoice& choice : inputs.fitted.lights) decisions.push_back({choice.request});
    next.short_of_bytes = false;
    next.frames_since_grants = is_active() ? inputs.previous.frames_since_grants : 0;
    outcomes_.clear();
    if (!is_active()) {
        loads_.clear();
        for (LightFitHistory& light : next.lights) light.budget = {};
        return;
    }
    BudgetLimits limits = limits_;
    const std::uint64_t fixed_bytes = collect(scene, gpu, inputs, next, accounts.statuses);
    if (limits.bytes != BudgetLimits::kNone) limits.bytes -= std::min(limits.bytes, fixed_bytes);
    settle_limits(loads_, limits, factors_, next.frames_since_grants, grants_, scratch_);
    lookups_ns_ = 0.0;
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        BudgetHistory& history = next.lights[histories_[i]].budget;
        lookups_ns_ += lookup_ns(loads_[i], grants_[i], factors_);
        const bool same = history.grant == grants_[i];
        history.new_frames = same ? history.new_frames - std::min(history.new_frames, 1u) : kNewFrames;
        history.grant = grants_[i];
        outcomes_.push_back(outcome(loads_[i], grants_[i], factors_));
        if (grants_[i].none) {
            accounts.statuses[lights_[i]].skip(Reason::over_budget);
            continue;
        }
        BudgetDecision& decision = decisions[lights_[i]];
        const Reason note = decision.request.note;
        cut(loads_[i], grants_[i], decision);
        if (decision.request.note != note) accounts.statuses[lights_[i]].degrade(decision.request.note);
    }
    decided_factors_ = factors_;
    next.short_of_bytes = is_automatic() && (is_any_less() || next.frames_since_grants < kFramesToRegrant);
}

/// Returns whether any light has less than it wants.
bool BudgetStage::is_any_less() const {
    for (std::size_t i = 0; i < loads_.size(); ++i)
        if (is_less(*loads_[i].light, loads_[i].wanted, grants_[i])) return true;
    return false;
}

DrawAllowance BudgetStage::draw_allowance() const {
    if (limits_.ns == BudgetLimits::kNone) return {};
    return {true, std::max(static_cast<double>(limits_.ns) - lookups_ns_, 0.0), factors_.drawing};
}

void BudgetStage::note_changes(const SceneSnapshot& scene, const DrawnViews& drawn, History& next) const {
    for (std::size_t i = 0; i < loads_.size(); ++i) {
        const IndexRange range = drawn.fitted.lights[lights_[i]].views;
        float views = 0.0f, changed = 0.0f;
        for (std::size_t v = range.first; v < range.end(); ++v) {
            const ShadowView& view = drawn.fitted.views[v];
            const bool has_moving = view.static_casters < view.casters.count;
            views += 1.0f;
            changed += (drawn.has_map(v) ? drawn.updates[v].changed : has_moving) ? 1.0f : 0.0f;
        }
        if (!scene.lights[lights_[i]].tuning.reuse.economy || views == 0.0f) continue;
        BudgetHistory& history = next.lights[histories_[i]].budget;
        if (history.new_frames > 0) continue;
        float& activity = history.activity;
        const float now = changed / views;
        activity += (now - activity) * kActivityGain;
        if (std::abs(now - activity) < kActivityRest) activity = now;
    }
}

void BudgetStage::report(FrameReport& report) const {
    for (std::size_t i = 0; i < outcomes_.size(); ++i) report.lights[lights_[i]].budget = outcomes_[i];
}

bool BudgetStage::is_moved_by(const BudgetLimits& limits, const CostFactors& factors) const {
    if (!(limits == limits_)) return true;
    constexpr double kNotice = 0.02;  // a fifth of the free room that giving back leaves (kRoomAfter)
    const auto moved = [](double now, double then) { return std::abs(now - then) > kNotice * then; };
    return is_active() &&
           (moved(factors.drawing, decided_factors_.drawing) || moved(factors.lighting, decided_factors_.lighting));
}

}  // namespace gnomon::shadow
