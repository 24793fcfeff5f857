#include "systems/picture/picture_changes.h"

#include <algorithm>
#include <utility>

#include "engine/core/put.h"

namespace gnomon::picture {
namespace {

bool is_stale(const shadow::UpdatePlan& plan) { return plan.hold != shadow::Hold::none; }

}  // namespace

bool PictureChanges::unchanged(const SceneSnapshot& scene, const shadow::ShadowFrame& shadows,
                               const FrameSettings& settings) {
    now_.clear();
    for (const shadow::LightStatus& status : shadows.statuses) now_.push_back({status.skipped(), status.degraded()});
    const Settings wanted{settings.exposure_ev,          settings.shadows,     settings.rays,
                          settings.leave_out_dim_lights, settings.transparent, settings.shadow_budget,
                          settings.noise_frame};
    bool same = !put(version_, scene.version) && scene.version != 0;
    same &= !put(consumers_, scene.consumers);
    same &= !put(pictures_, scene.pictures);
    same &= !put(settings_, wanted);
    same &= outcomes_ == now_;
    std::swap(outcomes_, now_);
    return same && !settings.debug.view && std::none_of(shadows.updates.begin(), shadows.updates.end(), is_stale);
}

}  // namespace gnomon::picture
