#include "systems/shadow/shadow_system.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "engine/core/zone.h"
#include "systems/shadow/budget/automatic_limit.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/exact/near_light_clearance.h"
#include "systems/shadow/fitting/directional/sdsm_splits.h"
#include "systems/shadow/fitting/fit_views.h"
#include "systems/shadow/fitting/static_frames.h"
#include "systems/shadow/report/light_report.h"
#include "systems/shadow/report/lighting_failures.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/limited_request.h"
#include "systems/shadow/request/triangle_references.h"
#include "systems/shadow/update/commit_maps.h"
#include "systems/shadow/update/plan_updates.h"

namespace gnomon::shadow {

namespace {

/// Largest part of the bytes of maps that is left to copies of static casters: a quarter.
constexpr std::uint64_t kCopyShare = 4;
/// Largest part of the automatic limit that is left to kept visibility: an eighth.
constexpr std::uint64_t kKeptShare = 8;

/// Returns the bytes that maps leave to kept visibility. They change by powers of two, and stay while `wanted` is a
/// quarter of them or more: each change may change the sizes of maps. `previous`: the result of the frame before.
std::uint64_t room_for_kept(std::uint64_t wanted, std::uint64_t previous, std::uint64_t automatic_bytes) {
    const std::uint64_t most = automatic_bytes / kKeptShare;
    if (wanted == 0) return 0;
    if (wanted <= previous && wanted >= previous / 4 && previous <= most) return previous;
    return std::min(std::bit_ceil(wanted), most);
}

}  // namespace

ShadowSystem::ShadowSystem(gl::Device& device, const History& fit_history, Jobs* jobs)
    : device_(device),
      maps_(device),
      depth_pass_(device),
      bounds_pass_(device),
      pyramid_pass_(device),
      prefilter_pass_(device),
      tint_maps_(device),
      tint_pass_(device),
      rays_(device),
      tint_scene_(device),
      jobs_(jobs),
      history_(fit_history) {}

ShadowSystem::~ShadowSystem() {
    device_.destroy(samplers_.nearest);
    device_.destroy(samplers_.linear);
    device_.destroy(samplers_.depths);
    for (const MapSamplers::OfMoments& moments : samplers_.moments) device_.destroy(moments.sampler);
}

bool ShadowSystem::samplers_ready(std::span<const ShadowRequest> requests) {
    // A description allocates its label: it is made only for a new sampler, not in a steady frame.
    const auto ensure = [&](gl::SamplerHandle& sampler, const char* label, bool linear, bool compare) {
        if (sampler) return true;
        sampler = device_.create_sampler({label, linear, false, compare, gl::Wrap::border, gl::Wrap::border}).handle;
        return static_cast<bool>(sampler);
    };
    bool ready = ensure(samplers_.nearest, "shadow compare nearest", false, true);
    ready = ensure(samplers_.linear, "shadow compare linear", true, true) && ready;
    for (const ShadowRequest& request : requests) {
        if (request.skip != Reason::none) continue;
        const MapReading reading = filter_row(request.map.filter).reading;
        if (reading == MapReading::depths) ready = ensure(samplers_.depths, "shadow depths", false, false) && ready;
        if (reading == MapReading::moments) ready = moment_sampler_ready(request.map.moments) && ready;
    }
    return ready;
}

bool ShadowSystem::moment_sampler_ready(const PrefilterSettings& settings) {
    if (samplers_.of(settings)) return true;
    const std::uint32_t anisotropy = MapSamplers::anisotropy(settings);
    const gl::SamplerDesc desc{.label = "shadow moments",
                               .linear = true,
                               .mipmaps = settings.levels > 1,
                               .anisotropy = static_cast<float>(anisotropy)};
    const gl::SamplerHandle sampler = device_.create_sampler(desc).handle;
    if (sampler) samplers_.moments.push_back({desc.mipmaps, anisotropy, sampler});
    return static_cast<bool>(sampler);
}

namespace {

/// Provides the triangle buffers that lights with FilterStorage::triangle_ids read. Such lights have no shadow while
/// the device has no memory for the buffers.
void provide_triangles(GpuScene& gpu, const FittedViews& fitted, std::span<LightStatus> statuses) {
    for (std::size_t i = 0; i < statuses.size(); ++i)
        if (!statuses[i].is_skipped() && filter_row(fitted.lights[i].request.map.filter).storage.triangle_ids &&
            !gpu.provide_caster_triangles())
            statuses[i].skip(Reason::buffer_failed);
}

}  // namespace

/// Updates the ray-tracing structures. Returns false on failure. Rays read layers from the instance records, and need
/// these first.
bool ShadowSystem::update_rays(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    return gpu.instances() && rays_.update(scene, gpu, list);
}

/// Provides the ray-tracing structures while any light uses rays, visible or not, and frees them otherwise. `updated`:
/// they are already updated in this frame. On failure, lights with a map are looked up without rays in this frame, and
/// lights without one have no shadow. From the next frame on their requests take account of the failure.
void ShadowSystem::provide_rays(const SceneSnapshot& scene, const GpuScene& gpu, bool updated, gl::CommandList& list) {
    bool any = rays_lack_, used = false;
    for (std::size_t i = 0; i < frame_.decisions.size(); ++i) {
        const ShadowRequest& request = frame_.decisions[i].request;
        if (request.skip != Reason::none || !request.rays.used) continue;
        any = true;
        used = used || !frame_.statuses[i].is_skipped();
    }
    if (!any) {
        rays_.release();
        bounds_pass_.release();
        pyramid_pass_.release();
    }
    if (!used || updated || update_rays(scene, gpu, list)) return;
    rays_lack_ = true;
    for (std::size_t i = 0; i < frame_.decisions.size(); ++i) {
        const RayUse& rays = frame_.decisions[i].request.rays;
        LightStatus& status = frame_.statuses[i];
        if (!rays.used || status.is_skipped()) continue;
        // A light with a map uses FallbackLookup.
        if (rays.only)
            status.skip(Reason::buffer_failed);
        else
            status.degrade(Reason::buffer_failed);
    }
}

const ShadowFrame& ShadowSystem::update(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings,
                                        gl::CommandList& list, FrameReport& report) {
    GNOMON_ZONE("shadow stages");
    const auto start = std::chrono::steady_clock::now();
    report.lights.assign(scene.lights.size(), {});
    frame_.cpu_us.assign(scene.lights.size(), 0.0);
    maps_.begin_frame();
    const bool others_move = dynamic_casters_.update(scene);
    const bool unchanged = frame_reuse_.unchanged(scene, settings) && !others_move;
    if (others_move) frame_.moving = dynamic_casters_.moving();
    BudgetLimits limits = limits_of(settings.budget);
    limits.bytes = std::min(limits.bytes, maps_.available());
    std::uint64_t automatic_bytes = settings.budget.bytes == 0 ? automatic_limit(scene.consumers) : BudgetLimits::kNone;
    const std::uint64_t copies = maps_.copy_room();
    copy_room_ = copies <= std::min(limits.bytes, automatic_bytes) / kCopyShare ? copies : 0;
    for (std::uint64_t* bytes : {&limits.bytes, &automatic_bytes})
        if (*bytes != BudgetLimits::kNone) *bytes -= std::min(*bytes, tint_maps_.wanted_bytes() + copy_room_);
    if (automatic_bytes != BudgetLimits::kNone) {
        const std::uint64_t wanted = settings.feedback.spare ? settings.feedback.spare->wanted_bytes() : 0;
        kept_room_ = room_for_kept(wanted, kept_room_, automatic_bytes);
        automatic_bytes -= kept_room_;
    }
    const bool leaves_kept_room = history_.short_of_bytes && automatic_bytes < limits.bytes;
    maps_.set_spare(settings.feedback.spare, leaves_kept_room ? kept_room_ : 0);
    if (history_.short_of_bytes) limits.bytes = std::min(limits.bytes, automatic_bytes);
    const bool budget_unchanged = !budget_.is_moved_by(limits, cost_calibration_.factors());
    reused_ = std::exchange(may_reuse_, false) && unchanged && budget_unchanged && has_buffers(gpu) && maps_.stay() &&
              tint_maps_.stay();
    if (reused_) {
        keep_all(frame_.maps, frame_.updates);
    } else {
        budget_.begin(limits, automatic_bytes, cost_calibration_.factors());
        run_stages(scene, gpu, settings, {list, report, frame_.cpu_us});
        had_casters_ = static_cast<bool>(gpu.caster_triangles());
        had_masks_ = static_cast<bool>(gpu.caster_masks());
    }
    report.still = reused_;
    report.rays = rays_.report();
    report.rays.bytes += tint_scene_.bytes();
    report.rays.sheet_bytes = bounds_pass_.bytes();
    report.rays.sheet_host_bytes = bounds_pass_.host_bytes();
    if (reused_) report.rays.meshes_written = 0, report.rays.instances_written = false;
    report.shadow_cpu_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    return frame_;
}

void ShadowSystem::report(const SceneSnapshot& scene, const LightingOutcome& outcome, FrameReport& report) const {
    const bool has_rays = static_cast<bool>(rays_.buffers().nodes);
    explain_lights(scene,
                   {drawn_views(frame_), frame_.sets, maps_, tint_maps_, draw_times_, contribution_culling_, has_rays,
                    frame_.cpu_us},
                   report);
    budget_.report(report);
    add_outcome(outcome, report);
}

void ShadowSystem::run_stages(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings,
                              const PassOutputs& out) {
    ShadowFrame& f = frame_;
    f.statuses.assign(scene.lights.size(), {});
    const LightAccounts accounts{f.statuses, f.cpu_us};

    const bool lacked = rays_lack_;
    rays_lack_ = rays_lack_ && wants_rays(scene, history_, settings.shadows) && !update_rays(scene, gpu, out.list);
    const TriangleReferences references = choose_references(gpu.capacity(), gpu.triangle_places(), history_.references);
    decide_requests(scene,
                    {device_.info(),
                     history_,
                     settings.shadows,
                     {.rays = settings.budget.rays, .off = !settings.rays, .lacks_memory = rays_lack_},
                     references},
                    fallbacks_, f.requests);
    for (std::size_t i = 0; i < f.requests.size(); ++i) f.statuses[i].skip(f.requests[i].skip);
    if (budget_.is_active()) apply_last_limits(scene, history_, f.requests, f.limited);
    const std::span<const ShadowRequest> requests = budget_.is_active() ? f.limited : f.requests;
    const bool any =
        std::any_of(requests.begin(), requests.end(), [](const ShadowRequest& r) { return r.skip == Reason::none; });
    if (any && !samplers_ready(requests))
        for (LightStatus& status : f.statuses) status.skip(Reason::sampler_failed);
    finish("request");

    lamp_offsets_.update(scene, gpu, requests, f.lamps_ws_m, f.cpu_us);
    select_sets(scene, {requests, f.lamps_ws_m, jobs_}, storage_, f.sets, accounts);
    contribution_culling_.leave_out(scene, gpu, f.sets, settings.feedback.exposure, f.statuses);
    finish("culling");

    const bool budget_active = budget_.is_active() || settings.budget.rays > 0 || !settings.rays || rays_lack_;
    fit_views(
        scene,
        {requests, f.sets, f.lamps_ws_m, settings.feedback.sampled_depths, history_, f.moving, budget_active, jobs_},
        storage_, f.fitted, f.next_history, accounts);
    count_static_frames(scene, f.fitted, history_, budget_active, f.next_history);
    f.next_history.references = references;
    finish("fitting");

    budget_.apply_automatic(scene, f.fitted, history_, f.statuses);
    if (budget_.is_active()) maps_.waiting_bytes(scene, waiting_bytes_);
    budget_.decide(scene, gpu, {f.requests, f.sets, f.fitted, history_, waiting_bytes_, jobs_}, f.next_history,
                   f.decisions, accounts);
    provide_triangles(gpu, f.fitted, f.statuses);
    provide_rays(scene, gpu, lacked && !rays_lack_, out.list);
    finish("budget");

    const std::uint64_t map_limit = budget_.map_limit();
    maps_.set_limit(map_limit == MapCache::kNoLimit ? map_limit : map_limit + copy_room_);
    maps_.set_keep_limit(budget_.keep_limit());
    maps_.assign(scene, f.fitted, f.decisions, f.maps, accounts);
    finish("maps");
    plan_updates(scene, gpu, {f.fitted, f.decisions, f.maps, budget_.draw_allowance()}, maps_, due_, f.updates);
    const DrawnViews views = drawn_views(f);
    finish("update");
    provide_tints(scene, gpu, limits_of(settings.budget).bytes, out.list);

    const PassInputs passes{scene, gpu, views};
    depth_pass_.prepare(passes, accounts);
    prefilter_pass_.prepare(passes, accounts);
    tint_pass_.prepare(passes, f.tints, f.statuses);
    bounds_pass_.prepare(passes, accounts);
    pyramid_pass_.prepare(passes, accounts);
    measure_clearances(passes, f.clearances_m, f.cpu_us);

    depth_pass_.record(passes, out);
    prefilter_pass_.record(passes, out);
    tint_pass_.record(passes, f.tints, out);
    bounds_pass_.record(passes, out);
    pyramid_pass_.record(passes, out);
    finish("passes");

    const bool masked = static_cast<bool>(gpu.caster_masks());
    publish_lights(scene,
                   {views, f.lamps_ws_m, f.clearances_m, samplers_, rays_.buffers(), masked, f.tints, f.ray_tints,
                    tint_scene_.buffer(), f.sets.lit_areas},
                   f.inputs, f.cpu_us);
    finish("publish");
}

/// Gives views with translucent casters their layers, within what `limit`, bytes, leaves beside
/// the maps.
void ShadowSystem::provide_tints(const SceneSnapshot& scene, const GpuScene& gpu, std::uint64_t limit,
                                 gl::CommandList& list) {
    const std::uint64_t taken = maps_.bytes() + tint_maps_.bytes();
    const std::uint64_t room = limit == MapCache::kNoLimit ? limit : limit - std::min(limit, taken);
    tint_maps_.assign(scene, gpu, drawn_views(frame_), room, frame_.statuses, frame_.tints);
    if (tint_maps_.bytes() == 0) tint_pass_.release();
    list_ray_tints(scene, gpu, drawn_views(frame_), frame_.sets, frame_.ray_tints);
    if (frame_.ray_tints.empty()) return tint_scene_.release();
    if (tint_scene_.update(scene, gpu, list)) return;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (frame_.ray_tints[i]) frame_.statuses[i].lose_tint(Reason::tint_failed);
}

void ShadowSystem::finish(std::string_view stage) const {
    if (watch_) watch_(stage, frame_);
}

bool ShadowSystem::wants_sampled_depths(const SceneSnapshot& scene) const {
    return shadow::wants_sampled_depths(scene, frame_.fitted, frame_.statuses);
}

/// Returns false if a buffer was lost that the last frame's lookups read, when meshes came or went.
bool ShadowSystem::has_buffers(const GpuScene& gpu) const {
    return (!had_casters_ || gpu.caster_triangles()) && (!had_masks_ || gpu.caster_masks());
}

/// Returns true if another run of the stages on an unchanged scene would have the same results. Then the history is
/// unchanged, no light has economy disabled, no failed operation is due for a retry, and no view is skipped for rays.
/// maps_ reports its own retries (MapCache::stay).
bool ShadowSystem::is_settled(const SceneSnapshot& scene) const {
    const auto is_tried_again = [](Reason reason) {
        return reason == Reason::depth_program_failed || reason == Reason::buffer_failed ||
               reason == Reason::sampler_failed || reason == Reason::filter_program_failed ||
               reason == Reason::tint_failed;
    };
    if (!(history_ == frame_.next_history)) return false;
    for (std::size_t i = 0; i < frame_.statuses.size(); ++i) {
        const LightStatus& status = frame_.statuses[i];
        if (is_tried_again(status.skipped()) || is_tried_again(status.degraded())) return false;
        if (frame_.requests[i].skip == Reason::none && !scene.lights[i].tuning.reuse.economy) return false;
    }
    return std::none_of(frame_.updates.begin(), frame_.updates.end(),
                        [](const UpdatePlan& plan) { return plan.skipped_for_rays; });
}

void ShadowSystem::commit(const SceneSnapshot& scene, bool executed) {
    const bool takes_turns = budget_.limits().ns != BudgetLimits::kNone;
    if (!reused_) budget_.note_changes(scene, drawn_views(frame_), frame_.next_history);
    commit_maps(scene, drawn_views(frame_), {executed, takes_turns}, maps_);
    if (!reused_) tint_maps_.commit(scene, drawn_views(frame_), frame_.tints, executed);
    rays_.submitted(executed);
    tint_scene_.submitted(executed);
    may_reuse_ = executed && (reused_ || is_settled(scene));
    std::swap(history_, frame_.next_history);
}

}  // namespace gnomon::shadow
