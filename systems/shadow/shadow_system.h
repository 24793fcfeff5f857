#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/jobs.h"
#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
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
#include "systems/shadow/frame/stage_storage.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/maps/tint_maps.h"
#include "systems/shadow/passes/depth_pass.h"
#include "systems/shadow/passes/prefilter_pass.h"
#include "systems/shadow/passes/tint_pass.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/shadow/report/draw_times.h"
#include "systems/shadow/request/ray_limit.h"
#include "systems/shadow/update/frame_reuse.h"
#include "systems/shadow/update/update_scheduler.h"
#include "systems/visibility/ray_scene.h"
#include "systems/visibility/tint_scene.h"

namespace gnomon::shadow {

/// Called after each stage, with its name and the frame as it is then.
using StageWatch = std::function<void(std::string_view stage, const ShadowFrame& frame)>;

/// Runs the stages of a frame, and keeps the state that outlives a frame: maps, history, measured costs. Owns its
/// device objects.
class ShadowSystem {
public:
    /// Creates the system. `fit_history`: history of an earlier system with a lost context, from which the fits
    /// continue. `jobs`: threads that share the lights of a frame, and outlive the system; null: the calling one does
    /// all.
    explicit ShadowSystem(gl::Device& device, const History& fit_history = {}, Jobs* jobs = nullptr);
    ~ShadowSystem();
    ShadowSystem(const ShadowSystem&) = delete;
    ShadowSystem& operator=(const ShadowSystem&) = delete;

    /// Runs all stages for `scene`, records the depth passes into `list` and counts them in the report. Never throws;
    /// no device failure stops the frame. If nothing changed since the last frame, its results are reused, and the cost
    /// does not depend on the scene's size.
    const ShadowFrame& update(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings,
                              gl::CommandList& list, FrameReport& report);

    /// Reports what became of each light and view, once the frame's pictures are recorded. `outcome`: of lighting;
    /// empty where another renderer draws the pictures.
    void report(const SceneSnapshot& scene, const LightingOutcome& outcome, FrameReport& report) const;

    /// Commits the frame after its list was submitted. `executed` false: the list failed or was not executed, so that
    /// maps do not have the recorded content.
    void commit(const SceneSnapshot& scene, bool executed);

    const ShadowFrame& frame() const { return frame_; }
    /// Returns the measured draw times, which the caller fills and reports read.
    DrawTimes& draw_times() { return draw_times_; }
    /// Returns the calibration of the budget's cost model. Without measurements it stays unchanged.
    CostCalibration& cost_calibration() { return cost_calibration_; }

    /// Returns true if any light needs the picture's depths for its splits (CascadeSplits::sampled). Call after
    /// update().
    bool wants_sampled_depths(const SceneSnapshot& scene) const;

    /// Sets the function that is called after each stage, for tests and tools. Empty: none.
    void watch_stages(StageWatch watch) { watch_ = std::move(watch); }

    /// Returns the draws into maps that the engine makes before it submits the frame's list (DrawableKinds::
    /// any_drawn).
    std::span<const EngineDraw> engine_draws() const {
        return reused_ ? std::span<const EngineDraw>() : depth_pass_.engine_draws();
    }
    /// Lets one program look up all lights (systems/lookup): see MapCache::share_layers(). Call it before the first
    /// update().
    void share_layers() { maps_.share_layers(); }
    const visibility::RayScene& rays() const { return rays_; }
    const MapCache& maps() const { return maps_; }
    const ContributionCulling& contribution_culling() const { return contribution_culling_; }
    const History& fit_history() const { return history_; }

private:
    void run_stages(const SceneSnapshot& scene, GpuScene& gpu, const ShadowSettings& settings, const PassOutputs& out);
    void finish(std::string_view stage) const;
    bool is_settled(const SceneSnapshot& scene) const;
    bool has_buffers(const GpuScene& gpu) const;
    bool samplers_ready(std::span<const ShadowRequest> requests);
    bool moment_sampler_ready(const PrefilterSettings& settings);
    void provide_tints(const SceneSnapshot& scene, const GpuScene& gpu, std::uint64_t limit, gl::CommandList& list);
    bool update_rays(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    void provide_rays(const SceneSnapshot& scene, const GpuScene& gpu, bool updated, gl::CommandList& list);

    gl::Device& device_;
    MapCache maps_;
    DepthPass depth_pass_;
    BoundsPass bounds_pass_;
    OccluderPyramidPass pyramid_pass_;
    PrefilterPass prefilter_pass_;
    TintMaps tint_maps_;
    TintPass tint_pass_;
    visibility::RayScene rays_;
    visibility::TintScene tint_scene_;
    MapSamplers samplers_;
    DrawTimes draw_times_;
    ContributionCulling contribution_culling_;
    BudgetStage budget_;
    std::vector<std::optional<std::uint64_t>> waiting_bytes_;  // one per light
    RayFallbacks fallbacks_;
    bool rays_lack_ = false;
    CostCalibration cost_calibration_;
    LampOffsets lamp_offsets_;
    StageStorage storage_;
    Jobs* jobs_;
    std::vector<DueView> due_;
    ShadowFrame frame_;
    History history_;
    DynamicCasters dynamic_casters_;
    FrameReuse frame_reuse_;
    StageWatch watch_;
    bool reused_ = false;                           // the last update() reused the frame before it
    std::uint64_t copy_room_ = 0;                   // bytes that the budget leaves to copies of static casters
    std::uint64_t kept_room_ = 0;                   // bytes that the automatic limit leaves to kept visibility
    bool may_reuse_ = false;                        // the next update() may reuse the last frame
    bool had_casters_ = false, had_masks_ = false;  // buffers of the scene that the last run of the stages found
};

}  // namespace gnomon::shadow
