#include "systems/shadow/shadow_system.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "systems/shadow/budget/ray_budget.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/exact/near_light_clearance.h"
#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/report/light_report.h"
#include "systems/shadow/request/decide_requests.h"

namespace gnomon::shadow {

ShadowSystem::ShadowSystem(gl::Device& device, const History& held_fits)
    : device_(device),
      maps_(device),
      recorder_(device),
      sheets_(device),
      ends_(device),
      moments_(device),
      rays_(device),
      history_(held_fits) {}

ShadowSystem::~ShadowSystem() {
    device_.destroy(samplers_.nearest);
    device_.destroy(samplers_.linear);
    device_.destroy(samplers_.depths);
    for (const MapSamplers::OfMoments& moments : samplers_.moments) device_.destroy(moments.sampler);
}

bool ShadowSystem::samplers_ready() {
    // A description holds text: none is made in a steady frame.
    const auto ensure = [&](gl::SamplerHandle& sampler, const char* label, bool linear, bool compare) {
        if (sampler) return true;
        sampler = device_.create_sampler({label, linear, false, compare, gl::Wrap::border, gl::Wrap::border}).handle;
        return static_cast<bool>(sampler);
    };
    bool ready = ensure(samplers_.nearest, "shadow compare nearest", false, true);
    ready = ensure(samplers_.linear, "shadow compare linear", true, true) && ready;
    for (const ShadowDemand& demand : frame_.demands) {
        if (demand.skip != Reason::none) continue;
        const MapReading reading = filter_row(demand.filter).reading;
        if (reading == MapReading::depths) ready = ensure(samplers_.depths, "shadow depths", false, false) && ready;
        if (reading == MapReading::moments) ready = moment_sampler_ready(demand.moments) && ready;
    }
    return ready;
}

bool ShadowSystem::moment_sampler_ready(const MomentDemand& demand) {
    if (samplers_.of(demand)) return true;
    const std::uint32_t anisotropy = MapSamplers::anisotropy(demand);
    const gl::SamplerDesc desc{.label = "shadow moments",
                               .linear = true,
                               .mipmaps = demand.levels > 1,
                               .anisotropy = static_cast<float>(anisotropy)};
    const gl::SamplerHandle sampler = device_.create_sampler(desc).handle;
    if (sampler) samplers_.moments.push_back({desc.mipmaps, anisotropy, sampler});
    return static_cast<bool>(sampler);
}

/// Lights that read triangles are lit while the device has no room for them.
void ShadowSystem::provide_triangles(GpuScene& gpu) {
    for (std::size_t d = 0; d < frame_.demands.size(); ++d)
        if (frame_.sets[d].skip == Reason::none &&
            filter_row(frame_.demands[d].filter).storage == FilterStorage::depth_and_triangle &&
            !gpu.provide_caster_triangles())
            frame_.sets[d].skip = Reason::buffer_failed;
}

/// Rays ask of an instance whom it shadows: without records of those there is nothing to walk.
bool ShadowSystem::update_rays(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    return gpu.instances() && rays_.update(scene, gpu, list);
}

/// Whether the device had no room for what rays walk, and has none now: it is asked again from time to time.
bool ShadowSystem::lacks_rays(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    const bool any = std::any_of(frame_.demands.begin(), frame_.demands.end(),
                                 [](const ShadowDemand& d) { return d.skip == Reason::none && d.asks_rays; });
    return rays_lack_ && any && !update_rays(scene, gpu, list);
}

/// Lights that ask by rays are looked up once, or lit, in the frame that has no room for what those walk;
/// give_rays_up() has it from the next on. What they ask is kept as long as there is one, seen or not. `updated`: in
/// this frame.
void ShadowSystem::provide_rays(const SceneSnapshot& scene, const GpuScene& gpu, bool updated, gl::CommandList& list) {
    bool any = false, asked = false;
    const auto asks = [&](std::size_t d) { return frame_.demands[d].asks_rays; };
    const auto asks_now = [&](std::size_t d) { return asks(d) && frame_.sets[d].skip == Reason::none; };
    for (std::size_t d = 0; d < frame_.demands.size(); ++d) {
        if (frame_.demands[d].skip != Reason::none) continue;
        any = any || asks(d);
        asked = asked || asks_now(d);
    }
    any = any || rays_lack_;
    if (!any) rays_.release();
    if (!any) sheets_.release();
    if (!any) ends_.release();
    if (!asked || updated || update_rays(scene, gpu, list)) return;
    rays_lack_ = true;
    for (std::size_t d = 0; d < frame_.demands.size(); ++d) {
        if (!asks_now(d)) continue;
        // A map that there is is looked up once: PlainLookup.
        ShadowDemand& demand = frame_.demands[d];
        (demand.traced ? frame_.sets[d].skip : demand.note) = Reason::buffer_failed;
    }
}

const ShadowFrame& ShadowSystem::update(const SceneSnapshot& scene, GpuScene& gpu, bool shadows, gl::CommandList& list,
                                        FrameReport& report, const ShadowBudget& budget) {
    const auto start = std::chrono::steady_clock::now();
    report.lights.assign(scene.lights.size(), {});
    frame_.cpu_us.assign(scene.lights.size(), 0.0);
    maps_.begin_frame();
    const bool others_move = motion_.update(scene);
    const bool unchanged = still_.unchanged(scene, shadows, budget) && !others_move;
    if (others_move) frame_.moving = motion_.moving();
    most_rays_ = budget.rays;
    BudgetLimits limits = limits_of(budget);
    limits.bytes = std::min(limits.bytes, maps_.available());
    const bool shared_out = !budget_.is_moved_by(limits, cost_clock_.factors());
    stands_ = std::exchange(may_stand_, false) && unchanged && shared_out && maps_.stay();
    if (stands_) {
        stand_still();
    } else {
        budget_.begin(limits, cost_clock_.factors());
        run_stages(scene, gpu, shadows, list, report);
    }
    report.still = stands_;
    report.rays = rays_.report();
    report.rays.sheet_bytes = sheets_.bytes();
    report.rays.sheet_host_bytes = sheets_.host_bytes();
    if (stands_) report.rays.meshes_written = 0, report.rays.instances_written = false;
    explain_lights(scene, frame_, maps_, draw_times_, dim_lights_, static_cast<bool>(rays_.buffers().nodes), report);
    budget_.report(report);
    report.shadow_cpu_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    return frame_;
}

/// What the stages found in the last frame is what they would find now; all that it drew is there.
void ShadowSystem::stand_still() {
    for (ShadowSlot& slot : frame_.slots) {
        slot.reuse = static_cast<bool>(slot.texture);
        slot.convert = false;
        slot.whole = {};
        slot.route = CubeRoute::six_passes;
        slot.still_use = StillUse::none;
    }
}

void ShadowSystem::run_stages(const SceneSnapshot& scene, GpuScene& gpu, bool shadows, gl::CommandList& list,
                              FrameReport& report) {
    decide_demand(scene, device_.info(), shadows, history_, frame_.demands);
    const bool lacked = rays_lack_;
    rays_lack_ = lacks_rays(scene, gpu, list);
    if (rays_lack_) give_rays_up(scene, device_.info(), history_, frame_.demands);
    limit_rays(scene, device_.info(), history_, most_rays_, frame_.demands, ray_askers_);
    budget_.apply(scene, history_, frame_.demands);
    const bool any = std::any_of(frame_.demands.begin(), frame_.demands.end(),
                                 [](const ShadowDemand& d) { return d.skip == Reason::none; });
    if (any && !samplers_ready())
        for (ShadowDemand& demand : frame_.demands)
            if (demand.skip == Reason::none) demand.skip = Reason::sampler_failed;
    lamp_places_.update(scene, gpu, frame_);
    select_sets(scene, frame_);
    dim_lights_.leave_out(scene, gpu, frame_);
    frame_.shared_out = budget_.is_active() || most_rays_ > 0 || rays_lack_;
    fit_views(scene, history_, frame_);
    count_quiet_frames(scene, history_, frame_);
    if (budget_.is_active()) maps_.waiting_bytes(scene, waiting_bytes_);
    budget_.decide(scene, gpu, history_, waiting_bytes_, frame_);
    provide_triangles(gpu);
    provide_rays(scene, gpu, lacked && !rays_lack_, list);
    maps_.set_limit(budget_.limits().bytes);
    maps_.let_take_turns(budget_.limits().ns != BudgetLimits::kNone);
    maps_.assign_slots(scene, frame_);
    maps_.leave_to_rays(scene, gpu, frame_);
    budget_.spread_draws(gpu, scene, frame_);
    budget_.note_changes(scene, frame_);
    maps_.plan_draws(scene, gpu, frame_);
    recorder_.prepare(scene, gpu, frame_);
    sheets_.prepare(scene, gpu, frame_);
    ends_.prepare(frame_);
    measure_clearances(scene, gpu, frame_);
    moments_.prepare(frame_);
    publish_lights(scene, samplers_, rays_.buffers(), static_cast<bool>(gpu.caster_masks()), frame_);
    recorder_.record(scene, gpu, frame_, list, report);
    sheets_.record(scene, gpu, frame_, list, report);
    ends_.record(scene, frame_, list);
    moments_.record(scene, frame_, list);
}

/// Whether another run of the stages would do no more than this one, if nothing changes meanwhile: fits hold on to what
/// they hold already, no light asks for all to be drawn, and nothing that failed is to be tried again but by maps_,
/// which says so itself.
bool ShadowSystem::is_settled(const SceneSnapshot& scene) const {
    const auto settled = [&](const PotentialSets& sets, const ShadowDemand& demand) {
        const auto is_tried_again = [](Reason reason) {
            return reason == Reason::depth_program_failed || reason == Reason::buffer_failed ||
                   reason == Reason::sampler_failed || reason == Reason::filter_program_failed;
        };
        return !is_tried_again(sets.skip) && !is_tried_again(demand.note) && !demand.left_to_rays &&
               (demand.skip != Reason::none || scene.lights[demand.light].tuning.reuse.economy);
    };
    return history_ == frame_.next_history &&
           std::equal(frame_.sets.begin(), frame_.sets.end(), frame_.demands.begin(), frame_.demands.end(), settled);
}

void ShadowSystem::commit(const SceneSnapshot& scene, bool drawn) {
    maps_.commit(scene, frame_, drawn);
    if (!drawn) rays_.forget_uploads();
    may_stand_ = drawn && (stands_ || is_settled(scene));
    std::swap(history_, frame_.next_history);
}

}  // namespace gnomon::shadow
