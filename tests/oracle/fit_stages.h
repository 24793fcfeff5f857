#pragma once
#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/fitting/fit_views.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/request/decide_requests.h"

namespace gnomon::shadow {

/// Runs the stages of a frame one by one, up to the fits, without a device.
class FitStages {
public:
    ShadowFrame frame;

    /// Decides requests for a device that takes maps of `max_px` along an edge.
    void decide(const SceneSnapshot& scene, const History& previous = {}, std::uint32_t max_px = 16384) {
        gl::DeviceInfo device;
        device.max_texture_px = device.max_cube_px = max_px;
        decide(scene, device, previous);
    }
    void decide(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& previous = {}) {
        decide_requests(scene, {device, previous}, fallbacks_, frame.requests);
        frame.statuses.assign(frame.requests.size(), {});
        for (std::size_t i = 0; i < frame.requests.size(); ++i) frame.statuses[i].skip(frame.requests[i].skip);
    }
    void select(const SceneSnapshot& scene) {
        select_sets(scene, {frame.requests, {}, jobs}, storage, frame.sets, {frame.statuses, {}});
    }
    void fit(const SceneSnapshot& scene, const History& previous = {}, bool budget_active = false) {
        fit_views(scene, {frame.requests, frame.sets, {}, sampled_depths, previous, {}, budget_active, jobs}, storage,
                  frame.fitted, frame.next_history, {frame.statuses, {}});
    }

    Jobs* jobs = nullptr;  // threads that share the lights
    SampledDepths sampled_depths;
    StageStorage storage;

private:
    RayFallbacks fallbacks_;
};

/// Returns a frame with its requests, sets and fits.
inline ShadowFrame fitted(const SceneSnapshot& scene, const History& previous = {}, bool budget_active = false) {
    FitStages stages;
    stages.decide(scene, previous);
    stages.select(scene);
    stages.fit(scene, previous, budget_active);
    return std::move(stages.frame);
}

}  // namespace gnomon::shadow
