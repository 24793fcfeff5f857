#include "systems/shadow/fitting/static_frames.h"

#include <algorithm>

#include "engine/core/signature.h"

namespace gnomon::shadow {
namespace {

/// Returns a hash of the cameras' positions and rotations.
std::uint64_t pictures_of(const SceneSnapshot& scene) {
    Signature s;
    for (const ConsumerItem& camera : scene.pictures.empty() ? scene.consumers : scene.pictures) {
        for (int i = 0; i < 3; ++i) s.add(camera.position_ws_m[i]);
        for (int i = 0; i < 9; ++i) s.add(camera.rotation_ws[i / 3][i % 3]);
    }
    return s.value();
}

}  // namespace

void count_static_frames(const SceneSnapshot& scene, const FittedViews& fitted, const History& previous,
                         bool budget_active, History& next) {
    const auto uses_rays = [](const FitChoice& choice) {
        return choice.request.skip == Reason::none && choice.request.rays.used;
    };
    const bool any = std::any_of(fitted.lights.begin(), fitted.lights.end(), uses_rays);
    next.pictures = any ? pictures_of(scene) : 0;
    if (!any) return;
    const bool moved = previous.pictures != next.pictures;
    std::size_t entries = 0;  // next.lights has those lights that the request did not skip
    for (std::uint32_t i = 0; i < fitted.lights.size(); ++i) {
        if (fitted.lights[i].request.skip != Reason::none) continue;
        LightFitHistory& entry = next.lights[entries++];
        const LightItem& light = scene.lights[i];
        const auto views = fitted.views_of(i);
        if (views.empty() || !fitted.lights[i].request.rays.used) continue;
        Signature casters;
        casters.add(light.shape_version);
        for (const ShadowView& view : views)
            for (const std::uint32_t c : fitted.casters_of(view)) {
                casters.add(scene.instances[c].gpu_slot | scene.instances[c].mesh_version << 32);
                casters.add(scene.instances[c].version);
            }
        const bool same = entry.rays.casters == casters.value() && light.tuning.reuse.economy && !budget_active;
        entry.rays.casters = casters.value();
        entry.rays.static_frames = same ? std::min(entry.rays.static_frames + (moved ? 1 : 0), kStaticSunFrames) : 0;
    }
}

}  // namespace gnomon::shadow
