#pragma once
#include <optional>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/receiver_caster_sets.h"

namespace gnomon::shadow {

/// Returns an upper bound on what a light adds to any pixel of its receivers, in display steps (8-bit sRGB). It takes
/// the nearest receiver, the brightest channel, the materials' largest reflectance, and the steepest part of tone curve
/// and encoding. Infinite where a receiver may touch the light, or is a shadow
/// catcher or air.
double most_display_steps(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                          std::span<const std::uint32_t> receivers, double exposure);

/// Contribution culling: finds lights too dim for their shadows to be visible. Unshadowed everywhere, all of them
/// together change no pixel by more than half a display step. The dimmest lights are culled first. Hysteresis: a light
/// is culled only well below that limit, and stays culled up to the limit. Needs LightingFeedback::exposure; no light
/// is culled where that is infinite. ShadowTuning::Reuse::economy = false exempts a light.
class ContributionCulling {
public:
    /// Skips culled lights with below_display_step. Call after select_sets(). Allocates nothing in a steady state.
    void leave_out(const SceneSnapshot& scene, const GpuScene& gpu, const ReceiverCasterSets& sets,
                   std::optional<double> exposure, std::span<LightStatus> statuses);

    /// Returns the bound of light `index` in the last frame, display steps. Empty: it was not computed.
    std::optional<double> steps(std::uint32_t index) const { return steps_[index]; }

    /// Returns true if some light was so faint beside another one in the last frame that a measured exposure could cull
    /// it.
    bool wants_exposure() const { return wants_exposure_; }

    static constexpr double kMostSteps = 0.5;       // limit for culled lights: a change rounds away or to the next step
    static constexpr double kNewlyMostSteps = 0.4;  // limit for other lights: flicker of brightness changes nothing

private:
    void ask_lights(const SceneSnapshot& scene, const GpuScene& gpu, const ReceiverCasterSets& sets, double exposure,
                    std::span<const LightStatus> statuses);

    struct Dim {
        double steps = 0.0;
        std::uint32_t light = 0;
        bool was_out = false;
    };
    std::vector<std::optional<double>> steps_;
    std::vector<Dim> candidates_;
    std::vector<ecs::Entity> out_;  // lights culled in the last frame, by rising entity
    bool wants_exposure_ = false;
};

}  // namespace gnomon::shadow
