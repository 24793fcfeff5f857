#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/budget/apply_budget.h"
#include "systems/shadow/budget/cost_calibration.h"
#include "systems/shadow/culling/contribution_culling.h"
#include "systems/shadow/culling/lamp_offsets.h"
#include "systems/shadow/culling/static_dynamic_casters.h"
#include "systems/shadow/exact/bounds_pass.h"
#include "systems/shadow/exact/occluder_pyramid_pass.h"
#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/frame/pass_inputs.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/frame/shadow_settings.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/passes/depth_pass.h"
#include "systems/shadow/passes/prefilter_pass.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/shadow/report/draw_times.h"
#include "systems/shadow/request/ray_limit.h"
#include "systems/shadow/update/frame_reuse.h"
#include "systems/shadow/update/update_scheduler.h"
#include "systems/visibility/ray_scene.h"

namespace gnomon::shadow {

/// Called after each stage, with its name and the frame as it is then.
using StageWatch = std::function<void(std::string_view stage, const ShadowFrame& frame)>;

/// Runs the stages of a frame in order, and holds what outlives it. Owns its device objects.
class ShadowSystem {
public:
    /// `held_fits`: what the fits go on from, if an earlier system's context was lost.
    explicit ShadowSystem(gl::Device& device, const History& held_fits = {});
    ~ShadowSystem();
    ShadowSystem(const ShadowSystem&) = delete;
    ShadowSystem& operator=(const ShadowSystem&) = delete;

    /// Runs all stages for `scene`, records the depth passes into `list` and counts them in the report.
    /// Never throws; no device failure stops the frame.
    /// Where nothing changed since the last frame, its results stand, and nothing is done that grows with the scene.
    const ShadowFrame& update(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings,
                              gl::CommandList& list, FrameReport& report);

    /// Says in the report what became of each light and view, once the frame's pictures are recorded. `outcome`: of
    /// lighting; empty where the frame has no pictures of Gnomon's own.
    void report(const SceneSnapshot& scene, const LightingOutcome& outcome, FrameReport& report) const;

    /// To be called after the list was submitted: `executed` says whether it was, without failure.
    void commit(const SceneSnapshot& scene, bool executed);

    const ShadowFrame& frame() const { return frame_; }
    /// Where measurements of drawing go, and what reports take them from.
    DrawTimes& draw_times() { return draw_times_; }
    /// The same for a budget's model; shown nothing, it stands as it is.
    CostClock& cost_clock() { return cost_clock_; }

    /// Whether any light places its splits by the picture's depths (CascadeSplits::sampled), after update().
    bool wants_sampled_depths(const SceneSnapshot& scene) const;

    /// Sets who watches the stages, for tests and tools. Empty: nobody.
    void watch_stages(StageWatch watch) { watch_ = std::move(watch); }

    const visibility::RayScene& rays() const { return rays_; }
    const MapStore& maps() const { return maps_; }
    const DimLights& dim_lights() const { return dim_lights_; }
    const History& held_fits() const { return history_; }

private:
    void run_stages(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings, const PassOutputs& out);
    void finish(std::string_view stage) const;
    bool is_settled(const SceneSnapshot& scene) const;
    bool samplers_ready(std::span<const ShadowRequest> requests);
    bool moment_sampler_ready(const PrefilterSettings& settings);
    bool update_rays(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    void provide_rays(const SceneSnapshot& scene, const GpuScene& gpu, bool updated, gl::CommandList& list);

    gl::Device& device_;
    MapStore maps_;
    DepthRecorder recorder_;
    SheetRecorder sheets_;
    EndsRecorder ends_;
    MomentRecorder moments_;
    visibility::RayScene rays_;
    MapSamplers samplers_;
    DrawTimes draw_times_;
    DimLights dim_lights_;
    BudgetStage budget_;
    std::vector<std::optional<std::uint64_t>> waiting_bytes_;  // one per light
    std::uint64_t most_rays_ = 0;
    RayFallbacks fallbacks_;
    bool rays_lack_ = false;
    CostClock cost_clock_;
    LampPlaces lamp_places_;
    FitStorage storage_;
    std::vector<DueView> due_;
    ShadowFrame frame_;
    History history_;
    CasterMotion motion_;
    StillFrame still_;
    StageWatch watch_;
    bool stands_ = false;     // the last update() found nothing to do
    bool may_stand_ = false;  // the next one may
};

}  // namespace gnomon::shadow
