#pragma once
#include <optional>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/receiver_caster_sets.h"

namespace gnomon::shadow {

/// How much a light can add to any pixel of its receivers, in steps of the shown picture (8 bit sRGB), by bounds:
/// nearest receiver, brightest colour, its materials' most reflecting directions, and the steepest part of tone curve
/// and encoding. Infinite where a receiver may touch the light.
double most_display_steps(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light,
                          std::span<const std::uint32_t> receivers, double exposure);

/// Which lights are too dim for their shadows to be seen: those that, lit everywhere, change no pixel by more than half
/// a step all together. The dimmest first; one that is left out stays so until it must not, one that is not is left out
/// only well below. Needs LightingFeedback::exposure: none may be left out where that is infinite.
/// ShadowTuning::Reuse::economy=false exempts a light.
class DimLights {
public:
    /// Skips lights with below_display_step, after select_sets(). Allocates nothing once warm.
    void leave_out(const SceneSnapshot& scene, const GpuScene& gpu, const ReceiverCasterSets& sets,
                   std::optional<double> exposure, std::span<LightStatus> statuses);

    /// Of light `index` in the last frame; empty: it was not asked for.
    std::optional<double> steps(std::uint32_t index) const { return steps_[index]; }

    /// Whether a light is so faint beside another one that it is worth knowing the exposure. In the last frame.
    bool wants_exposure() const { return wants_exposure_; }

    static constexpr double kMostSteps = 0.5;       // what rounds away, or to the next step
    static constexpr double kNewlyMostSteps = 0.4;  // a light whose brightness trembles stays what it is

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
    std::vector<ecs::Entity> out_;  // in the last frame, by rising entity
    bool wants_exposure_ = false;
};

}  // namespace gnomon::shadow
